// Grids, channels and sweeps for the tests of SweepReceiver.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "echo/sweeps/sweep_receiver.hpp"

namespace skerry::echo {

inline constexpr std::uint32_t kCells = 512;

// 45 dB of video, cells of 20 m to 10.24 km; bandwidth as the default clock: independent ticks.
inline SweepEchoes::Grid grid_of(double bandwidth_hz = 20e6) {
  SweepEchoes::Grid grid;
  grid.cells = kCells;
  grid.cell_m = 20.0;
  grid.pulse = {0.08e-6, bandwidth_hz, 3000.0, 1.5};
  grid.seed = 7;
  return grid;
}

inline double metres_per_tick_of(const SweepChannel& channel) {
  return 0.5 * kLightSpeed / channel.sample_clock_hz;
}

inline std::vector<float> row_of(const std::function<double(std::size_t)>& power) {
  std::vector<float> row(kCells);
  for (std::size_t i = 0; i < kCells; ++i) row[i] = static_cast<float>(power(i));
  return row;
}

inline std::vector<std::uint16_t> sweep_of(SweepReceiver& receiver, std::span<const float> before,
                                           std::span<const float> after, float share,
                                           std::uint64_t trigger) {
  std::vector<std::uint16_t> codes(receiver.channel().samples, 0xABCD);
  receiver.receive(before, after, share, trigger, codes);
  return codes;
}

inline std::vector<std::uint16_t> noise_sweep(SweepReceiver& receiver, std::uint64_t trigger) {
  return sweep_of(receiver, {}, {}, 0.0f, trigger);
}

// A linear channel of 14 bits whose codes hold noise well: a thousand steps to its root mean
// square.
inline SweepChannel noise_channel(std::uint32_t samples = 2048) {
  SweepChannel channel;
  channel.samples = samples;
  channel.detector = VideoDetector::linear;
  channel.bits = 14;
  channel.gain_db = 10.8;
  return channel;
}

// Power over mean noise that a code of a linear channel stands for, taken as the middle of its
// step.
inline double power_of(const SweepChannel& channel, double range_db, double code) {
  const double full = std::exp2(channel.bits);
  const double volts = (code + 0.5 - channel.offset) / full;
  return volts * volts * std::pow(10.0, (range_db * 7.0 / 9.0 - channel.gain_db) / 10.0);
}

inline std::vector<double> powers_of(const SweepChannel& channel, double range_db,
                                     std::span<const std::uint16_t> codes) {
  std::vector<double> powers;
  for (const std::uint16_t code : codes) powers.push_back(power_of(channel, range_db, code));
  return powers;
}

// Sums that make a correlation of many pairs.
class Correlation {
 public:
  void add(double a, double b) {
    n_ += 1.0, a_ += a, b_ += b, aa_ += a * a, bb_ += b * b, ab_ += a * b;
  }
  double value() const {
    const double cov = ab_ / n_ - a_ / n_ * b_ / n_;
    return cov / std::sqrt((aa_ / n_ - a_ * a_ / n_ / n_) * (bb_ / n_ - b_ * b_ / n_ / n_));
  }
  double pairs() const { return n_; }

 private:
  double n_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

}  // namespace skerry::echo
