// How thin a relay's spokes become on links of several rates.
#include "server/relay/thin_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "protocol/thin/thin_shape.hpp"

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A radar of 13.4 Mbit/s on a link: what it does not carry is lost.
class SlowLink {
 public:
  explicit SlowLink(double bits_per_second) : carries(bits_per_second / 8.0) {}

  void pass(milliseconds time) {
    for (milliseconds gone{0}; gone < time; gone += milliseconds(100)) {
      const double bytes = 0.1 * kFull * kThinShapes[choice.level()].share;
      const double came = std::min(bytes, 0.1 * carries);
      const double share = came / bytes;
      now += milliseconds(100);
      ThinChoice::Came step{.spokes = static_cast<std::uint64_t>(655.0 * share),
                            .bytes = static_cast<std::uint64_t>(came)};
      step.took = milliseconds(100);
      if (waits) {
        step.made = Duration(static_cast<std::int64_t>(1e8 * share));
      } else {
        step.made = milliseconds(100);
        step.lost = static_cast<std::uint64_t>(655.0 * (1.0 - share));
      }
      changes += choice.look(step, now);
      if (share < 0.99) short_of += milliseconds(100);
    }
  }

  static constexpr double kFull = 1.68e6;  // bytes a second
  double carries;
  ThinChoice::Time now{};
  ThinChoice choice{std::nullopt, now};
  int changes = 0;
  milliseconds short_of{0};
  bool waits = false;  // what is not carried: or else it is lost
};

TEST(ThinChoiceTest, AFastLinkHasWholeSpokesWithinSeconds) {
  SlowLink link(20e6);
  link.pass(seconds(20));
  EXPECT_EQ(link.choice.level(), 0u);
  link.pass(seconds(600));
  EXPECT_EQ(link.choice.level(), 0u);
  EXPECT_EQ(link.changes, 4);
}

TEST(ThinChoiceTest, FindsTheLevelOfALinkAndIsSeldomWrong) {
  for (const bool waits : {false, true}) {
    for (const auto& [rate, level] : {std::pair{4e6, 1u}, {1e6, 2u}, {300e3, 3u}, {120e3, 4u}}) {
      SlowLink link(rate);
      link.waits = waits;
      link.pass(seconds(25));
      EXPECT_EQ(link.choice.level(), level) << rate;
      EXPECT_LE(link.short_of, seconds(5)) << rate;
      link.pass(seconds(3600));
      EXPECT_EQ(link.choice.level(), level) << rate;
      EXPECT_LE(link.short_of, seconds(60)) << rate;  // of an hour
      EXPECT_GE(link.short_of, seconds(15)) << rate;  // it does try
    }
  }
}

TEST(ThinChoiceTest, LeavesAsManyLevelsAsALinkLoses) {
  SlowLink link(20e6);
  link.pass(seconds(60));
  link.carries = 300e3 / 8.0;
  link.short_of = seconds(0);
  link.pass(seconds(10));
  EXPECT_EQ(link.choice.level(), 3u);
  EXPECT_LE(link.short_of, seconds(8));
  EXPECT_LE(link.changes, 6);
}

TEST(ThinChoiceTest, IsFineAgainOnceTheLinkIs) {
  SlowLink link(300e3);
  link.pass(seconds(20));
  link.carries = 20e6 / 8.0;
  link.pass(seconds(120));
  EXPECT_EQ(link.choice.level(), 0u);
}

TEST(ThinChoiceTest, LearnsNothingOfASilentRadar) {
  ThinChoice choice(std::nullopt, ThinChoice::Time{});
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(choice.look({.bytes = 100}, ThinChoice::Time{} + milliseconds(100 * i)));
  }
  EXPECT_EQ(choice.level(), kThinLevels);
}

TEST(ThinChoiceTest, AFixedLevelStays) {
  ThinChoice choice(2, ThinChoice::Time{});
  EXPECT_FALSE(
      choice.look({.spokes = 1, .lost = 1000, .bytes = 1}, ThinChoice::Time{} + seconds(60)));
  EXPECT_EQ(choice.level(), 2u);
}

}  // namespace
}  // namespace skerry::server
