// Echoes of land and structures on one ray, before beam and receiver.
#pragma once

#include <cstdint>
#include <span>

#include "echo/radar/radar_set.hpp"
#include "echo/returns/static_ray.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// The part that is the same for all rays.
struct RayModel {
  RadarSet set;
  Pulse pulse;
  std::uint32_t rays_per_turn = 4096;
  std::uint32_t cells = 1024;
  double cell_m = 1.0;
};

using RayScratch = StaticScratch;

// Mean signal-to-noise ratio per cell of land and structures on the ray at `relative_units` from
// the bow, `dt` seconds after the scene's time; pulse length included.  Returns false, and leaves
// `power` zero, where nothing echoes.  Pure: depends on nothing but its arguments.  One ray by
// itself, in the plain way; pictures are made by StaticReturns, which keeps rays from turn to turn.
bool ray_returns(const Scene& scene, const RayModel& model, std::uint32_t relative_units, double dt,
                 RayScratch& scratch, std::span<float> power);

}  // namespace skerry::echo
