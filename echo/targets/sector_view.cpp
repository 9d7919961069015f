#include "echo/targets/sector_view.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

namespace {
// Beyond this half-width everything is taken to be in sight.
constexpr std::uint32_t kWide = 0x38000000u;  // 79 deg
}  // namespace

std::uint32_t units_of_radians(double radians) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(radians * kUnitsPerRadian));
}

Polar polar_of(PlanePoint from_own_ship) {
  return {length_of(from_own_ship),
          units_of_radians(exact_atan2(from_own_ship.east_m, from_own_ship.north_m))};
}

SectorView::SectorView(const SpokeAim& first, const SpokeAim& last, std::uint32_t reach_units)
    : dt_(0.5 * (first.dt + last.dt)),
      own_ship_((first.own_ship + last.own_ship) * 0.5),
      scan_(first.scan),
      shown_units_(first.shown_units),
      plane_units_(first.plane_units) {
  const auto turned = static_cast<std::int32_t>(last.plane_units - first.plane_units);
  middle_units_ = first.plane_units + static_cast<std::uint32_t>(turned / 2);
  const std::int64_t half = std::int64_t{turned < 0 ? -(turned / 2) : turned / 2} + 1 + reach_units;
  wide_ = half >= kWide;
  middle_ = sin_cos_units(middle_units_);
  half_ = sin_cos_units(wide_ ? kWide : static_cast<std::uint32_t>(half));
}

ShipSight sight_of(const Hull& hull, const SectorView& view) {
  ShipSight sight;
  const PlanePoint p = view.from_own_ship(hull.centre, hull.velocity);
  sight.from_own_ship = p;
  sight.at = polar_of(p);
  const double heading = hull.heading_deg + hull.turn_rate_deg_s * view.dt();
  sight.bow = sin_cos_degrees(heading);
  const double range = std::max(1.0, sight.at.range_m);
  sight.ahead = std::min(1.0, std::fabs(ahead_of(sight.bow, p)) / range);
  sight.side = std::min(1.0, std::fabs(right_of(sight.bow, p)) / range);
  sight.aspect_units =
      sight.at.units + kUnitsPerHalfTurn - TrueBearing::from(degrees(heading)).units();
  return sight;
}

}  // namespace skerry::echo
