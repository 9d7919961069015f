#include "echo/returns/coast_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {

void find_crossings(const CoastPicture& coast, const PolarIndex& index, const Ray& ray,
                    std::vector<Crossing>& crossings) {
  crossings.clear();
  const SinCos direction = sin_cos_units(ray.bearing_units);
  const auto test = [&](std::uint32_t vertex) {
    const PlanePoint a = coast.vertices[vertex] - ray.own_ship;
    const PlanePoint b = coast.vertices[vertex + 1] - ray.own_ship;
    // Distance to the right of the ray.
    const double right_a = right_of(direction, a);
    const double right_b = right_of(direction, b);
    if ((right_a < 0.0) == (right_b < 0.0)) return;
    const double along_a = ahead_of(direction, a);
    const double along_b = ahead_of(direction, b);
    const double range = along_a + (along_b - along_a) * (right_a / (right_a - right_b));
    // Land is left of a -> b: an edge that runs to the right has it on the far side.
    if (range >= 0.0) crossings.push_back({range, right_a < 0.0, coast.shore_of(vertex), vertex});
  };
  for (std::uint32_t vertex : index.candidates(ray.bearing_units)) test(vertex);
  for (std::uint32_t vertex : index.near_edges()) test(vertex);
  sort_crossings(crossings);
}

void sort_crossings(std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
    return p.range_m != q.range_m ? p.range_m < q.range_m : p.into_land < q.into_land;
  });
}

namespace {

constexpr double kSamePlace = 1e-6;  // metres

// Calls visit(crossing) for those that count, nearest first.
template <typename Visit>
void for_each_counting(const std::vector<Crossing>& crossings, double range_m, Visit&& visit) {
  for (std::size_t i = 0; i < crossings.size() && crossings[i].range_m < range_m; ++i) {
    const Crossing& c = crossings[i];
    if (c.range_m <= kSamePlace) continue;
    if (i + 1 < crossings.size() && crossings[i + 1].into_land != c.into_land &&
        crossings[i + 1].range_m - c.range_m <= kSamePlace) {
      ++i;
      continue;
    }
    visit(c);
  }
}

}  // namespace

void land_along(const std::vector<Crossing>& crossings, bool ashore, double range_m,
                std::vector<LandInterval>& land) {
  land.clear();
  int depth = 0, least = 0;
  bool any = false;
  for_each_counting(crossings, range_m, [&](const Crossing& c) {
    any = true;
    least = std::min(least, depth += c.into_land ? 1 : -1);
  });
  depth = any ? -least : (ashore ? 1 : 0);
  double begin = 0.0;
  std::uint8_t begin_shore = 0;
  std::uint32_t begin_edge = 0;
  for_each_counting(crossings, range_m, [&](const Crossing& c) {
    const int before = depth;
    depth += c.into_land ? 1 : -1;
    if (before == 0 && depth > 0) {
      begin = c.range_m;
      begin_shore = c.shore;
      begin_edge = c.edge;
    }
    if (before > 0 && depth == 0)
      land.push_back({begin, c.range_m, begin_shore, c.shore, begin_edge});
  });
  if (depth > 0 && begin < range_m) land.push_back({begin, range_m, begin_shore, 0, begin_edge});
}

double complete_range(const CoastPicture& coast, PlanePoint own_ship) {
  return coast.range_m + coast.slack_m - length_of(own_ship - coast.centre);
}

bool is_ashore(const CoastPicture& coast, const PolarIndex& index, PlanePoint own_ship) {
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  const double reach = complete_range(coast, own_ship);
  bool met = false;
  for (std::uint32_t k = 0; k < 64; ++k) {
    find_crossings(coast, index, {own_ship, k << 26}, crossings);
    bool counts = false;
    for_each_counting(crossings, reach, [&](const Crossing&) { counts = true; });
    if (!counts) continue;
    met = true;
    land_along(crossings, false, reach, land);
    if (land.empty() || land.front().begin_m > 0.0) return false;
  }
  return met || coast.centre_ashore;
}

}  // namespace skerry::echo
