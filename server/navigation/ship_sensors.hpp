// The errors of a simulated ship's sensors: what her compass and her GNSS receiver say of her.
#pragma once

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// How far sensors are off, one standard deviation; all 0: they are exact.  Noise is another one
// every tenth of a second.  The ship yaws about her heading by sines of 7 and 11 s of together
// `yaw_deg` at most, and her course over ground wanders by one of 23 s.
// The defaults are small beside what a display shows, and never 0: some displays redraw only when
// a value changes.  They are assumptions.
struct SensorErrors {
  double heading_deg = 0.05;
  double yaw_deg = 0.1;
  double course_deg = 0.1;
  double speed_kn = 0.03;
  double position_m = 0.5;  // north and east each

  static constexpr SensorErrors none() { return {0.0, 0.0, 0.0, 0.0, 0.0}; }
  friend bool operator==(const SensorErrors&, const SensorErrors&) = default;
};

// The ship as her sensors tell of her.  The same ship and time give the same errors, whoever asks.
// What is not known stays so; a ship that is driven from outside has sensors of her own, and is
// left as she is.
wire::OwnShip sensed(const wire::OwnShip& ship, const SensorErrors& errors);

}  // namespace skerry::server
