// The options of `skerry set` as a table, with the fields behind them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::client {

inline constexpr const char* kWorldGroup = "World (for all radars)";

struct NumberControl {
  const char* option;
  const char* help;  // with the allowed range
  const char* group;
  void (*set)(wire::Set&, double);
};
std::span<const NumberControl> number_controls();

struct WordControl {
  const char* option;
  const char* help;
  const char* group;
  std::vector<std::string> words;
  void (*set)(wire::Set&, const std::string& word);
};
std::span<const WordControl> word_controls();

struct RainOptions {
  std::vector<double> add, at;  // latitude, longitude
  std::optional<std::uint32_t> change;
  std::optional<double> radius_nm, rate_mm_h, drift_deg, drift_kn;
  std::vector<std::uint32_t> remove;
  bool remove_all = false;

  bool any() const {
    return !add.empty() || change || radius_nm || rate_mm_h || drift_deg || drift_kn ||
           !remove.empty() || remove_all;
  }
};
// Returns the fault of the options, if there is one.
std::optional<std::string> add_rain(const RainOptions& options, wire::WorldChange& change);

// "350-10", or "none" alone, which takes all away; what is wrong with them, if anything is.
std::optional<std::string> add_blanked(const std::vector<std::string>& texts, wire::Set& set);

// "side_lobes=off"; what is wrong with it, if anything is.
std::optional<std::string> add_artefact(const std::string& text, wire::WorldChange& change);
std::string artefact_names();  // "side_lobes, multiple_echoes, ..."

}  // namespace skerry::client
