// SpokeFormer: spokes out of sweeps, by azimuth, as a digitiser makes them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "protocol/board/sweep_record.hpp"

namespace skerry::board {

// Sums the pulses whose azimuth lies within half a spoke of the spoke's own and gives their mean,
// rounded to the nearest step, halves upwards.  Spokes come in the order of their azimuth, each
// when the first pulse of another one has come; one without a pulse does not come.  The pulses to
// either side of the ARP are of one spoke, number 0.  A sweep of another radar, format, delay or
// sample clock begins a new spoke, and so does one half a turn later at the same azimuth (a gap, or
// an antenna that stands still).  Thread: one at a time.
class SpokeFormer {
 public:
  using Spoke = std::function<void(const Sweep&)>;

  // spokes_per_turn: 256 .. 16384.
  explicit SpokeFormer(std::uint32_t spokes_per_turn) : spokes_(spokes_per_turn) {}

  // `spoke` gets what is finished by it: its `meta` is that of the pulse nearest the spoke's own
  // azimuth, with the number of pulses and all faults that any of them had.
  void add(const Sweep& sweep, const Spoke& spoke);
  // Gives out the spoke that has begun, as it is.
  void finish(const Spoke& spoke);

  // More begin a new spoke: sums stay below 2^31.
  static constexpr std::uint32_t kMaxPulses = 32'767;

 private:
  bool belongs(const SweepMeta& meta, std::uint32_t index) const;

  std::uint32_t spokes_;
  std::uint32_t index_ = 0, pulses_ = 0, faults_ = 0;
  double nearest_ = 0.0;          // turns from the spoke's azimuth, of the pulse that meta_ is of
  std::uint64_t first_tick_ = 0;  // of the first pulse
  SweepMeta meta_;
  std::array<std::vector<std::int32_t>, 2> sums_;
  Sweep out_;
};

}  // namespace skerry::board
