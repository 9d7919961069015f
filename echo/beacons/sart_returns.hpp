// SartReturns: search and rescue transponders.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/beacons/listening.hpp"
#include "echo/radar/antenna_pattern.hpp"

namespace skerry::echo {

// How a SART sweeps.  Source: SOURCES.md "Beacons" (IMO SN/Circ.197): 9200 to 9500 MHz, twelve
// times down in 0.4 us and up again in 7.5 us.  That it sweeps up slowly is by choice: no source
// read says so.
struct SartSweep {
  static constexpr double kLeastHz = 9.2e9, kMostHz = 9.5e9;
  static constexpr double kFast = 0.4e-6, kSlow = 7.5e-6;  // seconds
  static constexpr double kCycle = kFast + kSlow;
  static constexpr std::uint32_t kCycles = 12;
  // Transmitter and receiver, by choice: they make 8 NM of a 25 kW set, as the circular says.
  static constexpr double kEirp = 0.4;               // W
  static constexpr double kThreshold = 1e-3 * 1e-5;  // W, -50 dBm from an isotropic antenna

  // When in the cycle the sweep passes a frequency within the band, seconds from its beginning.
  static double fast_at(double frequency_hz) {
    return kFast * (kMostHz - frequency_hz) / (kMostHz - kLeastHz);
  }
  static double slow_at(double frequency_hz) {
    return kFast + kSlow * (frequency_hz - kLeastHz) / (kMostHz - kLeastHz);
  }
};

// The answer of a receiver of that bandwidth to a sweep of `hz_per_s` through it: power of its
// answer against a steady carrier, and how long that lasts.  For a Gaussian filter of that
// half-power width, exactly: with x = (2 ln 2 / pi) rate / B^2 the power is 1 / sqrt(1 + x^2) and
// the length B sqrt(1 + x^2) / rate; for slow sweeps B / rate: 11, 37, 75 m at 3, 10, 20 MHz
// (SOURCES.md "Beacons"). A SART's slow sweep loses 3.4 dB at 3 MHz and 0.9 dB at 5 MHz, its fast
// one 15.7 dB and 11.2 dB. Held by SartReturns.TheAnswerToASweepIsThatOfAGaussianFilter.
struct SweptAnswer {
  double power = 1.0;
  double length_s = 0.0;
};
SweptAnswer swept_answer(double bandwidth_hz, double hz_per_s);

// Twelve dots outwards from behind the mark, 0.64 NM apart, in X-band radars alone; within about
// 1 NM twelve weaker and shorter ones of the fast sweeps between them; arcs when near and rings
// when very near, for the side lobes trigger it too.  A receiver off its tune keeps them: the sweep
// passes whatever it listens to.  One-way, R^-2, answered within threshold and horizon.
// Error: the delay before the first sweep is left out (75 m at most).  The fade of the fast dots
// beyond 1 NM, R^-6, stands for what the circular describes and is not derived.
class SartReturns {
 public:
  static constexpr double kFastSeenWithin = 1852.0;  // metres

  void prepare(const Listening& at);
  bool any() const { return !replies_.empty(); }
  // Thread: any, after prepare().
  void add(const AntennaPattern& pattern, const SpokeAim& aim, std::span<float> power) const;

 private:
  struct Reply {
    std::uint32_t bearing_units;
    float level;                  // of the axis, from which it is triggered and heard
    float slow, fast;             // power on the axis, over noise
    double slow_cell, fast_cell;  // where the first dot begins
  };
  std::vector<Reply> replies_;
  double cycle_cells_ = 0.0, slow_cells_ = 0.0, fast_cells_ = 0.0;
};

}  // namespace skerry::echo
