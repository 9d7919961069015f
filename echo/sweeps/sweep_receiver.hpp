// SweepReceiver: one pulse's echo from its rows to the codes of a converter.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/log_receiver.hpp"
#include "echo/receiver/receiver_noise.hpp"
#include "echo/sweeps/sweep_echoes.hpp"

namespace skerry::echo {

enum class VideoDetector : std::uint8_t { log, linear };
enum class CodeDecimation : std::uint8_t { peak, mean, sum };

// One video channel of a board.
struct SweepChannel {
  double sample_clock_hz = 20e6;
  std::uint32_t delay_ticks = 0;  // range of the first sample
  std::uint32_t samples = 2048;   // after decimation
  std::uint32_t decimation = 1;
  CodeDecimation mode = CodeDecimation::peak;
  VideoDetector detector = VideoDetector::log;
  unsigned bits = 12;
  bool inverted = false;
  double gain_db = 0.0;
  double offset = 0.0;  // steps
  double stc = 0.0;     // 0 .. 100, as the sea control
  friend bool operator==(const SweepChannel&, const SweepChannel&) = default;
};

// Every tick of the sample clock is a sample with its own noise (correlated over the pulse's
// bandwidth), detected, amplified and converted; decimation acts on codes, as in the board.
// The echo at a fractional azimuth is linear between two rows, in range linear between cells.
// Immutable but for scratch; thread: one at a time.
class SweepReceiver {
 public:
  SweepReceiver(const SweepChannel& channel, const SweepEchoes::Grid& grid);

  // before, after: grid.cells of power each; share: of `after`, 0 .. 1.  trigger: which pulse, for
  // its noise.  codes: channel.samples.
  void receive(std::span<const float> before, std::span<const float> after, float share,
               std::uint64_t trigger, std::span<std::uint16_t> codes);

  const SweepChannel& channel() const { return channel_; }

 private:
  SweepChannel channel_;
};

}  // namespace skerry::echo
