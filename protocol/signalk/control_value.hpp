// The present value of a control, and the value that a display wants.
#pragma once

#include <optional>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/signalk/control_table.hpp"
#include "protocol/signalk/json.hpp"

namespace skerry::signalk {

// Units of the definition.
struct ControlState {
  double value = 0.0;  // not of a text
  std::string text = {};
  std::optional<bool> automatic = {};  // of controls that have it
  std::optional<bool> enabled = {};    // sectors
  std::optional<double> end = {};      // sectors
  bool locked = false;                 // only the instructor may change it
};
Json state_document(const ControlDefinition& definition, const ControlState& state);

// Absent members stay as they are; at least one is present.
struct ControlChange {
  std::optional<double> value = {};
  std::optional<double> end = {};  // sectors
  std::optional<bool> automatic = {};
  std::optional<bool> enabled = {};  // sectors
};

// Reads the body of a PUT: {"value":x}, {"auto":b}, {"auto":b,"value":x}, "mode":"auto" or "manual"
// in place of "auto", the members of a sector, or x alone; "auto":false is no fault of a control
// without automatic; numbers also as texts, choices also by their label, and with "units" one of
// km, nm, kn, deg, rpm as well.  Members that are not known are passed over. Error: what is wrong
// with it and what is allowed.
Result<ControlChange, std::string> read_change(const Json& body,
                                               const ControlDefinition& definition);

}  // namespace skerry::signalk
