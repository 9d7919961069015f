// SpokeFormer: spokes out of sweeps, by azimuth, as a digitiser makes them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/board/sweep_record.hpp"

namespace skerry::board {

// Sums the pulses whose azimuth lies within half a spoke of the spoke's own and gives their mean,
// rounded to the nearest step.  Spokes come in the order of their azimuth, each when the first
// pulse of a later one has come; one without a pulse does not come.  A sweep of another format or
// sample clock begins a new spoke. Thread: one at a time.
class SpokeFormer {
 public:
  using Spoke = std::function<void(const Sweep&)>;

  // spokes_per_turn: 256 .. 16384.
  explicit SpokeFormer(std::uint32_t spokes_per_turn) : spokes_(spokes_per_turn) {}

  void add(const Sweep& sweep, const Spoke& spoke);
  // What is begun is given out as it is.
  void finish(const Spoke& spoke);

 private:
  std::uint32_t spokes_;
  std::uint32_t index_ = 0, pulses_ = 0;
  SweepMeta meta_;  // of the pulse nearest the spoke's azimuth
  std::array<std::vector<std::uint32_t>, 2> sums_;
};

}  // namespace skerry::board
