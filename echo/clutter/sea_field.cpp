#include "echo/clutter/sea_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "echo/clutter/lattice_field.hpp"
#include "echo/clutter/nrl_sea.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kValuesPerLength = 4.0;
// The gamma texture of a Gaussian correlation of 0.5 to 0.65 is correlated by 1/e.
constexpr double kLonger = 1.2;

const std::vector<std::uint32_t>& ring() {
  static const std::vector<std::uint32_t> values =
      packed_ring(lattice_field(kValuesPerLength, kValuesPerLength, 0x7E87E5EAull));
  return values;
}

}  // namespace

SeaField::SeaField(const SeaSurface& sea, std::uint64_t seed)
    : seed_(seed), downwind_deg_(sea.wind_from_deg + 180.0) {
  const double wind = wind_of_sea_state(sea.state);
  crosswind_m_ = std::max(2.0, kLonger * 0.5 * std::numbers::pi * wind * wind / kGravity);
  downwind_m_ = 2.0 * crosswind_m_;
  group_speed_ = 0.57 * wind;
}

double SeaField::inverse_length2(double east, double north) const {
  const SinCos down = sin_cos_degrees(downwind_deg_);
  const double a = (east * down.sin + north * down.cos) / downwind_m_;
  const double c = (east * down.cos - north * down.sin) / crosswind_m_;
  return a * a + c * c;
}

FieldWalk SeaField::walk_of_layer(std::int64_t layer, PlanePoint from, double east, double north,
                                  double first_m, double step_m, double seconds) const {
  const std::uint64_t own = mixed(seed_, static_cast<std::uint64_t>(layer), 0x1A7E4);
  const double turned = 30.0 * as_unit(mixed(own, 1)) - 15.0;
  const double speed = group_speed_ * (0.8 + 0.4 * as_unit(mixed(own, 2)));
  const SinCos down = sin_cos_degrees(downwind_deg_ + turned);
  const double along_scale = kValuesPerLength / downwind_m_;
  const double across_scale = kValuesPerLength / crosswind_m_;
  const double drift = speed * (seconds - static_cast<double>(layer) * kEpoch);
  const PlanePoint start = {from.east_m + east * first_m, from.north_m + north * first_m};
  const double along = (ahead_of(down, start) - drift) * along_scale;
  const double across = right_of(down, start) * across_scale;
  const double whole_along = std::floor(along), whole_across = std::floor(across);
  FieldWalk walk;
  walk.origin = static_cast<std::uint32_t>(own >> 32) +
                static_cast<std::uint32_t>(static_cast<std::int64_t>(whole_along)) +
                static_cast<std::uint32_t>(static_cast<std::int64_t>(whole_across)) * kLatticeStep;
  walk.along = static_cast<float>(along - whole_along);
  walk.across = static_cast<float>(across - whole_across);
  walk.along_step = static_cast<float>((east * down.sin + north * down.cos) * step_m * along_scale);
  walk.across_step =
      static_cast<float>((east * down.cos - north * down.sin) * step_m * across_scale);
  return walk;
}

void SeaField::sample(PlanePoint from, double east, double north, double first_m, double step_m,
                      double seconds, std::uint32_t first, std::span<float> out) const {
  const double epochs = seconds / kEpoch;
  const double whole = std::floor(epochs);
  const auto layer = static_cast<std::int64_t>(whole);
  FieldWalk old = walk_of_layer(layer, from, east, north, first_m, step_m, seconds);
  FieldWalk young = walk_of_layer(layer + 1, from, east, north, first_m, step_m, seconds);
  const SinCos weight = sin_cos_degrees(90.0 * (epochs - whole));
  old.weight = static_cast<float>(weight.cos);
  young.weight = static_cast<float>(weight.sin);
  walk_field(ring(), kLatticeStep, old, young, first, out);
}

}  // namespace skerry::echo
