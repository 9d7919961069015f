// The controls of a radar as Signal K displays are told of them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/signalk/json.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::signalk {

enum class ControlKind : std::uint8_t { number, choice, text, sector };

struct ControlChoice {
  double value = 0.0;
  std::string label;
  bool settable = true;  // false: a state it can be in but not be put into
};

// Angles in radians, lengths in metres, speeds in m/s, turning in rad/s: what `units` names.  All
// but the texts come of one field of the schema of controls, which its `signalk` key names.
struct ControlDefinition {
  std::string key;          // "gain": in paths
  int id = 0;               // orders the controls of a category
  std::string name;         // "Gain"
  std::string description;  // of one line
  std::string category;     // base, targets, advanced, installation or info
  ControlKind kind = ControlKind::number;
  double min = 0.0, max = 0.0, step = 1.0;  // number, sector
  std::string units = {};
  std::vector<ControlChoice> choices = {};  // the only values there are, if any
  bool has_auto = false;
  bool read_only = false;
  const wire::FieldDescriptor* field = nullptr;      // of the schema; nullptr: a text
  const wire::FieldDescriptor* automatic = nullptr;  // the switch behind has_auto
  double per_unit = 1.0;                             // a value here over one of the schema
};

// Those of a schema such as wire::Controls that have a `signalk` key, in its order, then the texts.
// No step given: 1 of the schema's units.
std::vector<ControlDefinition> definitions_of(const wire::Descriptor& schema);

// Those of wire::Controls, in the order of their ids.  Made once; lives for ever.
const std::vector<ControlDefinition>& control_definitions();

// nullptr if there is no control of that name.
const ControlDefinition* find_control(std::string_view key);

// A control as capabilities and meta deltas describe it.
Json definition_document(const ControlDefinition& definition);

inline constexpr int kNoTransmitSectors = 4;
inline constexpr std::string_view kPower = "power";
inline constexpr double kPowerOff = 0, kPowerStandby = 1, kPowerTransmit = 2;

}  // namespace skerry::signalk
