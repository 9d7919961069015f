// SpokeAim: when, from where and whither one spoke looks.
#pragma once

#include <cstdint>

#include "echo/radar/spoke_clock.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// Bearings are binary angles, 2^32 = one turn, clockwise.
struct SpokeAim {
  std::uint64_t spoke = 0;           // from the antenna's start
  std::uint32_t scan = 0;            // turns from the antenna's start
  std::uint32_t index = 0;           // within the turn
  double dt = 0.0;                   // seconds after the scene's time
  std::uint32_t shown_units = 0;     // from the bow, as the picture has it
  std::uint32_t relative_units = 0;  // from the bow; less than that by the alignment of the picture
  std::uint32_t true_units = 0;      // from true north
  std::uint32_t plane_units = 0;     // from the plane's north
  PlanePoint own_ship;               // the antenna, in the plane
};

SpokeAim aim_of(const Scene& scene, const SpokeClock& clock, std::uint64_t spoke);

}  // namespace skerry::echo
