// The options of `skerry set`: read from the schema, and what they put into a Set.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::client {

inline constexpr const char* kShipGroup = "Own ship";
inline constexpr const char* kConGroup = "Con of an own ship that has a class";
inline constexpr const char* kViewGroup = "View";
inline constexpr const char* kRadarGroup = "Radar (for all its views)";
inline constexpr const char* kWorldGroup = "World (for all radars)";

// One option per order, control and property of the world that the schema has a help for; blanked
// sectors have one of their own.
struct SetOption {
  const wire::FieldDescriptor* field;
  std::string name;  // "--sea-auto"
  std::string help;  // with what is allowed
  const char* group;
  std::vector<std::string> words;  // the only values, if it is a switch or choice
};
std::vector<SetOption> set_options();

// `text` is a number, or one of the option's words.
void put_option(wire::Set& set, const SetOption& option, const std::string& text);

struct RainOptions {
  std::vector<double> add, at;  // latitude, longitude
  std::optional<std::uint32_t> change;
  std::optional<double> radius_nm, rate_mm_h, drift_deg, drift_kn;
  std::string kind;  // a word of rain_kinds(); empty: as it is
  std::vector<std::uint32_t> remove;
  bool remove_all = false;

  bool any() const {
    return !add.empty() || change || radius_nm || rate_mm_h || drift_deg || drift_kn ||
           !kind.empty() || !remove.empty() || remove_all;
  }
};
std::vector<std::string> rain_kinds();  // "cell", "even", ...
// Returns the fault of the options, if there is one.
std::optional<std::string> add_rain(const RainOptions& options, wire::WorldChange& change);

// "350-10", or "none" alone, which takes all away; what is wrong with them, if anything is.
std::optional<std::string> add_blanked(const std::vector<std::string>& texts, wire::Set& set);

// "side_lobes=off"; what is wrong with it, if anything is.
std::optional<std::string> add_artefact(const std::string& text, wire::WorldChange& change);
std::string artefact_names();  // "side_lobes, multiple_echoes, ..."

}  // namespace skerry::client
