// All that one ray brings back, before beam and receiver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/structure_returns.hpp"
#include "echo/scene/scene.hpp"
#include "echo/targets/hull_returns.hpp"

namespace skerry::echo {

// What does not change from ray to ray.
struct RayModel {
  RadarSet set;
  Pulse pulse;
  std::uint32_t rays_per_turn = 4096;
  std::uint32_t cells = 1024;
  double cell_m = 1.0;
};

// Working memory of one thread.
struct RayScratch {
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  std::vector<ShoreStretch> shores;
  GroundProfile ground;
  NearStructures structures;
  std::vector<Scatterer> scatterers;
  std::vector<float> stretch;
};

// Hulls that may lie under the rays made within half of `span` seconds before and after `dt`;
// filled once per sector so that a ray looks only at the ships near its bearing.
struct HullsInSight {
  struct Entry {
    std::uint32_t hull;
    std::uint32_t middle_units;  // bearing in the plane
    std::uint32_t reach_units;   // to either side
  };
  std::vector<Entry> entries;
};
HullsInSight hulls_in_sight(const Scene& scene, double dt, double span, const RayModel& model);

// Mean signal-to-noise ratio per cell of the ray at `relative_units` from the bow, `dt` seconds
// after the scene's time; pulse length included.  Returns false, and leaves `power` zero, where
// nothing echoes.  Pure: depends on nothing but its arguments.
bool ray_returns(const Scene& scene, const HullsInSight& hulls, const RayModel& model,
                 std::uint32_t relative_units, double dt, RayScratch& scratch,
                 std::span<float> power);

}  // namespace skerry::echo
