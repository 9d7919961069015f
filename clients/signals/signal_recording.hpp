// SignalRecording: a stretch of a board's signals, to be written to a file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/board/sweep_record.hpp"

namespace skerry::client {

// All edges in [from_tick, to_tick), in order, and the sweeps triggered in it, in order.
struct SignalRecording {
  std::uint32_t sample_clock_hz = 0;
  std::uint64_t from_tick = 0, to_tick = 0;
  std::vector<board::Edge> edges;
  std::vector<board::Sweep> sweeps;
  std::optional<std::uint64_t> utc_ns = std::nullopt;  // at from_tick
  std::string source = {};                             // what made it, one line of ASCII

  std::uint64_t ticks() const { return to_tick - from_tick; }
  double seconds() const { return static_cast<double>(ticks()) / sample_clock_hz; }
};

// Pulses of the digital lines last so long.
inline constexpr double kPulseSeconds = 1e-6;

// Asked by who writes a file, now and then, with the share of it that is done; false ends the file
// there, whole but shorter.
using GoOn = std::function<bool(double done)>;

// The result of writing a file.
struct SignalFile {
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;  // of each of its channels; of a VCD: ticks
  bool complete = true;       // false: GoOn ended it
};

}  // namespace skerry::client
