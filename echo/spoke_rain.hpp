// SpokeRain: lays a sector's rain into its rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/clutter/rain_returns.hpp"
#include "echo/kernel/parallel_for.hpp"
#include "echo/kernel/shelf.hpp"
#include "echo/propagation/rain_path.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// The rain along a spoke changes over beam widths, so neighbours share what is found along the
// middle of them.  How many is rain_spokes(), a power of two; a group begins at a multiple of it.
// Error: the path lies less than a sixth of a beam width beside the spoke's own, and less than a
// twentieth of the radius of any even area.  The rate is then off by 0.1 of the greatest at most
// and 0.01 in the mean (root mean square), the loss by a tenth of itself and 0.8 dB; held by
// SpokeRain.SpokesOfAGroupSeeWhatEachWouldSee.  An antenna that sways looks along each spoke.
std::uint32_t rain_spokes(const Scene& scene, const RadarModel& model);

// The middle of the group of `together` spokes (a power of two) in which `spoke` is.
SpokeAim rain_aim(const Scene& scene, const SpokeClock& clock, std::uint64_t spoke,
                  std::uint32_t together);

class SpokeRain {
 public:
  explicit SpokeRain(const RadarModel& model);

  // Finds the rain of `aims.size()` spokes that follow each other.  `sways`: the antenna does, and
  // aims are those of its sway.  Thread: the radar's.
  void prepare(const Scene& scene, std::span<const SpokeAim> aims, bool sways,
               const ParallelFor& parallel);
  // To a row of a spoke that is prepared.  Thread: any, after prepare().
  void pass(std::uint64_t seed, const SpokeAim& aim, std::span<float> power) const;
  // What was prepared is not passed any more: its memory goes to whichever radar is next.  Not
  // needed.  Thread: the radar's.
  void release();

 private:
  struct Group {
    RainPath path;
    AlignedFloats echoes;  // per knot
  };
  static Shelf<std::vector<Group>>& shelf();

  RadarModel model_;
  RainReturns returns_;
  std::uint32_t together_ = 1;
  std::uint64_t first_group_ = 0;
  std::size_t count_ = 0;      // groups prepared
  std::vector<Group> groups_;  // at least `count_`
};

}  // namespace skerry::echo
