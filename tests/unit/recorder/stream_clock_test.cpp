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

// The clock of the system is set while two radars turn, each of which sees it a little later.
TEST(StreamClock, GoesOnWhereTheSystemsClockIsSet) {
  for (const Duration by : {Duration(std::chrono::hours(1)), Duration(std::chrono::hours(-1)),
                            Duration(milliseconds(-80))}) {
    StreamClock::Steady now{};
    StreamClock clock(kNow, now, Duration::max());
    const auto saw = [&](std::uint32_t radar, Duration scenario, Duration set) {
      return clock.saw({radar, 0}, kNow + scenario + set, ScenarioTime(scenario), now) - kNow;
    };
    const Duration none{};
    EXPECT_EQ(saw(0, seconds(1), none), seconds(1));
    EXPECT_EQ(saw(1, seconds(1), none), seconds(1));
    EXPECT_FALSE(clock.stepped());
    EXPECT_EQ(saw(0, seconds(2), by), seconds(2));
    EXPECT_EQ(clock.stepped(), by);
    EXPECT_EQ(saw(1, seconds(2), none), seconds(2)) << "it has not seen it yet";
    EXPECT_EQ(saw(1, seconds(3), by), seconds(3));
    EXPECT_FALSE(clock.stepped()) << "it is the same";
    EXPECT_EQ(saw(0, seconds(4), none), seconds(4));
    EXPECT_EQ(clock.stepped(), -by);
    EXPECT_EQ(saw(0, seconds(5), milliseconds(3)), seconds(5) + milliseconds(3))
        << "little by little";
  }
}

// Views of a radar are taken one after the other, several sectors of each.
TEST(StreamClock, TellsAStepOnceForAllViews) {
  StreamClock clock(kNow, {}, Duration::max());
  int told = 0;
  for (const std::uint32_t view : {0u, 1u, 2u}) {
    for (int s = 1; s <= 4; ++s) {
      const Duration since = milliseconds(10 * s);
      const Duration set = s > 2 ? seconds(3600) : seconds(0);
      EXPECT_EQ(clock.saw({0, view}, kNow + since + set, ScenarioTime(since), {}), kNow + since);
      told += clock.stepped().has_value() ? 1 : 0;
    }
  }
  EXPECT_EQ(told, 1);
}

// A radar may be in standby when the clock is set, and so may all.
TEST(StreamClock, GoesOnWithARadarThatComesLater) {
  for (const Duration by : {Duration(std::chrono::hours(1)), Duration(std::chrono::hours(-1))}) {
    StreamClock clock(kNow, {}, Duration::max(), kNow);
    for (const std::uint32_t radar : {3u, 1u}) {
      const Duration since = seconds(10 * (4 - radar));
      EXPECT_EQ(clock.saw({radar, 0}, kNow + since + by, ScenarioTime(since), {}), kNow + since);
      EXPECT_EQ(clock.stepped().has_value(), radar == 3);
    }
  }
}

// Beside a real radar, whose spokes bear the system's clock as they come.
TEST(StreamClock, GoesOnceWhereARealRadarGoes) {
  for (const int hours : {1, -1}) {
    StreamClock clock(kNow, {}, Duration::max());
    const Duration by = std::chrono::hours(hours);
    UtcTime last = kNow;
    for (int s = 1; s <= 30; ++s) {
      const Duration set = s >= 10 ? by : Duration{};
      const Duration followed = s >= 20 ? by : Duration{};
      const Duration real(seconds(s) + set);
      last = std::max(last,
                      clock.saw({1, 0}, kNow + real, ScenarioTime(std::max(Duration{}, real)), {}));
      last = std::max(
          last, clock.saw({0, 0}, kNow + seconds(s) + followed, ScenarioTime(seconds(s)), {}));
    }
    EXPECT_LE(last - kNow, seconds(30) + std::max(by, Duration{})) << hours;
  }
}

TEST(StreamClock, TakesNoPlayedStepForOne) {
  StreamClock::Steady now{};
  StreamClock clock(kLastYear, now, seconds(1));
  EXPECT_EQ(clock.saw({0, 0}, kLastYear, ScenarioTime(seconds(1)), now), kLastYear);
  EXPECT_EQ(clock.saw({0, 0}, kNow, ScenarioTime(seconds(2)), now), kNow);
  EXPECT_FALSE(clock.stepped());
}

}  // namespace
}  // namespace skerry::server
