// A recording like a board's, and what every tick of it must be by the definitions alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "clients/signals/waveform.hpp"

namespace skerry::client::testing_signals {

inline const std::vector<SignalChannel> kAll(kAllSignalChannels.begin(), kAllSignalChannels.end());
inline const GoOn kAlways = [](double) { return true; };

// 16 random bits, the same on every machine.
inline std::uint32_t dice(std::uint64_t n) {
  n = (n + 0x9E3779B97F4A7C15u) * 0xBF58476D1CE4E5B9u;
  n = (n ^ (n >> 27)) * 0x94D049BB133111EBu;
  return static_cast<std::uint32_t>(n >> 48);
}

// The properties in which the tests' recordings differ.
struct Plan {
  std::uint32_t clock_hz = 20'000'000;
  std::uint64_t ticks = 60'000;
  std::uint64_t from_tick = 1'234'567'890'123;
  std::uint64_t trigger_ticks = 6'667, acp_ticks = 12'207;
  std::uint32_t samples = 400;
};

inline SignalRecording make_recording(const Plan& plan = {}) {
  SignalRecording recording;
  recording.sample_clock_hz = plan.clock_hz;
  recording.from_tick = plan.from_tick;
  recording.to_tick = plan.from_tick + plan.ticks;
  recording.source = "skerryd 0.1.0, radar 0 \"X band\"";
  recording.utc_ns = 1'790'000'000'123'456'789;
  const auto add = [&](board::Line line, std::uint64_t tick) {
    if (tick < recording.to_tick) recording.edges.push_back({tick, line});
  };
  add(board::Line::arp, plan.from_tick + 1);
  add(board::Line::arp, plan.from_tick + plan.ticks - 7);  // cut by the end
  add(board::Line::heading, plan.from_tick + plan.ticks / 3);
  for (std::uint64_t t = plan.from_tick + 1; t < recording.to_tick; t += plan.acp_ticks) {
    add(board::Line::acp, t + dice(t) % 100);
  }
  for (std::uint64_t n = 0;; ++n) {
    const std::uint64_t t =
        plan.from_tick + 100 + n * plan.trigger_ticks + dice(n) % (plan.trigger_ticks / 50);
    if (t >= recording.to_tick) break;
    add(board::Line::trigger, t);
    board::Sweep sweep;
    sweep.meta.trigger_count = n;
    sweep.meta.trigger_tick = t;
    sweep.meta.sample_clock_hz = plan.clock_hz;
    sweep.meta.delay_ticks = 33;
    sweep.meta.channels[0] = {.samples = plan.samples, .decimation = 5, .bits = 12};
    sweep.meta.channels[1] = {.samples = plan.samples,
                              .decimation = 18,
                              .bits = 8,
                              .inverted = true};  // longer than the period: cut by the next
    for (std::uint32_t i = 0; i < plan.samples; ++i) {
      sweep.samples[0].push_back(static_cast<std::uint16_t>(dice(n * 70'001 + i) >> 4));
      sweep.samples[1].push_back(static_cast<std::uint16_t>(dice(n * 90'001 + i) >> 8));
    }
    recording.sweeps.push_back(std::move(sweep));
  }
  std::stable_sort(recording.edges.begin(), recording.edges.end(),
                   [](const board::Edge& a, const board::Edge& b) { return a.tick < b.tick; });
  return recording;
}

// Levels of every tick: of the lines 0 or 1, of video its code.
inline std::vector<std::uint16_t> tick_levels(const SignalRecording& recording,
                                              SignalChannel channel) {
  std::vector<std::uint16_t> levels(recording.ticks(), 0);
  const auto video = video_channel(channel);
  if (!video) {
    const auto line = static_cast<board::Line>(static_cast<int>(channel) - 2);
    const std::uint64_t width =
        std::max<std::uint64_t>(1, (recording.sample_clock_hz + 500'000) / 1'000'000);
    for (const board::Edge& edge : recording.edges) {
      if (edge.line != line) continue;
      for (std::uint64_t t = edge.tick; t < edge.tick + width && t < recording.to_tick; ++t) {
        levels[t - recording.from_tick] = 1;
      }
    }
    return levels;
  }
  const std::uint16_t rest = *video == 0 ? 0 : 255;
  for (std::uint64_t t = 0; t < levels.size(); ++t) levels[t] = rest;
  for (std::size_t k = 0; k < recording.sweeps.size(); ++k) {
    const board::Sweep& sweep = recording.sweeps[k];
    const std::uint64_t next = k + 1 < recording.sweeps.size()
                                   ? recording.sweeps[k + 1].meta.trigger_tick
                                   : recording.to_tick;
    for (std::uint64_t t = sweep.meta.trigger_tick; t < next; ++t) {
      const std::uint64_t since = t - sweep.meta.trigger_tick;
      if (since < sweep.meta.delay_ticks) continue;
      const std::uint64_t i =
          (since - sweep.meta.delay_ticks) / sweep.meta.channels[*video].decimation;
      if (i < sweep.samples[*video].size()) {
        levels[t - recording.from_tick] = sweep.samples[*video][i];
      }
    }
  }
  return levels;
}

// The samples of a channel of make_recording(), tick by tick.
inline std::vector<std::int16_t> expected_samples(const SignalRecording& recording,
                                                  SignalChannel channel, std::uint32_t rate_hz) {
  const std::vector<std::uint16_t> levels = tick_levels(recording, channel);
  const auto sample_of = [&](std::uint64_t t) { return t * rate_hz / recording.sample_clock_hz; };
  std::vector<std::int16_t> samples;
  for (std::uint64_t t = 0; t < levels.size(); ++t) {
    std::int16_t value = 0;
    if (!video_channel(channel)) {
      value = levels[t] != 0 ? 32767 : 0;
    } else {
      value = static_cast<std::int16_t>(levels[t] * (channel == SignalChannel::video_a ? 8 : 128));
    }
    if (sample_of(t) == samples.size()) {
      samples.push_back(value);
    } else if (channel == SignalChannel::video_b) {
      samples.back() = std::min(samples.back(), value);
    } else {
      samples.back() = std::max(samples.back(), value);
    }
  }
  if (video_channel(channel)) return samples;
  const auto line = static_cast<board::Line>(static_cast<int>(channel) - 2);
  for (const board::Edge& edge : recording.edges) {
    const std::uint64_t m = sample_of(edge.tick - recording.from_tick);
    if (edge.line == line && m > 0) samples[m - 1] = 0;
  }
  return samples;
}

}  // namespace skerry::client::testing_signals
