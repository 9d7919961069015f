#include "server/board/tick_clock.hpp"

#include <gtest/gtest.h>

#include "echo/kernel/hash.hpp"
#include "echo/radar/spoke_clock.hpp"
#include "server/board/azimuth_generator.hpp"
#include "server/board/trigger_generator.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kMonth = 30ull * 86'400;  // s

// Whether `tick` is the one nearest to n * numerator / denominator, by multiplication alone.
bool is_nearest(Tick tick, Wide n, Wide numerator, Wide denominator) {
  const Wide twice_error = 2 * (static_cast<Wide>(tick) * denominator - n * numerator);
  return -denominator < twice_error && twice_error <= denominator;
}

double acp_microseconds(std::uint32_t acps, double rpm) {
  AzimuthGenerator azimuth({.clock_hz = 125'000'000,
                            .milli_rpm = static_cast<std::uint32_t>(rpm * 1000),
                            .acp_per_turn = acps});
  // Over a whole turn: the first ACP of this and of the next.
  const Tick begin = azimuth.next().tick;
  azimuth.skip_turns(1);
  return static_cast<double>(azimuth.next().tick - begin) / 125.0 / acps;
}

TEST(TickClock, AcpPeriodsAreThoseOfTheTimingArithmetic) {
  // BOARD.md "Sources".
  EXPECT_NEAR(acp_microseconds(4096, 24.0), 610.352, 0.0005);
  EXPECT_NEAR(acp_microseconds(2048, 24.0), 1220.703, 0.0005);
  EXPECT_NEAR(acp_microseconds(450, 24.0), 5555.556, 0.0005);
  EXPECT_NEAR(acp_microseconds(4096, 45.0), 325.521, 0.0005);
}

std::uint64_t triggers_in_a_turn(std::uint32_t prf_millihertz, std::uint64_t turn) {
  TriggerGenerator triggers({.clock_hz = 125'000'000, .prf_millihertz = prf_millihertz});
  const Tick turn_ticks = 125'000'000ull * 60 / 24;
  return triggers.count(turn * turn_ticks, (turn + 1) * turn_ticks);
}

TEST(TickClock, TriggersOfATurnAreThoseOfTheTimingArithmetic) {
  for (const std::uint64_t turn : {0ull, 1ull, 1000ull, 1'036'799ull}) {
    EXPECT_EQ(triggers_in_a_turn(3'000'000, turn), 7500u);
    EXPECT_EQ(triggers_in_a_turn(600'000, turn), 1500u);
  }
}

struct Rate {
  std::uint32_t clock_hz, prf_millihertz, milli_rpm, acps;
};
const Rate kRates[] = {{20'000'000, 3'000'000, 24'000, 4096},
                       {125'000'000, 2'999'999, 45'123, 450},
                       {61'440'000, 1'800'001, 23'999, 16'384},
                       {99'999'989, 601'307, 60'000, 2048},
                       {1'000'000, 20'000'000, 1000, 360}};

TEST(TickClock, TriggersOfThirtyDaysStandAtTheirNearestTick) {
  for (const Rate& rate : kRates) {
    const std::uint64_t last = kMonth * rate.prf_millihertz / 1000;
    TriggerGenerator triggers({.clock_hz = rate.clock_hz, .prf_millihertz = rate.prf_millihertz});
    const TickSeries series(0, std::uint64_t{rate.clock_hz} * 1000, rate.prf_millihertz);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      const std::uint64_t n = echo::mixed(i, rate.clock_hz) % last;
      ASSERT_TRUE(is_nearest(series.at(n), n, Wide{rate.clock_hz} * 1000, rate.prf_millihertz))
          << n << " at " << rate.clock_hz;
      ASSERT_EQ(series.first_from(series.at(n)), n);
      ASSERT_EQ(series.first_from(series.at(n) + 1), n + 1);
    }
    // A second at the end, one by one.
    std::uint64_t n = triggers.skip_to(kMonth * rate.clock_hz);
    for (std::uint32_t i = 0; i < rate.prf_millihertz / 1000; ++i, ++n, triggers.pop()) {
      ASSERT_TRUE(is_nearest(triggers.next(), n, Wide{rate.clock_hz} * 1000, rate.prf_millihertz))
          << n;
    }
  }
}

TEST(TickClock, AzimuthPulsesOfThirtyDaysStandAtTheirNearestTick) {
  for (const Rate& rate : kRates) {
    const Wide turn = Wide{rate.clock_hz} * 60'000, per_acp = Wide{rate.milli_rpm} * rate.acps;
    const std::uint64_t turns = kMonth * rate.milli_rpm / 60'000;
    for (std::uint64_t place = 0; place < 4; ++place) {
      AzimuthGenerator azimuth({rate.clock_hz, rate.milli_rpm, rate.acps, 12'345});
      const std::uint64_t from = place == 3 ? turns : echo::mixed(place, rate.acps) % turns;
      azimuth.skip_turns(from);
      std::uint64_t acps = 0, arps = 0, headings = 0;
      while (arps < 2) {
        const AzimuthGenerator::Pulse pulse = azimuth.next();
        azimuth.pop();
        if (pulse.line == AzimuthLine::acp) {
          const Wide n = Wide{from} * rate.acps + acps++;
          ASSERT_TRUE(is_nearest(pulse.tick, n, turn, per_acp)) << from << " " << acps;
        } else if (pulse.line == AzimuthLine::arp) {
          const Wide n = Wide{from + arps++} * 65'536 + 12'345;
          ASSERT_TRUE(is_nearest(pulse.tick, n, turn, Wide{rate.milli_rpm} * 65'536));
        } else {
          ASSERT_TRUE(is_nearest(pulse.tick, Wide{from + headings++}, turn, rate.milli_rpm));
        }
      }
    }
  }
}

TEST(TickClock, TheUndisturbedAntennaIsThatOfTheSpokeClock) {
  for (const double rpm : {24.0, 47.3}) {
    const echo::SpokeClock spokes(rpm, 4096);
    AzimuthGenerator azimuth(
        {.clock_hz = 100'000'000, .milli_rpm = static_cast<std::uint32_t>(rpm * 1000 + 0.5)});
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const std::uint64_t spoke = echo::mixed(i) % (4096ull * 1'000'000);
      const Tick tick = tick_at(spokes.time_of(spoke), 100'000'000);
      const Azimuth before = azimuth.at(tick), after = azimuth.at(tick + 1);
      const Azimuth of_spoke{spoke / 4096, spoke % 4096 << 52};
      ASSERT_LE(before, of_spoke);
      ASSERT_GE(after, of_spoke);
    }
  }
}

TEST(TickClock, TicksAndTimesAreExact) {
  for (const std::uint32_t clock : {1'000'000u, 20'000'000u, 125'000'000u, 99'999'989u}) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const auto ns = static_cast<std::int64_t>(echo::mixed(i) % (kMonth * 1'000'000'000));
      const Tick tick = tick_at(ScenarioTime(Duration(ns)), clock);
      EXPECT_LE(static_cast<Wide>(tick) * 1'000'000'000, static_cast<Wide>(ns) * clock);
      EXPECT_GT(static_cast<Wide>(tick + 1) * 1'000'000'000, static_cast<Wide>(ns) * clock);
    }
  }
  EXPECT_EQ(tick_at(ScenarioTime(Duration(-5)), 20'000'000), 0u);
  EXPECT_EQ(time_of(20'000'000ull * 86'400, 20'000'000), ScenarioTime(std::chrono::hours(24)));
}

}  // namespace
}  // namespace skerry::server
