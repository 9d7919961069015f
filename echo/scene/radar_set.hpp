// RadarSet: antenna, transmitter and receiver front end, as constants of the equipment.
#pragma once

#include "protocol/video/range_scale.hpp"

namespace skerry::echo {

struct Pulse {
  double length_s = 0.0;
  double bandwidth_hz = 0.0;  // of the receiver behind it
};

// Defaults: a 25 kW X-band set with a 6 ft antenna.  Source: physics.md B1 (typical brochures).
struct RadarSet {
  double frequency_hz = 9.41e9;
  double peak_power_w = 25e3;
  double antenna_gain_db = 31.0;
  double beam_width_deg = 1.2;  // horizontal, one way, -3 dB
  double antenna_height_m = 20.0;
  double noise_figure_db = 5.0;
  double losses_db = 3.0;  // feeder and radome, both ways

  // Pulse by range scale: short to 1.5 NM, medium to 12 NM, long beyond.  Source: physics.md B1.
  static constexpr Pulse pulse_for(RangeScale scale) {
    const double nm = scale.in_nautical_miles();
    if (nm <= 1.5) return {0.08e-6, 20e6};
    if (nm <= 3.0) return {0.25e-6, 10e6};
    if (nm <= 12.0) return {0.5e-6, 5e6};
    return {1.0e-6, 3e6};
  }
};

}  // namespace skerry::echo
