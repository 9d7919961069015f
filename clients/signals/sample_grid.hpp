// SampleGrid: ticks of the sample clock onto the samples of a waveform.
#pragma once

#include <cstdint>
#include <numeric>

namespace skerry::client {

// Sample m stands for the ticks t (counted from the beginning of the recording) with
// floor(t * rate / clock) = m, exactly, for recordings of any length: nothing is added up.
class SampleGrid {
 public:
  // Requires 0 < rate_hz <= clock_hz and ticks < 2^48 (25 days of a 125 MHz clock).
  SampleGrid(std::uint32_t clock_hz, std::uint32_t rate_hz, std::uint64_t ticks)
      : clock_hz_(clock_hz),
        rate_hz_(rate_hz),
        ticks_(ticks),
        clock_(clock_hz / std::gcd(clock_hz, rate_hz)),
        rate_(rate_hz / std::gcd(clock_hz, rate_hz)) {}

  std::uint64_t index(std::uint64_t tick) const {
    if (clock_ == 1) return tick;
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(tick) * rate_ / clock_);
  }
  // The first tick of sample m.
  std::uint64_t first_tick(std::uint64_t m) const {
    if (clock_ == 1) return m;
    return static_cast<std::uint64_t>((static_cast<unsigned __int128>(m) * clock_ + (rate_ - 1)) /
                                      rate_);
  }
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t samples() const { return ticks_ == 0 ? 0 : index(ticks_ - 1) + 1; }
  std::uint32_t clock_hz() const { return clock_hz_; }
  std::uint32_t rate_hz() const { return rate_hz_; }

 private:
  std::uint32_t clock_hz_, rate_hz_;
  std::uint64_t ticks_;
  std::uint64_t clock_, rate_;  // their ratio in lowest terms
};

}  // namespace skerry::client
