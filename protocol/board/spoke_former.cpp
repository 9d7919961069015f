#include "protocol/board/spoke_former.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::board {
namespace {

void add_to(std::vector<std::int32_t>& sums, const std::vector<std::uint16_t>& samples) {
  std::int32_t* const sum = sums.data();
  const std::uint16_t* const sample = samples.data();
  const std::size_t count = std::min(sums.size(), samples.size());
  for (std::size_t i = 0; i < count; ++i) sum[i] += sample[i];
}

// floor((sum + pulses / 2) / pulses), exactly: with half a step added, no quotient of a sum below
// 2^31 by up to 32767 comes nearer to a whole number than 2^-16, and the product is off by less
// than 2^-35.
void mean_of(const std::vector<std::int32_t>& sums, std::uint32_t pulses,
             std::vector<std::uint16_t>& samples) {
  samples.resize(sums.size());
  const double share = 1.0 / pulses, half = 0.5 + pulses / 2;
  const std::int32_t* const sum = sums.data();
  std::uint16_t* const sample = samples.data();
  const std::size_t count = sums.size();
  for (std::size_t i = 0; i < count; ++i) {
    sample[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>((sum[i] + half) * share));
  }
}

}  // namespace

bool SpokeFormer::belongs(const SweepMeta& meta, std::uint32_t index) const {
  const std::uint64_t half_turn = std::uint64_t{meta_.acp_period} * meta_.acp_per_turn / 2;
  return pulses_ < kMaxPulses && index == index_ && meta.radar == meta_.radar &&
         meta.sample_clock_hz == meta_.sample_clock_hz && meta.delay_ticks == meta_.delay_ticks &&
         meta.pulse_ns == meta_.pulse_ns && meta.channels == meta_.channels &&
         meta.trigger_tick >= first_tick_ &&
         (half_turn == 0 || meta.trigger_tick - first_tick_ < half_turn);
}

void SpokeFormer::add(const Sweep& sweep, const Spoke& spoke) {
  const double in_spokes = azimuth_turns(sweep.meta) * spokes_;
  const double nearest = std::floor(in_spokes + 0.5);
  const double distance = std::fabs(in_spokes - nearest);
  const std::uint32_t index = static_cast<std::uint32_t>(nearest) % spokes_;
  if (pulses_ > 0 && !belongs(sweep.meta, index)) finish(spoke);
  if (pulses_ == 0) {
    index_ = index;
    first_tick_ = sweep.meta.trigger_tick;
    faults_ = 0;
    for (std::size_t c = 0; c < 2; ++c) sums_[c].assign(sweep.samples[c].size(), 0);
  }
  if (pulses_ == 0 || distance < nearest_) {
    nearest_ = distance;
    meta_ = sweep.meta;
  }
  faults_ |= sweep.meta.faults;
  for (std::size_t c = 0; c < 2; ++c) add_to(sums_[c], sweep.samples[c]);
  ++pulses_;
}

void SpokeFormer::finish(const Spoke& spoke) {
  if (pulses_ == 0) return;
  out_.meta = meta_;
  out_.meta.pulses = pulses_;
  out_.meta.faults = faults_;
  out_.meta.spoke = index_;
  out_.meta.spokes_per_turn = spokes_;
  for (std::size_t c = 0; c < 2; ++c) mean_of(sums_[c], pulses_, out_.samples[c]);
  pulses_ = 0;
  spoke(out_);
}

}  // namespace skerry::board
