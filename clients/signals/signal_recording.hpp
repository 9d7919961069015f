// SignalRecording: a stretch of a board's signals, to be written to a file.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/board/sweep_record.hpp"

namespace skerry::client {

// All edges in [from_tick, to_tick), in order, and the sweeps triggered in it.
struct SignalRecording {
  std::uint32_t sample_clock_hz = 0;
  std::uint64_t from_tick = 0, to_tick = 0;
  std::vector<board::Edge> edges;
  std::vector<board::Sweep> sweeps;
};

// Pulses of the digital lines last so long.
inline constexpr double kPulseSeconds = 1e-6;

}  // namespace skerry::client
