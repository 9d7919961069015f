// EchoSplat: lays points into spokes through the beam and the pulse.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Points of one sector, ready to be added to any of its spokes.
class EchoSplat {
 public:
  explicit EchoSplat(const RadarModel& model);

  // Side lobes: each point is also laid where the beam's side lobes meet it, as far as it stands
  // out there.  `first`, `last`: aims of the sector's ends.
  void prepare(std::vector<PointEcho> points, const SpokeAim& first, const SpokeAim& last,
               bool side_lobes);

  // Adds to power[i] what cell i of that spoke gets.  Thread: any, after prepare().
  void add(const SpokeAim& aim, std::span<float> power) const;

 private:
  RadarModel model_;
};

}  // namespace skerry::echo
