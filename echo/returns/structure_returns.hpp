// Echoes of bridges, piers, pontoons, buildings, masts, buoys and beacons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/shore_returns.hpp"
#include "echo/scene/structure_index.hpp"

namespace skerry::echo {

struct StructureModel {
  double cell_m = 1.0;
  double antenna_height_m = 20.0;
  double unit_signal_to_noise = 1.0;   // radar_equation.hpp
  std::uint32_t ray_units = 1u << 20;  // from ray to ray, at most a 64th of a turn
};

// Gamma of a vertical face: sigma = gamma times the area it shows across the line of sight.
// Source: SOURCES.md "Land", -5 to 0 dB: breakwaters (loose rock) -5, bridges (girders) 0, the rest
// -3.
double wall_gamma(ObjectClass kind);

// The echo of a wall for each metre along the line of sight, in metres across it: fenders, piles,
// girders.  So a
// pier that points at the antenna still echoes.
inline constexpr double kAlongTheLine = 0.05;

// A building or landmark the (synthetic) ground would swallow stands out of it by so much, metres.
inline constexpr double kStandsOut = 8.0;

// The structures that may echo on one ray.
struct NearStructures {
  std::vector<std::uint32_t> walls, points;
  bool any() const { return !walls.empty() || !points.empty(); }
};
void find_structures(const StructureIndex& index, const Ray& ray, const StructureModel& model,
                     NearStructures& near);

// Adds the mean signal-to-noise ratio of `near` to power, and says whether any was added.
// Each structure is shared between the two rays it lies between in proportion to nearness, so the
// sum over all rays is what it returns in all.
// A wall: the part of it between the neighbouring rays, found by intersection, spread over the
// cells it covers; gamma times visible height times (what it spans across the line of sight +
// kAlongTheLine of what it spans along it).  A point: its cross-section.
// The visible part is what stands out above the Earth's curve and above the shadow of the land
// before it (`ground`, or null).  Walls throw no shadow, on land, each other or points; both faces
// echo.
// Error: a part's range is taken from its ends, so a face square to the ray is off by at most
// R angle^2 / 8, 0.3 mm at 1 km for 4096 rays.
bool add_structures(const StructureIndex& index, const NearStructures& near, const Ray& ray,
                    const StructureModel& model, const GroundProfile* ground,
                    std::span<float> power);

}  // namespace skerry::echo
