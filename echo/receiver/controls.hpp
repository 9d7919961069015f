// The controls of a view.
#pragma once

#include "protocol/video/range_scale.hpp"

namespace skerry::echo {

// All but the range scale run from 0 to 100, as on a real set.
struct ViewControls {
  RangeScale range_scale;
  double gain = 50.0;
  double sea = 20.0;  // sensitivity time control
  double rain = 0.0;  // differentiation (fast time constant)
  friend bool operator==(const ViewControls&, const ViewControls&) = default;
};

}  // namespace skerry::echo
