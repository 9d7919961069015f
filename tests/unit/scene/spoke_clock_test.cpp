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

}  // namespace
}  // namespace skerry::echo
