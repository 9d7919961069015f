#include "server/core/utc_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace skerry::server {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

const std::chrono::steady_clock::time_point kZero{hours(7)};
const UtcTime kBegin{seconds(1'795'000'000)};

// Of a system whose clock is off by so much.
ClockReading reading(Duration since, Duration off) { return {kZero + since, kBegin + since + off}; }

class Follower : public testing::Test {
 protected:
  UtcTime at(Duration since) const { return follower_.clock().at(ScenarioTime(since)); }
  ClockFollower follower_{{kZero, kBegin}};
};

TEST_F(Follower, LeavesAClockAloneThatGoesOn) {
  for (int i = 1; i <= 100; ++i) {
    const Duration noise = microseconds(i % 2 == 0 ? 900 : -900);
    EXPECT_FALSE(follower_.look(reading(seconds(i), noise)));
  }
  EXPECT_EQ(follower_.clock(), (UtcClock{{}, kBegin, 0}));
}

TEST_F(Follower, StepsWithTheSystemForthAndBack) {
  const auto forth = follower_.look(reading(seconds(5), hours(1)));
  ASSERT_TRUE(forth);
  EXPECT_EQ(forth->before, kBegin + seconds(5));
  EXPECT_EQ(forth->by(), hours(1));
  EXPECT_EQ(at(seconds(9)), kBegin + seconds(9) + hours(1));
  EXPECT_FALSE(follower_.look(reading(seconds(6), hours(1))));
  const auto back = follower_.look(reading(seconds(7), milliseconds(-70)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->by(), -hours(1) - milliseconds(70));
  EXPECT_EQ(at(seconds(8)), kBegin + seconds(8) - milliseconds(70));
}

// Whatever looks say, UTC never stands still, runs back or leaps between them.
TEST_F(Follower, MakesUpForALittleSmoothly) {
  for (const Duration off : {Duration(milliseconds(30)), Duration(milliseconds(-49))}) {
    Duration worst{};
    for (int i = 1; i <= 300; ++i) {
      const Duration now = seconds(i);
      const UtcTime before = at(now);
      EXPECT_FALSE(follower_.look(reading(now, off)));
      EXPECT_EQ(at(now), before) << i;
      worst = std::max(
          worst, Duration(std::chrono::abs(at(now + seconds(1)) - before - Duration(seconds(1)))));
    }
    EXPECT_LE(std::chrono::abs(at(seconds(301)) - (kBegin + seconds(301) + off)),
              ClockFollower::kIgnored);
    EXPECT_EQ(follower_.clock().slew_ppm, 0);
    EXPECT_LE(worst, Duration(microseconds(ClockFollower::kSlewPpm)));
    follower_ = ClockFollower({kZero, kBegin});
  }
}

TEST(ReadClocks, GivesOneMomentOnBoth) {
  const ClockReading first = read_clocks();
  const ClockReading second = read_clocks();
  EXPECT_GE(second.steady, first.steady);
  EXPECT_GT(first.utc.time_since_epoch(), Duration(hours(24 * 365 * 50)));
}

}  // namespace
}  // namespace skerry::server
