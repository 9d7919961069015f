#include "server/app/load_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Radars of 100 sectors a second, and what is told of them.
class Watched : public testing::Test {
 protected:
  explicit Watched(std::uint32_t radars = 3) {
    for (std::uint32_t i = 0; i < radars; ++i) radars_.push_back({.radar = i});
    watch_.look(radars_, now_);
  }
  // The next look, of `share` sectors left out by the first `late` radars.
  void look(double share = 0.0, std::size_t late = 3, LoadWatch::Steady::duration after = {}) {
    now_ += LoadWatch::kLook + after;
    for (std::size_t i = 0; i < radars_.size(); ++i) {
      radars_[i].sectors += 25;
      if (i < late) radars_[i].skipped += static_cast<std::uint64_t>(25 * share);
    }
    take();
  }
  void take() {
    for (const LoadWatch::Line& line : watch_.look(radars_, now_)) told_.push_back(line.text);
  }

  LoadWatch watch_;
  LoadWatch::Steady now_{seconds(1000)};
  std::vector<RadarPace> radars_;
  std::vector<std::string> told_;
};

TEST_F(Watched, NothingIsToldWhileAllKeepPace) {
  for (int i = 0; i < 1000; ++i) look();
  EXPECT_THAT(told_, IsEmpty());
}

TEST_F(Watched, AnOverloadHasABeginAnEndAndTotals) {
  look();
  for (int i = 0; i < 40; ++i) look(0.8, 2);
  EXPECT_THAT(told_, ElementsAre(HasSubstr("2 of 3 radars leave out sectors that they have no time "
                                           "for (radar 0, 1)")));
  for (int i = 0; i < 1000; ++i) look();
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_THAT(
      told_[1],
      HasSubstr("the overload is over: 1600 of 3000 sectors (53.3 %) were left out in 10 s"));
}

TEST_F(Watched, AnHourOfOverloadIsALineAMinute) {
  for (int i = 0; i < 4 * 3600; ++i) look(i % 4 == 0 ? 1.0 : 0.0);
  EXPECT_EQ(told_.size(), 60u);
  EXPECT_THAT(told_.back(), HasSubstr("overload goes on"));
  const auto end = watch_.end();
  ASSERT_EQ(end.size(), 1u);
  EXPECT_THAT(end[0].text, HasSubstr("there was an overload: 270000 of 1079775 sectors (25.0 %)"))
      << "75 in each of 14,397 looks, and all of these in each fourth";
}

// A hiccup now and then, which is over each time.
TEST_F(Watched, WhatComesAndGoesIsTwoLinesAMinute) {
  for (int i = 0; i < 4 * 3600; ++i) look(i % 24 == 0 ? 1.0 : 0.0);
  EXPECT_LE(told_.size(), 2u * 60u);
  EXPECT_GE(told_.size(), 60u);
}

TEST(LoadWatch, NothingIsToldOfNoRadars) {
  LoadWatch watch;
  LoadWatch::Steady now{std::chrono::hours(1000)};
  for (int i = 0; i < 100; ++i) EXPECT_THAT(watch.look({}, now += LoadWatch::kLook), IsEmpty());
}

// As after SIGSTOP and SIGCONT: the radars leave out what they missed.
TEST_F(Watched, AStandstillOfTheServerIsNoOverload) {
  look();
  now_ += seconds(10);
  look();
  for (RadarPace& radar : radars_) {
    radar.sectors += 1000;
    radar.skipped += 1000;
  }
  for (int i = 0; i < 50; ++i) look();
  EXPECT_THAT(told_, ElementsAre("the server stood still for 10.0 s; 3000 sectors of its radars "
                                 "were never made"));
}

TEST_F(Watched, ARadarMayStandStillAlone) {
  look();
  for (int i = 0; i < 12; ++i) {
    now_ += LoadWatch::kLook;
    for (std::size_t other : {0, 2}) radars_[other].sectors += 25;
    take();
  }
  EXPECT_THAT(told_, ElementsAre(HasSubstr("radar 1 stands still")));
  radars_[1].skipped += 300;
  look();
  for (int i = 0; i < 50; ++i) look();
  ASSERT_EQ(told_.size(), 2u);
  EXPECT_THAT(told_[1], HasSubstr("radar 1 goes on after 3.2 s; 300 of its sectors"));
}

}  // namespace
}  // namespace skerry::server
