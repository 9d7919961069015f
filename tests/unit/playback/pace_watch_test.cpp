#include "server/playback/pace_watch.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

// Plays 40 s pieces of a recording, each of which takes `each` of real time.
class PaceWatchTest : public testing::Test {
 protected:
  // How often what it says changed.
  int play(int pieces, Duration each, bool gives_up) {
    int changes = 0;
    for (int i = 0; i < pieces; ++i) {
      moment_ += 40s;
      now_ += each;
      changes += watch_.note(moment_, now_, gives_up && i % 3 == 0);
    }
    return changes;
  }
  PaceWatch watch_;
  UtcTime moment_{};
  PaceWatch::SteadyTime now_{};
};

TEST_F(PaceWatchTest, SaysNothingWhileTheRateIsHeld) {
  watch_.begin(100.0);
  EXPECT_EQ(play(1000, 400ms, false), 0);
  EXPECT_EQ(watch_.behind(), "");
}

TEST_F(PaceWatchTest, SaysWhatIsReachedOnceAWindowAndTakesItBack) {
  watch_.begin(100.0);
  EXPECT_EQ(play(4, 500ms, true), 0);  // the first one only begins
  EXPECT_EQ(play(1, 500ms, true), 1);
  EXPECT_EQ(watch_.behind(), "behind: reaches 80x of 100x");
  EXPECT_EQ(play(40, 500ms, true), 0);  // the same again
  EXPECT_EQ(play(4, 1000ms, true), 1);
  EXPECT_EQ(watch_.behind(), "behind: reaches 40x of 100x");
  EXPECT_EQ(play(5, 420ms, false), 1);  // not given up in this window, and yet too slow
  EXPECT_EQ(watch_.behind(), "behind: reaches 95x of 100x");
  EXPECT_EQ(play(4, 400ms, false), 0);
  EXPECT_EQ(play(1, 400ms, false), 1);
  EXPECT_EQ(watch_.behind(), "");
}

TEST_F(PaceWatchTest, PausesAndJumpsAreNotCountedAndAnotherRateBeginsAnew) {
  watch_.begin(16.0);
  play(1, 5s, true);
  for (int round = 0; round < 3; ++round) {
    now_ += 1h;
    moment_ -= 40s;
    EXPECT_FALSE(watch_.begin(16.0));
    play(2, 5s, true);
    EXPECT_EQ(watch_.behind(), "behind: reaches 8.0x of 16x");
  }
  EXPECT_TRUE(watch_.begin(8.0));
  EXPECT_EQ(watch_.behind(), "");
  EXPECT_FALSE(watch_.begin(8.0));
}

}  // namespace
}  // namespace skerry::server
