// RadialSpeeds: how fast what moves comes nearer, cell by cell: what a Doppler radar measures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/scene/scene.hpp"
#include "echo/targets/echo_splat.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {

// Radial speeds of ships and points that move over ground at kAfloat or more: the rate at which
// their range shrinks, own ship's motion included, so an approaching body is positive.  Land, sea,
// rain, marks and what lies still have none: a radar that is told its ship's way takes it off what
// stands.  A cell has the speed of the strongest of the bodies that the main lobe and the side
// lobes beside it have there, if that makes up half of the cell's echo or more; rain in front of it
// may weaken both. A body has one speed, that of its middle.
class RadialSpeeds {
 public:
  static constexpr double kAfloat = 0.25;  // m/s

  explicit RadialSpeeds(const RadarModel& model) : splat_(model) {}

  // Prepares the points of a sector, and those that side lobes may show there, as TargetReturns has
  // them.  Thread: the radar's.
  void prepare(const Scene& scene, const std::vector<PointEcho>& points, const StrongEchoes& strong,
               const SpokeAim& first, const SpokeAim& last);
  // closing[i]: m/s, 0 for none.  `power`: of the spoke, once its targets have been added.
  // Thread: any, after prepare().
  void find(const SpokeAim& aim, std::span<const float> power, std::span<float> closing) const;

 private:
  static float closing_of(const Scene& scene, const SectorView& view, std::uint32_t body);
  void keep_moving(const Scene& scene, const SectorView& view, const std::vector<PointEcho>& points,
                   std::vector<PointEcho>& kept);
  struct Mover {
    std::uint32_t body;
    float closing;
  };
  float speed_of(std::uint32_t body) const;

  EchoSplat splat_;
  std::vector<PointEcho> points_;
  StrongEchoes strong_;
  std::vector<Mover> movers_;  // by number of the body
};

}  // namespace skerry::echo
