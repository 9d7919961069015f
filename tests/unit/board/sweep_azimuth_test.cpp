// The timing arithmetic of BOARD.md "Sources": ACPs, triggers, azimuth and range.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "protocol/board/sweep_record.hpp"

namespace skerry::board {
namespace {

// floor(n * numerator / denominator), exactly.
std::uint64_t tick_of(std::uint64_t n, std::uint64_t numerator, std::uint64_t denominator) {
  return static_cast<std::uint64_t>(static_cast<unsigned __int128>(n) * numerator / denominator);
}

// An antenna at constant speed: a turn takes turn_numerator / turn_denominator ticks; pulses stand
// for the tick nearest to them.
struct Antenna {
  std::uint64_t clock_hz, rpm, acps;
  // Ticks of a turn: clock * 60 / rpm.
  double turn_ticks() const {
    return 60.0 * static_cast<double>(clock_hz) / static_cast<double>(rpm);
  }
  double acp_ticks() const { return turn_ticks() / static_cast<double>(acps); }
  std::uint64_t acp(std::uint64_t k) const {
    return (tick_of(2 * k, clock_hz * 60, rpm * acps) + 1) / 2;
  }
  // The values latched at a trigger in that tick, from the second ACP of the first turn on.
  SweepMeta at(std::uint64_t tick) const {
    auto k = static_cast<std::uint64_t>(static_cast<double>(tick) / acp_ticks());
    while (acp(k + 1) <= tick) ++k;
    while (acp(k) > tick) --k;
    SweepMeta meta;
    meta.trigger_tick = tick;
    meta.sample_clock_hz = static_cast<std::uint32_t>(clock_hz);
    meta.acp_per_turn = static_cast<std::uint32_t>(acps);
    meta.acp_count = static_cast<std::uint32_t>(k % acps);
    meta.arp_count = static_cast<std::uint32_t>(k / acps);
    meta.ticks_since_acp = static_cast<std::uint32_t>(tick - acp(k));
    meta.acp_period = static_cast<std::uint32_t>(acp(k) - acp(k - 1));
    const std::uint64_t arp = k / acps * acps;
    if (arp >= 2 * acps) meta.turn_ticks = static_cast<std::uint32_t>(acp(arp) - acp(arp - acps));
    return meta;
  }
};

TEST(SweepAzimuth, StepsAreThoseOfTheTimingArithmetic) {
  const auto acp_us = [](double rpm, double acps) { return 60.0 / rpm / acps * 1e6; };
  const auto measured_us = [](const Antenna& antenna) {
    return static_cast<double>(antenna.acp(1'000'000)) / 1e6 /
           static_cast<double>(antenna.clock_hz) * 1e6;
  };
  EXPECT_NEAR(acp_us(24, 4096), 610.352, 0.0005);
  EXPECT_NEAR(measured_us({20'000'000, 24, 4096}), 610.352, 0.0005);
  EXPECT_NEAR(measured_us({125'000'000, 24, 2048}), 1220.703, 0.0005);
  EXPECT_NEAR(measured_us({20'000'000, 24, 450}), 5555.556, 0.0005);
  EXPECT_NEAR(measured_us({20'000'000, 45, 4096}), 325.521, 0.0005);
  // The azimuth of one ACP: 0.087891 and 0.8 degrees.
  SweepMeta meta;
  meta.acp_period = 12'207;
  meta.acp_count = 1;
  meta.acp_per_turn = 4096;
  EXPECT_NEAR(azimuth_turns(meta) * 360, 0.087891, 5e-7);
  meta.acp_per_turn = 450;
  EXPECT_NEAR(azimuth_turns(meta) * 360, 0.8, 1e-12);
}

TEST(SweepAzimuth, SevenAndAHalfThousandTriggersATurnAreEvenlySpread) {
  const Antenna antenna{20'000'000, 24, 4096};
  double last = 0.0;
  for (std::uint64_t n = 1; n < 7500; ++n) {
    const std::uint64_t trigger = tick_of(n + 7500, 20'000'000, 3000);
    const double turns = azimuth_turns(antenna.at(trigger));
    EXPECT_NEAR((turns - last) * 360, 0.048, 0.048 * 4 / 6667) << n;
    last = turns;
  }
}

TEST(SweepAzimuth, IsAcpCountAndFractionWithinHalfATickAtAnyClock) {
  for (const Antenna& antenna : {Antenna{20'480'000, 24, 4096}, Antenna{20'000'000, 24, 4096},
                                 Antenna{20'000'000, 24, 450}, Antenna{20'000'000, 45, 4096},
                                 Antenna{125'000'000, 25, 2048}, Antenna{1'000'000, 59, 16'384}}) {
    const double turn = antenna.turn_ticks();
    double worst = 0.0, worst_of_first = 0.0;
    const auto begin = static_cast<std::uint64_t>(turn) + 7;
    for (std::uint64_t tick = begin; tick < 4 * begin; tick += 61) {
      const SweepMeta meta = antenna.at(tick);
      double error = azimuth_turns(meta) * turn - std::fmod(static_cast<double>(tick), turn);
      error -= turn * std::round(error / turn);
      double& which = meta.turn_ticks == 0 ? worst_of_first : worst;
      which = std::max(which, std::fabs(error));
    }
    std::printf("%.4f ticks an ACP: off by %.4f ticks, %.4f in the first turn\n",
                antenna.acp_ticks(), worst, worst_of_first);
    // An ARP of its own nearest tick makes the mean period 1 / ACPs of a tick wrong, and counts.
    const bool whole_turns = std::fmod(turn, 1.0) == 0.0;
    EXPECT_LE(worst, whole_turns ? 0.5 + 1e-6 : 1.0 + 1.0 / static_cast<double>(antenna.acps));
    EXPECT_LE(worst_of_first, 2.0);
  }
}

// With the wow of an uneven antenna the last period is nearer than the mean.
TEST(SweepAzimuth, FollowsAnAntennaThatTurnsUnevenly) {
  SweepMeta meta;
  meta.acp_per_turn = 4096;
  meta.turn_ticks = 4096 * 12'000;
  meta.acp_period = 12'100;
  EXPECT_EQ(acp_ticks(meta), 12'100.0);
  meta.acp_period = 12'001;
  EXPECT_EQ(acp_ticks(meta), 12'000.0);
  meta.turn_ticks = 0;
  EXPECT_EQ(acp_ticks(meta), 12'001.0);
}

TEST(SweepAzimuth, CountsFromTheArpWhereverItLiesBetweenTwoAcps) {
  SweepMeta meta;
  meta.acp_period = 1000;
  meta.acp_per_turn = 400;
  meta.arp_ticks = 250;
  meta.ticks_since_acp = 250;
  EXPECT_EQ(azimuth_turns(meta), 0.0);
  meta.ticks_since_acp = 750;
  EXPECT_NEAR(azimuth_turns(meta), 0.5 / 400, 1e-15);
  meta.ticks_since_acp = 0;
  EXPECT_NEAR(azimuth_turns(meta), 1 - 0.25 / 400, 1e-15);
  meta.acp_count = 400;  // an ARP that did not come
  EXPECT_NEAR(azimuth_turns(meta), 1 - 0.25 / 400, 1e-13);
  meta.acp_count = 0xFFFF'FFFF;
  EXPECT_LT(azimuth_turns(meta), 1.0);
  EXPECT_GE(azimuth_turns(meta), 0.0);
}

TEST(SweepAzimuth, StandsStillWithTheAntenna) {
  SweepMeta meta;
  meta.acp_period = 1000;
  meta.acp_per_turn = 400;
  meta.acp_count = 7;
  meta.ticks_since_acp = 4'000'000'000;
  EXPECT_NEAR(azimuth_turns(meta), 8.0 / 400, 1e-15);
}

TEST(SweepAzimuth, IsZeroBeforeTwoAcpsHaveCome) {
  SweepMeta meta;
  meta.acp_per_turn = 4096;
  meta.acp_count = 1;
  meta.ticks_since_acp = 500;
  EXPECT_EQ(azimuth_turns(meta), 0.0);
  meta.acp_period = 500;
  meta.acp_per_turn = 0;
  EXPECT_EQ(azimuth_turns(meta), 0.0);
}

// A tick of 20 MHz is 7.4948 m of range, one of 125 MHz 1.1992 m.
TEST(SampleRange, IsTheMiddleOfTheSampleFromTheTrigger) {
  SweepMeta meta;
  meta.sample_clock_hz = 125'000'000;
  EXPECT_NEAR(sample_range_m(meta, 0, 0), 0.5 * 1.199169832, 1e-9);
  EXPECT_NEAR(sample_range_m(meta, 0, 1000), 1000.5 * 1.199169832, 1e-6);
  meta.sample_clock_hz = 20'000'000;
  meta.delay_ticks = 100;
  meta.channels[1].decimation = 4;
  EXPECT_NEAR(sample_range_m(meta, 1, 2047), (100 + 2047.5 * 4) * 7.49481145, 1e-6);
  meta.sample_clock_hz = 0;
  EXPECT_EQ(sample_range_m(meta, 1, 5), 0.0);
}

}  // namespace
}  // namespace skerry::board
