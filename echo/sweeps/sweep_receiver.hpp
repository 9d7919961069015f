// SweepReceiver: one pulse's echo from its rows to the codes of a converter.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/sweep_codes.hpp"
#include "echo/receiver/receiver_noise.hpp"
#include "echo/sweeps/code_groups.hpp"
#include "echo/sweeps/sweep_echoes.hpp"

namespace skerry::echo {

// Share of a log channel's decibels that lies below mean noise at gain 0: 10 of 45 dB.  Noise, at
// -2.5 dB in the mean, is then a sixth of full scale up, and a tenth of it reads 0.
inline constexpr double kDecibelsBelowNoise = 2.0 / 9.0;

// Every tick of the sample clock is a sample: tick t after the trigger lies at (t + 1/2) c / (2
// fs), with its own noise, is detected, amplified, converted; decimation acts on codes, as in the
// board.  The echo at a fractional azimuth is linear between two rows, in range linear between the
// middles of cells; half a cell about the ends of the grid it is that of the end, beyond none.
//
// x = |sqrt(P) + n|^2, n the noise of that trigger and tick, in octaves of power over mean noise:
//   log:    v = 2^bits / R (10 log10 x + 2/9 R + gain - STC) + offset,  R = grid.video_range_db
//   linear: v = 2^bits sqrt(x) 10^((gain - STC - 7/9 R) / 20) + offset
//   code    = v clamped to 0 .. 2^bits - 1, rounded down; of an inverted channel 2^bits - 1 - that.
// Both are full at 7/9 R over noise (35 dB of 45).  At 8 bits log is the law of a view's video but
// for the place of its threshold (log_video.hpp).  Before grid.blind_m the receiver is blind: v =
// offset.
// Error: x, 3e-7 of (sqrt(P) + |n|)^2; place in range, 1.3e-4 of a tick and 1.2e-7 of the cells
// from the sweep's piece of kPiece ticks; log, 1.2e-4 octaves: 0.13 steps at 14 bits over 45 dB;
// linear, 2e-7.  Held by SweepCodes.* and SweepReceiver.MatchesAReference....
//
// Noise behind the pulse's filter of bandwidth B: neighbouring ticks are correlated as (sin y /
// y)^2, y = pi B / fs, and independent where fs <= B, for a converter takes single samples and no
// mean over a tick.  It is a function of (seed, radar, trigger, tick): channels of one radar see
// the same, whatever their delay and detector.  Pieces of ReceiverNoise join without a seam over
// 32768 ticks after the trigger (245 km at 20 MHz, 39 km at 125 MHz); the next 32768 are drawn
// anew, so that in one of 32768 pairs of neighbours correlation is missing.
// Thread: one at a time.
class SweepReceiver {
 public:
  // Requires a clock > 0, decimation in 1 .. 65536, bits in 1 .. 16, a grid of at least one cell.
  // That the sweep ends before the next trigger is the board's to see to: it costs what it lasts.
  SweepReceiver(const SweepChannel& channel, const SweepEchoes::Grid& grid);

  // before, after: grid.cells of power each (of another size: nothing but noise); share: of
  // `after`, 0 .. 1.  trigger: which pulse, for its noise.  codes: channel.samples.
  void receive(std::span<const float> before, std::span<const float> after, float share,
               std::uint64_t trigger, std::span<std::uint16_t> codes);

  const SweepChannel& channel() const { return channel_; }
  // The level, in steps, of a power (echo and noise together) at a tick, counted from the first
  // sampled, before rounding, clamping and inversion.
  double level_of(double power, std::uint32_t tick) const;

 private:
  static constexpr std::uint32_t kPiece = 1024;  // ticks made at a time, in the nearest cache

  double range_of(std::uint64_t tick) const;
  void lay_gain(double stc);
  bool lay_echo(std::span<const float> before, std::span<const float> after, float share,
                std::uint64_t tick, std::uint32_t count);
  void convert(std::uint64_t tick, std::span<std::uint16_t> codes);

  SweepChannel channel_;
  SweepEchoes::Grid grid_;
  std::shared_ptr<const ReceiverNoise> noise_;
  double cells_per_tick_;
  double full_scale_;              // steps
  std::uint64_t blind_ticks_ = 0;  // of the sweep
  std::uint64_t lit_ticks_ = 0;    // that lie in the grid
  ConverterScale converter_;
  std::uint16_t blind_code_;
  // log: steps to add; linear: steps per root of power.  By tick as far as STC acts, then flat.
  AlignedFloats gain_, flat_gain_;
  AlignedFloats silence_, cells_, power_, total_;
  std::vector<std::uint16_t> piece_;
};

}  // namespace skerry::echo
