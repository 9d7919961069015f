#include "clients/signals/pulse_train.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace skerry::client {
namespace {

[[noreturn]] void fail_merged(board::Line line, std::uint64_t gap, const SampleGrid& grid) {
  const double gap_us = 1e6 * static_cast<double>(gap) / grid.clock_hz();
  const std::uint64_t enough = gap == 0 ? 0 : (2 * std::uint64_t{grid.clock_hz()} + gap - 1) / gap;
  std::string text = fmt::format("two {} pulses {:.3f} us apart fall together at {} samples/s",
                                 line_name(line), gap_us, grid.rate_hz());
  if (enough > grid.rate_hz() && enough <= grid.clock_hz()) {
    text += fmt::format("; {} samples/s keep them apart", enough);
  }
  throw std::runtime_error(text);
}

}  // namespace

const char* line_name(board::Line line) {
  switch (line) {
    case board::Line::trigger:
      return "trigger";
    case board::Line::acp:
      return "acp";
    case board::Line::arp:
      return "arp";
    case board::Line::heading:
      return "heading";
  }
  return "unknown";
}

std::uint64_t pulse_ticks(std::uint32_t sample_clock_hz) {
  return static_cast<std::uint64_t>(std::max(1ll, std::llround(kPulseSeconds * sample_clock_hz)));
}

std::vector<Pulse> pulses_of(const SignalRecording& recording, board::Line line,
                             const SampleGrid& grid) {
  const std::uint64_t width = pulse_ticks(recording.sample_clock_hz);
  std::vector<Pulse> pulses;
  std::uint64_t last_edge = 0;
  for (const board::Edge& edge : recording.edges) {
    if (edge.line != line) continue;
    const std::uint64_t tick = edge.tick - recording.from_tick;
    const std::uint64_t rise = grid.index(tick);
    if (!pulses.empty()) {
      Pulse& before = pulses.back();
      if (rise < before.rise + 2) fail_merged(line, tick - last_edge, grid);
      before.fall = std::min(before.fall, rise - 1);
    }
    pulses.push_back({rise, grid.index(std::min(tick + width, grid.ticks()) - 1) + 1});
    last_edge = tick;
  }
  return pulses;
}

}  // namespace skerry::client
