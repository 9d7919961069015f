#include "echo/returns/coast_crossings.hpp"

#include <algorithm>

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
    const double right_a = a.east_m * direction.cos - a.north_m * direction.sin;
    const double right_b = b.east_m * direction.cos - b.north_m * direction.sin;
    if ((right_a < 0.0) == (right_b < 0.0)) return;
    const double along_a = a.east_m * direction.sin + a.north_m * direction.cos;
    const double along_b = b.east_m * direction.sin + b.north_m * direction.cos;
    const double range = along_a + (along_b - along_a) * (right_a / (right_a - right_b));
    // Land is left of a -> b: an edge that runs to the right has it on the far side.
    if (range >= 0.0) crossings.push_back({range, right_a < 0.0});
  };
  for (std::uint32_t vertex : index.candidates(ray.bearing_units)) test(vertex);
  for (std::uint32_t vertex : index.near_edges()) test(vertex);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& p, const Crossing& q) {
    return p.range_m != q.range_m ? p.range_m < q.range_m : p.into_land < q.into_land;
  });
}

void land_along(const std::vector<Crossing>& crossings, bool centre_ashore, double range_m,
                std::vector<LandInterval>& land) {
  land.clear();
  int depth = 0, least = 0;
  for (const Crossing& c : crossings) least = std::min(least, depth += c.into_land ? 1 : -1);
  depth = crossings.empty() ? (centre_ashore ? 1 : 0) : -least;
  double begin = 0.0;
  for (const Crossing& c : crossings) {
    if (c.range_m >= range_m) break;
    const int before = depth;
    depth += c.into_land ? 1 : -1;
    if (before == 0 && depth > 0) begin = c.range_m;
    if (before > 0 && depth == 0) land.push_back({begin, c.range_m});
  }
  if (depth > 0 && begin < range_m) land.push_back({begin, range_m});
}

}  // namespace skerry::echo
