#include "echo/targets/target_medium.hpp"

#include <algorithm>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

// Nearer than this nothing gets louder: inside the antenna's own near field.
double two_way_spread(double range_m) {
  const double r2 = std::max(25.0, range_m * range_m);
  return r2 * r2;
}

}  // namespace

double TargetMedium::free_space_snr(double range_m) const {
  return unit_snr / two_way_spread(range_m);
}

double TargetMedium::body_snr(double range_m, double height_m) const {
  const double free_space = free_space_snr(range_m);
  if (propagation) return free_space * static_cast<double>(propagation->body(range_m, height_m));
  return free_space * std::max(0.0, 1.0 - hidden_height(range_m, antenna_height_m) / height_m);
}

double TargetMedium::point_snr(double range_m, double height_m) const {
  const double free_space = free_space_snr(range_m);
  if (propagation) return free_space * static_cast<double>(propagation->point(range_m, height_m));
  const double share = 1.0 - hidden_height(range_m, antenna_height_m) / height_m;
  return free_space * std::clamp(4.0 * share, 0.0, 1.0);
}

double TargetMedium::effective_earth_m() const {
  return propagation ? propagation->effective_earth_m() : kEffectiveEarth;
}

}  // namespace skerry::echo
