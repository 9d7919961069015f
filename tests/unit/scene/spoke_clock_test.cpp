#include "echo/radar/spoke_clock.hpp"

#include <gtest/gtest.h>

namespace skerry::echo {
namespace {

TEST(SpokeClock, ATurnTakesSixtySecondsOverRpm) {
  for (std::uint32_t spokes : {256u, 450u, 2048u, 4096u, 8192u}) {
    for (double rpm : {12.0, 18.7, 24.0, 45.0, 60.0}) {
      const SpokeClock clock(rpm, spokes);
      const Duration turn = clock.time_of(spokes) - clock.time_of(0);
      EXPECT_NEAR(in_seconds(turn), 60.0 / rpm, 1e-9);
    }
  }
}

TEST(SpokeClock, ThirtyDaysDoNotDrift) {
  const SpokeClock clock(24.0, 4096);  // 610 351.5625 ns a spoke: not a whole number
  const std::uint64_t turns = 30ull * 24 * 60 * 24;
  EXPECT_EQ(clock.time_of(turns * 4096).time_since_epoch(), std::chrono::hours(30 * 24));
}

TEST(SpokeClock, TimeNeverGoesBack) {
  const SpokeClock clock(60.0, 8192);
  for (std::uint64_t n = 1'000'000'000'000; n < 1'000'000'100'000; ++n) {
    ASSERT_LT(clock.time_of(n), clock.time_of(n + 1));
  }
}

TEST(SpokeClock, RaysBetweenSpokesShareTheirTime) {
  const SpokeClock spokes(24.0, 1000), rays = spokes.with_spokes(3000);
  for (std::uint64_t n = 0; n < 5000; ++n) EXPECT_EQ(spokes.time_of(n), rays.time_of(3 * n));
}

TEST(SpokeClock, GoesOnFromWhereTheRateChanged) {
  SpokeClock clock(24.0, 2048);
  const ScenarioTime changed = clock.time_of(10'000);
  clock.change_rate(10'000, 48.0);
  EXPECT_EQ(clock.rpm(), 48.0);
  EXPECT_EQ(clock.time_of(10'000), changed);
  EXPECT_NEAR(in_seconds(clock.time_of(10'000 + 2048) - changed), 60.0 / 48.0, 1e-9);
  clock.change_rate(30'000, 24.0);
  EXPECT_NEAR(in_seconds(clock.time_of(30'000) - changed), 20'000 * 60.0 / (48.0 * 2048), 2e-9);
  EXPECT_NEAR(in_seconds(clock.time_of(30'000 + 2048) - clock.time_of(30'000)), 60.0 / 24.0, 1e-9);
}

TEST(SpokeClock, TimeNeverGoesBackWhateverTheRatesWere) {
  SpokeClock clock(24.0, 4096);
  ScenarioTime before{};
  for (std::uint64_t n = 16; n < 200'000; n += 16) {
    clock.change_rate(n, 10.0 + static_cast<double>(n * 7919 % 50'000) / 1000.0);
    ASSERT_GT(clock.time_of(n), before);
    ASSERT_LT(clock.time_of(n - 1), clock.time_of(n));
    ASSERT_LT(clock.time_of(n), clock.time_of(n + 1));
    before = clock.time_of(n);
  }
}

TEST(SpokeClock, TheSameRateAgainChangesNothing) {
  SpokeClock clock(24.0, 4096);
  const SpokeClock before = clock;
  clock.change_rate(1'000'000, 24.0);
  EXPECT_EQ(clock, before);
}

TEST(SpokeClock, RaysShareTheTimeOfSpokesAfterAChangeToo) {
  SpokeClock spokes(24.0, 1000);
  spokes.change_rate(4000, 36.0);
  const SpokeClock rays = spokes.with_spokes(3000);
  for (std::uint64_t n = 4000; n < 9000; ++n) ASSERT_EQ(spokes.time_of(n), rays.time_of(3 * n));
}

}  // namespace
}  // namespace skerry::echo
