// TargetMedium: what lies between the radar and a target.
#pragma once

#include <cstdint>
#include <functional>

#include "echo/propagation/propagation.hpp"

namespace skerry::echo {

// Height over the water below which land hides what is at that bearing (clockwise from the plane's
// north) and range, metres; empty: nothing is hidden.
using HiddenHeight = std::function<float(std::uint32_t plane_units, double range_m)>;

// Without `propagation`: free space down to a sharp horizon.
struct TargetMedium {
  const Propagation* propagation = nullptr;
  double antenna_height_m = 20.0;
  double unit_snr = 1.0;

  // Signal over noise of 1 m2 in the middle of the beam: of a body that reaches from the water up
  // to that height, and of something at that height.
  double body_snr(double range_m, double height_m) const;
  double point_snr(double range_m, double height_m) const;
  double free_space_snr(double range_m) const;
  double effective_earth_m() const;
};

// Power of what stands at a height, of which `share` of the way down to the water is in sight: what
// echoes is taken to fill the upper quarter.
inline float upper_quarter(float share) {
  const float lit = 4.0f * share;
  return lit < 1.0f ? lit : 1.0f;
}

}  // namespace skerry::echo
