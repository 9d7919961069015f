// TRC and TRD: what a thruster is asked for, and what it does.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/demand_fields.hpp"

namespace skerry::nmea {

// Thrusters are numbered 1 .. 99: odd ones are at the bow, even ones at the stern.
inline bool is_bow_thruster(unsigned number) { return number % 2 == 1; }

struct Trc {
  unsigned number = 1;
  std::optional<Demand> speed = {};        // per cent or revolutions a minute; negative to port
  std::optional<Demand> pitch = {};        // per cent or degrees; negative to port
  std::optional<double> azimuth_deg = {};  // whither it pushes; [0, 360]; none in a tunnel
  std::optional<CommandPlace> place = CommandPlace::bridge;
  bool is_command = true;  // otherwise it reports what is set
};
std::string encode(const Trc& trc, std::string_view talker = "RC");
Result<Trc, WireError> decode_trc(const Sentence& sentence);

struct Trd {
  unsigned number = 1;
  std::optional<Demand> speed = {};
  std::optional<Demand> pitch = {};
  std::optional<double> azimuth_deg = {};
};
std::string encode(const Trd& trd, std::string_view talker = "RC");
Result<Trd, WireError> decode_trd(const Sentence& sentence);

}  // namespace skerry::nmea
