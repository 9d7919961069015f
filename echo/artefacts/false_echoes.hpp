// FalseEchoes: echoes of real things in places where they are not.
#pragma once

#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Multiple echoes of ships and bridges (multiple_echoes.hpp, indirect_echoes.hpp) and indirect ones
// (indirect_echoes.hpp), as points to be laid through beam and pulse like any others.
// They come over the mast, not past it: lay them after the own ship's shadow (shadow_sectors.hpp).
// Cost: one comparison of bearings per strong point and sector, and for each obstruction in the
// sector the same again; nothing where nothing is strong.
// Thread: any.
class FalseEchoes {
 public:
  // No more per sector: the strongest stay.
  static constexpr std::size_t kMostEchoes = 1024;
  // Power over noise below which a false echo is left out.
  static constexpr float kLeastPower = 0.25f;

  explicit FalseEchoes(const RadarModel& model);

  // Appends to `out` the false echoes that spokes from `first` to `last` can show.  `seen`: what
  // they see in their main lobes, in detail; it comes back by way of the own hull.  `strong`: what
  // stands out all round; it comes in by way of the masts.  Of both: points of one body together,
  // powers in the middle of the beam and without the own ship's shadow; either may be `out` itself.
  // Pure.
  void add(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
           std::span<const PointEcho> seen, std::span<const PointEcho> strong,
           std::vector<PointEcho>& out) const;
  // The same list for both.
  void add(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
           std::span<const PointEcho> points, std::vector<PointEcho>& out) const {
    add(scene, first, last, points, points, out);
  }

 private:
  RadarModel model_;
  std::uint32_t reach_units_;  // of the main lobe, to either side
};

}  // namespace skerry::echo
