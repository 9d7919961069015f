// Ground and water that land hides along each ray of a turn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/returns/hidden_water.hpp"
#include "echo/returns/static_ray.hpp"

namespace skerry::echo {

// Memory: two bytes for kStep cells of each ray, and kMostRuns runs.  Thread: record() of different
// rays at once; reading any, between records.
class HiddenGround {
 public:
  // Below any slope that hides something.
  static constexpr double kNothingHidden = -1.0;

  // Rays of so many cells.  Runs are forgotten; a ray's shadow stays until it is recorded again.
  void reset(std::uint32_t rays, std::uint32_t cells);

  // From a ray that add_static_ray() has just made, with its profile.
  void record(std::uint32_t ray, const StaticRayModel& model, const StaticScratch& scratch);

  // The ray's runs of cells that are land, or water hidden behind land; kMostRuns at most, nearest
  // first.
  std::span<const CellRun> dry(std::uint32_t ray) const {
    const DryRuns& dry = dry_[ray];
    return {dry.runs.data(), dry.count};
  }
  // Fetches what dry() first looks at of a ray.
  void fetch(std::uint32_t ray) const { __builtin_prefetch(&dry_[ray]); }
  // Slope, from the antenna and less the Earth's drop, below which land hides what lies at that
  // cell; kNothingHidden where there is none.  Error: the slope of up to kStep - 1 cells nearer,
  // rounded down by at most 2^-15.
  double shadow_slope(std::uint32_t ray, std::uint32_t cell) const;

  std::size_t bytes() const;

 private:
  struct DryRuns {
    static constexpr std::size_t kMostRuns = 15;  // more are left out
    std::uint16_t count = 0;
    std::array<CellRun, kMostRuns> runs;
  };
  static constexpr std::uint32_t kStep = 8;

  std::uint32_t cells_ = 0;
  std::size_t steps_ = 0;              // of a ray
  std::vector<std::int16_t> shadows_;  // by ray, of kStep cells each
  std::vector<DryRuns> dry_;
};

}  // namespace skerry::echo
