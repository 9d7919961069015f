// SpokeLand: lays a sector's land into its rows, with the speckle of each spoke.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/clutter/speckle.hpp"
#include "echo/kernel/moved_row.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/returns/static_returns.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Land of one or two spokes, `first` the first of them in its sector: its echoes, and where no
// water is seen.
struct LandShare {
  std::uint32_t first = 0, count = 0;
  SpokeAim aim;  // their middle
  std::vector<MovedRun> runs;
  std::vector<CellRun> dry;
};

// Immutable; any thread.
class SpokeLand {
 public:
  explicit SpokeLand(const RadarModel& model);

  // All cells of the rows of the share's spokes, as many as `aims` and rows; 0 where no land is.
  void lay(std::uint64_t seed, std::span<const MovedRun> runs, std::span<const SpokeAim> aims,
           std::span<const std::span<float>> rows) const;

 private:
  SpeckledRow speckled(std::uint64_t seed, std::span<const MovedRun> runs, const SpokeAim& aim,
                       std::span<float> row) const;

  std::uint32_t radar_, spokes_per_turn_;
  std::shared_ptr<const Speckle> speckle_;
};

}  // namespace skerry::echo
