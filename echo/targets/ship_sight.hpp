// ShipSight: a ship as the antenna sees her at one instant.
#pragma once

#include "echo/kernel/exact_math.hpp"
#include "echo/scene/targets.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {

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
