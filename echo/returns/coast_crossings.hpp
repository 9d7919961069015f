// Where a ray meets the coast.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/scene/coast_picture.hpp"
#include "echo/scene/polar_index.hpp"

namespace skerry::echo {

struct Crossing {
  double range_m;
  bool into_land;
};

struct LandInterval {
  double begin_m, end_m;
};

// A ray from `own_ship` toward `bearing_units` (clockwise from the plane's north).
struct Ray {
  PlanePoint own_ship;
  std::uint32_t bearing_units = 0;
};

// All crossings of the ray with candidate edges, nearest first.  Analytic: the range of the
// intersection of two straight lines in double.  A ray through a vertex meets exactly one of the
// two edges there (half-open rule), so crossings alternate between into and out of land. Error:
// 1e-6 m for coordinates below 1e6 m, except along edges that point at the own ship, where the
// range along the edge is undefined by as much.
void find_crossings(const CoastPicture& coast, const PolarIndex& index, const Ray& ray,
                    std::vector<Crossing>& crossings);

// The stretches of land along a ray up to `range_m`.  Where a ray meets nothing, all of it is what
// the picture's centre is.
void land_along(const std::vector<Crossing>& crossings, bool centre_ashore, double range_m,
                std::vector<LandInterval>& land);

}  // namespace skerry::echo
