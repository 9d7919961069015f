// Sweeps, edges and events with a value of its own in every field, drawn from a seed.
#pragma once

#include <cstdint>
#include <random>

#include "protocol/board/sweep_record.hpp"

namespace skerry::board {

inline std::uint32_t drawn(std::mt19937& random, std::uint32_t min, std::uint32_t max) {
  return min + static_cast<std::uint32_t>(random() % (std::uint64_t{max} - min + 1));
}

inline Sweep test_sweep(std::uint32_t seed, std::uint32_t samples_a = 2048,
                        std::uint32_t samples_b = 0, std::uint8_t bits = 12) {
  std::mt19937 random(seed);
  const auto wide = [&] { return std::uint64_t{random()} << 32 | random(); };
  Sweep sweep;
  SweepMeta& meta = sweep.meta;
  meta = {.radar = drawn(random, 0, 63),
          .trigger_count = wide(),
          .trigger_tick = wide(),
          .sample_clock_hz = drawn(random, 1'000'000, 125'000'000),
          .acp_count = drawn(random, 0, 4095),
          .ticks_since_acp = drawn(random, 0, 12'000),
          .acp_period = drawn(random, 12'000, 13'000),
          .acp_per_turn = drawn(random, 360, 16'384),
          .arp_ticks = drawn(random, 0, 11'000),
          .arp_count = static_cast<std::uint32_t>(random()),
          .utc_ns = wide(),
          .delay_ticks = drawn(random, 0, 1'000'000),
          .pulse_ns = drawn(random, 50, 1200),
          .prf_millihertz = drawn(random, 10'000, 20'000'000),
          .faults = drawn(random, 0, 127),
          .pulses = drawn(random, 1, 65'535),
          .spoke = drawn(random, 0, 2047),
          .spokes_per_turn = 2048,
          .channels = {}};
  const std::uint32_t counts[] = {samples_a, samples_b};
  for (std::size_t c = 0; c < 2; ++c) {
    meta.channels[c] = {.samples = counts[c],
                        .decimation = drawn(random, 1, 65'536),
                        .bits = bits,
                        .mode = static_cast<DecimationMode>(drawn(random, 0, 1)),
                        .detector = static_cast<Detector>(drawn(random, 0, 1)),
                        .inverted = random() % 2 == 1};
    sweep.samples[c].resize(counts[c]);
    for (std::uint16_t& sample : sweep.samples[c]) {
      sample = static_cast<std::uint16_t>(random() & ((1u << bits) - 1));
    }
  }
  return sweep;
}

inline Edges test_edges(std::uint32_t seed, std::size_t count) {
  std::mt19937 random(seed);
  Edges edges;
  edges.radar = drawn(random, 0, 63);
  edges.sample_clock_hz = 20'000'000;
  edges.from_tick = std::uint64_t{1} << 40;
  std::uint64_t tick = edges.from_tick;
  for (std::size_t i = 0; i < count; ++i) {
    tick += drawn(random, 0, 5000);
    edges.edges.push_back({tick, static_cast<Line>(drawn(random, 0, 3))});
  }
  edges.to_tick = tick + 1;
  return edges;
}

inline Event test_event(std::uint32_t seed) {
  std::mt19937 random(seed);
  return {.radar = drawn(random, 0, 63),
          .tick = std::uint64_t{random()} << 32 | random(),
          .event = 1u << drawn(random, 0, 6),
          .faults = drawn(random, 0, 127),
          .value = static_cast<std::uint32_t>(random())};
}

}  // namespace skerry::board
