// One ray of what does not move: land and what is built on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/hash.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/shore_returns.hpp"
#include "echo/returns/shore_stretch.hpp"
#include "echo/returns/structure_returns.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// The common part of all rays from one place.
struct StaticView {
  const CoastPicture* coast = nullptr;
  const StructureIndex* structures = nullptr;  // serving `at`; null: none
  PlanePoint at;                               // the antenna
  GeoPoint geo;                                // a known place ...
  PlanePoint sailed;                           // ... and how far `at` is from it, metres
  std::uint32_t north_units = 0;               // bearing of true north in the plane
  bool ashore = false;
  ShoreWater water;
};

struct StaticRayModel {
  double cell_m = 1.0;
  double antenna_height_m = 20.0;
  double unit_snr = 1.0;
  std::uint32_t rays_per_turn = 4096;
};

// Working memory of one thread.
struct StaticScratch {
  std::vector<Crossing> crossings;  // of the ray; filled by the caller
  std::vector<LandInterval> land;
  std::vector<ShoreStretch> shores;
  GroundProfile ground;
  NearStructures structures;
  std::vector<float> stretch;
};

// The seed of land's relief and cover, from the scene's.
inline std::uint32_t land_seed(std::uint64_t scene_seed) {
  return static_cast<std::uint32_t>(mixed(scene_seed, 0x1A9D));
}

// Adds the mean signal-to-noise ratio per cell of the ray at `plane_units`, the pulse's length
// apart, whose crossings are scratch.crossings; leaves the land in scratch.land.  `profile`:
// whether scratch.ground is wanted, filled where there is land.  Returns false where nothing can
// echo. Pure.
bool add_static_ray(const StaticView& view, const StaticRayModel& model, std::uint32_t plane_units,
                    bool profile, StaticScratch& scratch, std::span<float> power);

}  // namespace skerry::echo
