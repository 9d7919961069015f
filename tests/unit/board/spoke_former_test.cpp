#include "protocol/board/spoke_former.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/unit/board/test_records.hpp"

namespace skerry::board {
namespace {

constexpr std::uint32_t kAcps = 4096, kPeriod = 12'500;  // a turn of 51.2 million ticks
constexpr std::uint64_t kTurn = std::uint64_t{kAcps} * kPeriod;

// A pulse at `tick` of an antenna that passes the ARP at every multiple of kTurn.
Sweep pulse_at(std::uint64_t tick, std::uint16_t value, std::uint32_t samples = 8) {
  Sweep sweep;
  sweep.meta.trigger_tick = tick;
  sweep.meta.trigger_count = tick;
  sweep.meta.sample_clock_hz = 20'480'000;
  sweep.meta.acp_per_turn = kAcps;
  sweep.meta.acp_period = kPeriod;
  sweep.meta.arp_count = static_cast<std::uint32_t>(tick / kTurn);
  sweep.meta.acp_count = static_cast<std::uint32_t>(tick % kTurn / kPeriod);
  sweep.meta.ticks_since_acp = static_cast<std::uint32_t>(tick % kPeriod);
  sweep.meta.channels[0] = {samples, 1, 12, DecimationMode::peak, Detector::log, false};
  sweep.samples[0].assign(samples, value);
  return sweep;
}

class Spokes {
 public:
  SpokeFormer::Spoke taker() {
    return [this](const Sweep& spoke) { all.push_back(spoke); };
  }
  std::vector<Sweep> all;
};

TEST(SpokeFormer, GivesTheMeanOfTheNearestPulsesRoundedHalfUp) {
  std::mt19937 random(1);
  constexpr std::uint32_t kSpokes = 2048;
  SpokeFormer former(kSpokes);
  Spokes spokes;
  // The spokes expected, by rounding azimuths of whole ticks.
  struct Expected {
    std::uint32_t pulses = 0;
    std::array<std::uint64_t, 64> sums = {};
  };
  std::map<std::uint64_t, Expected> expected;
  constexpr std::uint64_t kSpokeTicks = kTurn / kSpokes;
  for (std::uint64_t tick = 1000; tick < 3 * kTurn; tick += drawn(random, 3000, 12'000)) {
    Sweep sweep = pulse_at(tick, 0, 64);
    Expected& spoke = expected[(tick + kSpokeTicks / 2) / kSpokeTicks];
    ++spoke.pulses;
    for (std::size_t i = 0; i < 64; ++i) {
      sweep.samples[0][i] = static_cast<std::uint16_t>(random() % 4096);
      spoke.sums[i] += sweep.samples[0][i];
    }
    former.add(sweep, spokes.taker());
  }
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), expected.size());
  auto spoke = spokes.all.begin();
  for (const auto& [number, what] : expected) {
    ASSERT_EQ(spoke->meta.spoke, number % kSpokes);
    ASSERT_EQ(spoke->meta.spokes_per_turn, kSpokes);
    ASSERT_EQ(spoke->meta.pulses, what.pulses);
    for (std::size_t i = 0; i < 64; ++i) {
      ASSERT_EQ(spoke->samples[0][i], (what.sums[i] + what.pulses / 2) / what.pulses);
    }
    // It has the latches of its nearest pulse, within half the longest interval.
    const double in_spokes = azimuth_turns(spoke->meta) * kSpokes;
    const double off = std::remainder(in_spokes - static_cast<double>(number), kSpokes);
    if (number != 3 * kSpokes) {
      ASSERT_LE(std::fabs(off) * static_cast<double>(kSpokeTicks), 6001.0) << number;
    }
    ++spoke;
  }
}

TEST(SpokeFormer, AveragesTheLargestSumsExactly) {
  for (const std::uint32_t pulses : {1u, 2u, 3u, 7u, 1000u, SpokeFormer::kMaxPulses}) {
    for (const std::uint32_t low : {0u, 1u, pulses / 2, (pulses + 1) / 2, pulses - 1}) {
      SpokeFormer former(256);
      Spokes spokes;
      // `low` of the pulses read one step less.
      for (std::uint32_t i = 0; i < pulses; ++i) {
        former.add(pulse_at(i, i < low ? 65'534 : 65'535), spokes.taker());
      }
      former.finish(spokes.taker());
      ASSERT_EQ(spokes.all.size(), 1u);
      const std::uint64_t sum = 65'535ull * pulses - low;
      EXPECT_EQ(spokes.all[0].samples[0][0], (sum + pulses / 2) / pulses) << pulses << " " << low;
    }
  }
}

TEST(SpokeFormer, TakesPulsesOnBothSidesOfTheArpIntoSpokeZero) {
  SpokeFormer former(256);
  Spokes spokes;
  for (const std::uint64_t tick : {kTurn - 2000, kTurn - 1000, kTurn, kTurn + 1000}) {
    former.add(pulse_at(tick, 10), spokes.taker());
  }
  EXPECT_TRUE(spokes.all.empty());
  former.add(pulse_at(kTurn + kTurn / 256, 10), spokes.taker());
  ASSERT_EQ(spokes.all.size(), 1u);
  EXPECT_EQ(spokes.all[0].meta.spoke, 0u);
  EXPECT_EQ(spokes.all[0].meta.pulses, 4u);
  EXPECT_EQ(spokes.all[0].meta.trigger_tick, kTurn);  // nearest its azimuth
}

TEST(SpokeFormer, TakesThemIntoOneSpokeWhereTheArpIsMissing) {
  SpokeFormer former(256);
  Spokes spokes;
  for (const std::uint64_t tick : {kTurn - 2000, kTurn - 1000, kTurn, kTurn + 1000}) {
    Sweep sweep = pulse_at(tick, 10);
    if (tick >= kTurn) sweep.meta.acp_count += kAcps;
    sweep.meta.arp_count = 0;
    former.add(sweep, spokes.taker());
  }
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), 1u);
  EXPECT_EQ(spokes.all[0].meta.spoke, 0u);
  EXPECT_EQ(spokes.all[0].meta.pulses, 4u);
}

TEST(SpokeFormer, GivesNoSpokeWithoutAPulse) {
  SpokeFormer former(4096);
  Spokes spokes;
  // 1500 pulses a turn are fewer than its spokes.
  for (std::uint64_t n = 0; n < 1500; ++n) {
    former.add(pulse_at(n * kTurn / 1500, 5), spokes.taker());
  }
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), 1500u);
  for (std::size_t n = 0; n < spokes.all.size(); ++n) {
    EXPECT_EQ(spokes.all[n].meta.pulses, 1u);
    EXPECT_EQ(spokes.all[n].meta.spoke, (n * 4096 + 750) / 1500);
  }
}

TEST(SpokeFormer, BeginsAnewWithAnotherFormatClockDelayOrRadar) {
  const auto spokes_of = [](auto change) {
    SpokeFormer former(256);
    Spokes spokes;
    former.add(pulse_at(100, 10), spokes.taker());
    Sweep other = pulse_at(200, 30);
    change(other);
    former.add(other, spokes.taker());
    former.add(other, spokes.taker());
    former.finish(spokes.taker());
    return spokes.all;
  };
  EXPECT_EQ(spokes_of([](Sweep&) {}).size(), 1u);
  const auto shorter = spokes_of([](Sweep& s) {
    s.meta.channels[0].samples = 4;
    s.samples[0].resize(4);
  });
  ASSERT_EQ(shorter.size(), 2u);
  EXPECT_EQ(shorter[0].samples[0], std::vector<std::uint16_t>(8, 10));
  EXPECT_EQ(shorter[1].samples[0], std::vector<std::uint16_t>(4, 30));
  EXPECT_EQ(shorter[1].meta.pulses, 2u);
  const auto second_channel = spokes_of([](Sweep& s) {
    s.meta.channels[1].samples = 2;
    s.samples[1] = {7, 8};
  });
  ASSERT_EQ(second_channel.size(), 2u);
  EXPECT_EQ(second_channel[1].samples[1], (std::vector<std::uint16_t>{7, 8}));
  EXPECT_EQ(spokes_of([](Sweep& s) { s.meta.sample_clock_hz = 40'000'000; }).size(), 2u);
  EXPECT_EQ(spokes_of([](Sweep& s) { s.meta.delay_ticks = 9; }).size(), 2u);
  EXPECT_EQ(spokes_of([](Sweep& s) { s.meta.pulse_ns = 999; }).size(), 2u);
  EXPECT_EQ(spokes_of([](Sweep& s) { s.meta.radar = 1; }).size(), 2u);
  EXPECT_EQ(spokes_of([](Sweep& s) { s.meta.channels[0].inverted = true; }).size(), 2u);
}

TEST(SpokeFormer, NeverMixesPulsesOfTwoTurns) {
  SpokeFormer former(256);
  Spokes spokes;
  former.add(pulse_at(100, 10), spokes.taker());
  former.add(pulse_at(100 + kTurn, 30), spokes.taker());  // all between was not captured
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), 2u);
  EXPECT_EQ(spokes.all[0].samples[0][0], 10);
  EXPECT_EQ(spokes.all[1].samples[0][0], 30);
}

TEST(SpokeFormer, GoesOnGivingSpokesWhileTheAntennaStandsStill) {
  SpokeFormer former(256);
  Spokes spokes;
  std::uint64_t pulses = 0;
  for (std::uint64_t tick = 0; tick < 3 * kTurn; tick += 10'000) {
    Sweep sweep = pulse_at(tick, 10);
    sweep.meta.acp_count = 17;
    sweep.meta.ticks_since_acp = static_cast<std::uint32_t>(tick);
    former.add(sweep, spokes.taker());
  }
  former.finish(spokes.taker());
  for (const Sweep& spoke : spokes.all) pulses += spoke.meta.pulses;
  EXPECT_EQ(pulses, 3 * kTurn / 10'000);
  EXPECT_EQ(spokes.all.size(), 6u);  // one every half a turn
}

TEST(SpokeFormer, KeepsTheFaultsOfEveryPulse) {
  SpokeFormer former(256);
  Spokes spokes;
  for (const std::uint32_t faults : {0u, fault::stalled, 0u, fault::late}) {
    Sweep sweep = pulse_at(1000 + spokes.all.size(), 1);
    sweep.meta.faults = faults;
    former.add(sweep, spokes.taker());
  }
  former.finish(spokes.taker());
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), 1u);
  EXPECT_EQ(spokes.all[0].meta.faults, fault::stalled | fault::late);
}

TEST(SpokeFormer, GivesSpokesThatAreRecords) {
  SpokeFormer former(4096);
  Spokes spokes;
  former.add(pulse_at(kTurn - kTurn / 4096, 4095), spokes.taker());
  former.finish(spokes.taker());
  ASSERT_EQ(spokes.all.size(), 1u);
  EXPECT_EQ(spokes.all[0].meta.spoke, 4095u);
  Bytes bytes;
  append_record(bytes, 1, spokes.all[0]);
  const auto decoded = decode_record(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text;
  EXPECT_TRUE(std::get<Sweep>(decoded->record) == spokes.all[0]);
}

}  // namespace
}  // namespace skerry::board
