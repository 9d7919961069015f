// Pulses of the digital lines, out of their rising edges.
#pragma once

#include <cstdint>
#include <vector>

#include "clients/signals/sample_grid.hpp"
#include "clients/signals/signal_recording.hpp"

namespace skerry::client {

// High in samples [rise, fall), low elsewhere.
struct Pulse {
  std::uint64_t rise = 0, fall = 0;
  friend bool operator==(const Pulse&, const Pulse&) = default;
};

// "trigger", "acp", "arp", "heading".
const char* line_name(board::Line line);

// Ticks of kPulseSeconds, rounded to the nearest; at least one.
std::uint64_t pulse_ticks(std::uint32_t sample_clock_hz);

// The pulses of a line on a grid: a sample is high where any of its ticks is within a pulse, so
// that none is lost at a low rate, and the sample before the next pulse is always low, so that none
// merges with the next.  A pulse that the end of the recording cuts ends there.
// Error: std::runtime_error if two edges are so near that there is no sample between them; says
// which rate would do.
std::vector<Pulse> pulses_of(const SignalRecording& recording, board::Line line,
                             const SampleGrid& grid);

}  // namespace skerry::client
