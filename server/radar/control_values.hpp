// The bridge between the echo's controls (rows) and messages that carry them (schema): the only
// place where the two meet.
#pragma once

#include <string>

#include "echo/receiver/control_row.hpp"
#include "protocol/wire/controls.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::server {

// Copies what of the rows is present in `message` into `controls`; the rest stays.  False if a
// value is one that the control cannot have; `controls` may be half changed then.
template <typename Rows, typename Controls>
bool read_controls(const Rows& rows, const wire::Message& message, Controls& controls,
                   const wire::Descriptor& schema = *wire::Controls::descriptor()) {
  for (const auto& row : rows) {
    const auto value = wire::value_of(message, *schema.FindFieldByName(std::string(row.name)));
    if (!value) continue;
    if (!row.allows(*value)) return false;
    row.set(controls, *value);
  }
  return true;
}

// Copies all rows into `message`, as far as it has a place for them.
template <typename Rows, typename Controls>
void write_controls(const Rows& rows, const Controls& controls, wire::Message& message,
                    const wire::Descriptor& schema = *wire::Controls::descriptor()) {
  for (const auto& row : rows) {
    wire::put_value(message, *schema.FindFieldByName(std::string(row.name)), row.get(controls));
  }
}

inline bool read_controls(const wire::Message& message, echo::ViewControls& controls) {
  return read_controls(echo::kViewControlRows, message, controls);
}
inline bool read_controls(const wire::Message& message, echo::RadarControls& controls) {
  return read_controls(echo::kRadarControlRows, message, controls);
}
inline void write_controls(const echo::ViewControls& controls, wire::Message& message) {
  write_controls(echo::kViewControlRows, controls, message);
}
inline void write_controls(const echo::RadarControls& controls, wire::Message& message) {
  write_controls(echo::kRadarControlRows, controls, message);
}

}  // namespace skerry::server
