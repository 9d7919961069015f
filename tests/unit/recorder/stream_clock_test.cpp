#include "server/recorder/stream_clock.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
const UtcTime kLastYear{std::chrono::hours(24 * 365 * 55)};
const UtcTime kNow{std::chrono::hours(24 * 365 * 56)};

TEST(StreamClock, IsTheVideosOnceThereIsAny) {
  StreamClock::Steady now{};
  StreamClock clock(kNow, now, Duration::max());
  EXPECT_EQ(clock.at(now + seconds(3)), kNow + seconds(3));
  EXPECT_EQ(clock.saw(kLastYear, now), kLastYear);
  EXPECT_EQ(clock.at(now + seconds(5)), kLastYear + seconds(5));
}

TEST(StreamClock, StandsStillWithAPlayback) {
  StreamClock::Steady now{};
  StreamClock clock(kLastYear, now, seconds(1));
  EXPECT_EQ(clock.at(now + milliseconds(300)), kLastYear + milliseconds(300));
  EXPECT_EQ(clock.at(now + std::chrono::hours(3)), kLastYear + seconds(1));
}

TEST(StreamClock, GoesOnWhereAPlaybackIsRewound) {
  StreamClock::Steady now{};
  StreamClock clock(kLastYear, now, seconds(1));
  EXPECT_EQ(clock.saw(kLastYear + seconds(100), now), kLastYear + seconds(100));
  EXPECT_EQ(clock.saw(kLastYear + seconds(99), now), kLastYear + seconds(99)) << "another radar";
  EXPECT_EQ(clock.saw(kLastYear, now), kLastYear + seconds(100));
  EXPECT_EQ(clock.saw(kLastYear + seconds(7), now), kLastYear + seconds(107));
  EXPECT_EQ(clock.saw(kLastYear + seconds(3), now), kLastYear + seconds(107));
  EXPECT_EQ(clock.saw(kLastYear + seconds(60), now), kLastYear + seconds(164));
}

}  // namespace
}  // namespace skerry::server
