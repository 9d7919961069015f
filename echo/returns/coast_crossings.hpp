// The crossings of a ray with the coast.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/scene/coast_picture.hpp"
#include "echo/scene/polar_index.hpp"

namespace skerry::echo {

struct Crossing {
  double range_m;
  bool into_land;
  std::uint8_t shore = 0;  // index into CoastPicture::shores
  std::uint32_t edge = 0;  // by first vertex
};

// A stretch of land, and what shore it has where it begins and ends; 0 where it has none in sight.
struct LandInterval {
  double begin_m, end_m;
  std::uint8_t begin_shore = 0, end_shore = 0;
  std::uint32_t begin_edge = 0;  // by first vertex; means nothing where begin_m is 0
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

// Nearest first; of two at one place the one out of land first.
void sort_crossings(std::vector<Crossing>& crossings);

// The stretches of land along a ray up to `range_m`, which must not exceed complete_range().
// Crossings farther out are left out of account (the near shore of what they belong to may not be
// there), and so are two opposite ones at one place and any on the very spot.  A ray that first
// leaves land began on it; one that meets nothing is all land or none, as `ashore` says.
void land_along(const std::vector<Crossing>& crossings, bool ashore, double range_m,
                std::vector<LandInterval>& land);

// The range from `own_ship` within which the picture has all coast there is.
double complete_range(const CoastPicture& coast, PlanePoint own_ship);

// Whether `own_ship` lies on land, by the refined coast: all of the 64 rays that meet a shore begin
// on land.  Where none meets any, by the picture's centre.
bool is_ashore(const CoastPicture& coast, const PolarIndex& index, PlanePoint own_ship);

}  // namespace skerry::echo
