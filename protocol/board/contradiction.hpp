// Contradiction: settings of a board that may each be written but cannot be in force together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/board/registers.hpp"

namespace skerry::board {

// Most that transmitters on ships stand: pulse length times PRF.
inline constexpr double kMostDutyCycle = 0.002;

// The settings that are checked together, each within its register's range.
struct JudgedChannel {
  bool is_on = false;
  std::uint32_t samples = 2048, decimation = 1, bits = 12;
  DecimationMode mode = DecimationMode::peak;
  TestMode test_mode = TestMode::off;
  std::uint32_t test_value = 256;

  // Ticks from its first sample to its end.
  std::uint64_t length() const { return std::uint64_t{samples} * decimation; }
};
struct JudgedSettings {
  std::uint32_t clock_hz = 20'000'000;
  std::uint32_t pulse_code = 0, pulse_codes = 0;
  double pulse_s = 0.0;                      // length of the pulse in use
  std::uint32_t prf_millihertz = 3'000'000;  // in use
  std::uint32_t jitter_ppm = 0, stagger_ppm = 0, delay_ticks = 0;
  std::uint32_t fifo_depth = 131'072;
  std::array<JudgedChannel, 2> channels;
};

struct Contradiction {
  enum class Kind : std::uint8_t {
    pulse_code,    // `is` beyond the set's `most`
    duty_cycle,    // `duty`; the highest PRF is `most` Hz
    sweep_length,  // `is` ticks with the delay; triggers come after `most` at the least
    sum_width,     // sums reach `is`; the largest decimation is `most`
    target,        // at sample `is`; the last one is `most`
    fifo_depth,    // a sweep of all channels has `is` samples; there is room for `most`
  };
  Kind kind = Kind::pulse_code;
  std::size_t channel = 0;  // of sweep_length, sum_width and target
  std::uint64_t is = 0, most = 0;
  double duty = 0.0;
};

// All of them, in the order above but for the channels, which come one after the other.  Channels
// that are off are not looked at.  A pulse that the set does not have comes alone: without it there
// is no length to judge the others by.
std::vector<Contradiction> contradictions_in(const JudgedSettings& settings);

// The shortest time between two triggers, ticks: each may come by jitter and stagger too late, and
// the next by as much too early.
std::uint64_t shortest_trigger_period(std::uint32_t clock_hz, std::uint32_t prf_millihertz,
                                      std::uint32_t jitter_ppm, std::uint32_t stagger_ppm);

}  // namespace skerry::board
