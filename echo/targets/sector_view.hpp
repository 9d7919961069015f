// SectorView and ShipSight: from where, when and over which bearings one sector looks at targets.
#pragma once

#include <cmath>
#include <cstdint>

#include "echo/kernel/exact_math.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/scene/targets.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {

// A place as seen from the antenna.
struct Polar {
  double range_m = 0.0;
  std::uint32_t units = 0;  // clockwise from the plane's north, 2^32 = one turn
};
Polar polar_of(PlanePoint from_own_ship);
// Radians, either sense, any number of turns below 2^30.
std::uint32_t units_of_radians(double radians);

// All targets of a sector are taken where they are in its middle: with 16 spokes of 4096 at 24 rpm
// that is 5 ms off at its ends, 0.1 m at 20 m/s.
class SectorView {
 public:
  // `reach_units`: to either side of the axis, how far the beam sees.  Requires first to last to
  // be less than half a turn.
  SectorView(const SpokeAim& first, const SpokeAim& last, std::uint32_t reach_units);

  double dt() const { return dt_; }  // seconds after the scene's time
  PlanePoint own_ship() const { return own_ship_; }
  std::uint32_t middle_units() const { return middle_units_; }

  PlanePoint from_own_ship(PlanePoint place, PlanePoint velocity) const {
    return place + velocity * dt_ - own_ship_;
  }

  // Whether a circle may lie under the beam at any spoke of the sector; never false where it does.
  bool meets(PlanePoint from_own_ship, double radius_m) const {
    const double along = ahead_of(middle_, from_own_ship);
    const double across = std::fabs(right_of(middle_, from_own_ship));
    return wide_ || (along >= -radius_m && across * half_.cos - along * half_.sin <= radius_m);
  }
  // How often, since the antenna's start, the beam has passed that bearing when it is nearest to it
  // around this sector: one number for all spokes that see a target on one turn, also across the
  // bow, where the scan's number changes.
  std::uint32_t pass(std::uint32_t plane_units) const {
    const std::uint64_t spoke = (std::uint64_t{scan_} << 32) + shown_units_;
    const std::uint32_t target = plane_units - plane_units_ + shown_units_;
    return static_cast<std::uint32_t>((spoke - target + (std::uint64_t{1} << 31)) >> 32);
  }

 private:
  double dt_;
  PlanePoint own_ship_;
  std::uint32_t middle_units_;
  SinCos middle_, half_;
  bool wide_;
  std::uint32_t scan_, shown_units_, plane_units_;
};

struct ShipSight {
  PlanePoint from_own_ship;
  Polar at;
  SinCos bow;         // of her heading
  double side = 0.0;  // sine of the aspect: 0 bow or stern on, 1 abeam
  double ahead = 1.0;
  std::uint32_t aspect_units = 0;  // the radar's bearing from her bow
};
ShipSight sight_of(const Hull& hull, const SectorView& view);

// A circle about all of her.
inline double radius_of(const Hull& hull) { return 0.5 * (hull.length_m + hull.beam_m) + 1.0; }

}  // namespace skerry::echo
