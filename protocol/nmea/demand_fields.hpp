// Demands and responses of engines and thrusters, and the place they are commanded from.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string_view>

#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {

// The letters are those of the field.
enum class CommandPlace : char {
  bridge = 'B',
  port_wing = 'P',
  starboard_wing = 'S',
  control_room = 'C',
  local = 'E',  // beside the engine
  wing = 'W',
};
inline constexpr std::string_view kCommandPlaces = "BPSCEW";

// In per cent within 100, or in the unit of its kind.
struct Demand {
  double value = 0.0;
  bool in_percent = true;
  friend bool operator==(const Demand&, const Demand&) = default;
};

// Speed of an engine or thruster: 'P' per cent or 'R' revolutions a minute, within 9999.9.
inline constexpr char kSpeedUnit = 'R';
// Pitch: 'P' per cent or 'D' degrees, within 90.
inline constexpr char kPitchUnit = 'D';

// Two fields: value and unit.  Without a demand, or out of range: empty and 'V', which is how the
// sentences say that it is not valid.
SentenceWriter& add_demand(SentenceWriter& out, std::optional<Demand> demand, char unit);
std::optional<Demand> read_demand(FieldReader& in, std::size_t index, char unit);

}  // namespace skerry::nmea
