// The controls of a radar and of a view.
#pragma once

#include "echo/radar/radar_set.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::echo {

// What is on the air, common to all views.
struct RadarControls {
  bool transmit = true;
  PulseChoice pulse = PulseChoice::automatic;
  bool tune_auto = true;
  double tune = 50.0;  // 0 to 100 by hand; 50 is right on the frequency
  friend bool operator==(const RadarControls&, const RadarControls&) = default;
};

// All but the range scale and the switches run from 0 to 100, as on a real set.
struct ViewControls {
  RangeScale range_scale;
  double gain = 50.0;
  double sea = 20.0;                    // sensitivity time control
  double rain = 0.0;                    // differentiation (fast time constant)
  double interference_rejection = 0.0;  // 0: off
  double echo_stretch = 0.0;            // 0: off; 100: three cells to either side
  double integration = 0.0;             // 0: off; 100: over all spokes of a beam
  bool sea_auto = false;                // follows the clutter by itself; `sea` then trims about 50
  friend bool operator==(const ViewControls&, const ViewControls&) = default;
};

}  // namespace skerry::echo
