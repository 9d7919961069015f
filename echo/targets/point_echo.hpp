// PointEcho: what a point sends back, on its way into the spokes.
#pragma once

#include <cstdint>

namespace skerry::echo {

struct PointEcho {
  double range_m = 0.0;             // from the antenna
  std::uint32_t bearing_units = 0;  // clockwise from the plane's north, 2^32 = one turn
  float power = 0.0f;               // signal over noise in the middle of the beam
  float phase = 0.0f;               // turns; points of one body in one cell add as voltages
  std::uint32_t body = 0;           // points with the same number are one body
  float height_m = 0.0f;            // over the water, for shadows
};

}  // namespace skerry::echo
