// A radar and an aim for tests of single artefacts.
#pragma once

#include <cmath>
#include <numbers>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

inline constexpr double kPi = std::numbers::pi, kDegree = kPi / 180.0;

inline double decibels(double power) { return 10.0 * std::log10(power); }

inline RadarModel small_model(double nm = 1.5, RadarSet set = {}) {
  const ScanGeometry geometry{4096, 1024, 8};
  return radar_model(set, geometry, *RangeScale::find(nm), {set.rpm, 4096}, 0);
}

inline std::uint32_t units(double bearing_deg) {
  return RelativeBearing::from(degrees(bearing_deg)).units();
}

// The bow points to the plane's `heading_deg`.
inline SpokeAim aim_at(double relative_deg, double seconds = 0.0, double heading_deg = 0.0) {
  SpokeAim aim;
  aim.dt = seconds;
  aim.relative_units = units(relative_deg);
  aim.true_units = aim.plane_units = units(relative_deg + heading_deg);
  return aim;
}

}  // namespace skerry::echo
