// What becomes a track by itself: by areas, by rules that change, and by what a target does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "server/plotter/tracks/tracker.hpp"
#include "tests/unit/plotter/made_plots.hpp"

namespace skerry::server {
namespace {

using Acquire = Tracker::Acquire;

MadeTarget at(double bearing_deg, double range_m) {
  const double a = bearing_deg / kDegreesPerRadian;
  return {.way = straight_way({range_m * std::sin(a), range_m * std::cos(a)}, bearing_deg, 10.0)};
}

// Of the tracks, by number; whole degrees.
std::vector<int> bearings(const Tracker& tracker) {
  std::vector<int> degrees;
  for (const PlottedTrack& track : tracker.tracks())
    degrees.push_back(static_cast<int>(std::lround(track.bearing.in_degrees())) % 360);
  std::sort(degrees.begin(), degrees.end());
  return degrees;
}

// When the first track is shown, seconds; -1: never.
double shown_at(const MadeSea& sea, const Tracker::Rule& rule, double to_s) {
  Tracker tracker(rule);
  double at_s = -1.0;
  sail(sea, tracker, 0.0, to_s, [&](double t) {
    if (at_s < 0.0 && !tracker.tracks().empty()) at_s = t;
  });
  return at_s;
}

TEST(Areas, ReachAcrossNorthAndFromOneRangeToAnother) {
  MadeSea sea;
  sea.targets = {at(355, 3000), at(5, 5000), at(20, 3000), at(340, 3000), at(3, 700), at(0, 8000)};
  Tracker tracker({.acquire = Acquire::none});
  tracker.set_areas(
      {{.inner_m = 1500, .outer_m = 6500, .from_deg = 350, .to_deg = 10, .acquire = Acquire::all}});
  sail(sea, tracker, 0.0, 90.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{5, 355}));
}

TEST(Areas, AreTheOtherSideFromTheirEndToTheirBegin) {
  MadeSea sea;
  sea.targets = {at(355, 3000), at(20, 3000), at(340, 3000), at(180, 3000)};
  Tracker tracker({.acquire = Acquire::none});
  tracker.set_areas({{.outer_m = 6500, .from_deg = 10, .to_deg = 350, .acquire = Acquire::all}});
  sail(sea, tracker, 0.0, 90.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{20, 180, 340}));
}

TEST(Areas, TheFirstThatATargetIsInCounts) {
  MadeSea sea;
  sea.targets = {at(90, 3000), at(120, 7000), at(270, 3000), at(300, 7000)};
  Tracker tracker({.acquire = Acquire::none});
  // Without a width an area is all round.  None in the first excludes.
  tracker.set_areas({{.outer_m = 4000, .from_deg = 0, .to_deg = 180, .acquire = Acquire::none},
                     {.outer_m = 10'000, .from_deg = 45, .to_deg = 45, .acquire = Acquire::all}});
  sail(sea, tracker, 0.0, 90.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{120, 270, 300}));
}

TEST(Areas, ExcludeFromWhatTheRuleAcquires) {
  MadeSea sea;
  sea.targets = {at(90, 3000), at(270, 3000)};
  Tracker tracker({.acquire = Acquire::all});
  tracker.set_areas({{.outer_m = 6000, .from_deg = 200, .to_deg = 340, .acquire = Acquire::none}});
  sail(sea, tracker, 0.0, 90.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{90}));
  tracker.set_areas({});
  sail(sea, tracker, 90.0, 100.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{90, 270})) << "it was followed all the while";
}

TEST(Tracker, KeepsWhatItFollowsWhenItsRuleChanges) {
  MadeSea sea;
  sea.targets = {at(90, 3000), at(270, 3000)};
  Tracker tracker({.acquire = Acquire::all});
  sail(sea, tracker, 0.0, 60.0);
  const auto before = tracker.tracks();
  ASSERT_EQ(before.size(), 2u);
  tracker.change({.most_tracks = 1, .acquire = Acquire::none});
  sea.targets.push_back(at(180, 3000));
  sail(sea, tracker, 60.0, 120.0);
  const auto after = tracker.tracks();
  ASSERT_EQ(after.size(), 2u) << "no third one; of those that are shown none is left out";
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after[i].number, before[i].number);
    EXPECT_EQ(after[i].first_seen, before[i].first_seen);
  }
  tracker.change({.acquire = Acquire::all});
  sail(sea, tracker, 120.0, 130.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{90, 180, 270}));
}

TEST(Tracker, KeepsItsRuleIfTheNewOneIsNone) {
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  Tracker tracker({.acquire = Acquire::none});
  EXPECT_THROW(tracker.change({.acquire = Acquire::all, .sure_bits = 100.0}),
               std::invalid_argument);
  sail(sea, tracker, 0.0, 90.0);
  EXPECT_TRUE(tracker.tracks().empty());
}

// --- what is under way

TEST(UnderWay, TakesAMinuteMoreWhereEchoesStoodBefore) {
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  EXPECT_GT(shown_at(sea, {}, 120.0), 0.0);
  sea.targets[0].also = [](Plot& plot) {
    plot.stood = 0xffffffff;
    plot.stood_m = 75.0;
  };
  EXPECT_LT(shown_at(sea, {}, 60.0), 0.0);
  EXPECT_GT(shown_at(sea, {}, 120.0), 0.0) << "a long straight way outweighs that";
  EXPECT_GT(shown_at(sea, {.acquire = Acquire::all}, 60.0), 0.0);
}

TEST(UnderWay, IsAShipOverGroundWhereSheHasJustBeenHerself) {
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  sea.targets[0].also = [](Plot& plot) {
    plot.stood = 7;
    plot.stood_m = 75.0;
  };
  EXPECT_GT(shown_at(sea, {}, 120.0), 0.0);
}

// Land in sight: some extended echoes a turn, off to one side.
void put_land(MadeSea& sea) {
  for (double bearing = 0.0; bearing < 60.0; bearing += 10.0) {
    sea.targets.push_back(at(bearing, 5000));
    sea.targets.back().also = [](Plot& plot) { plot.extended = true; };
  }
}

TEST(UnderWay, TakesLongerWhereEchoesStandOrLandIs) {
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  const double at_sea_s = shown_at(sea, {}, 180.0);
  sea.targets[0].also = [](Plot& plot) { plot.by_standing = true; };
  const double by_standing_s = shown_at(sea, {}, 180.0);
  sea.targets[0].also = [](Plot&) {};
  put_land(sea);
  const double inshore_s = shown_at(sea, {}, 180.0);
  EXPECT_GT(at_sea_s, 0.0);
  EXPECT_GT(by_standing_s, at_sea_s);
  EXPECT_GE(by_standing_s, 20.0);
  EXPECT_GE(inshore_s, 20.0);
  EXPECT_LE(inshore_s, 60.0) << "in clear view";
}

TEST(UnderWay, NearLandOneBadSignIsOutweighedAndSeveralAreNot) {
  const auto old_ground = [](Plot& plot) {
    plot.stood = 0xffffffff;
    plot.stood_m = 75.0;
  };
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  put_land(sea);
  sea.targets[0].also = old_ground;
  EXPECT_GT(shown_at(sea, {}, 120.0), 0.0) << "in a sound every echo is on old ground";
  sea.targets[0].also = [&, turn = 0](Plot& plot) mutable {
    old_ground(plot);
    plot.length_m = ++turn % 2 == 0 ? 0.0 : 90.0;
    plot.greatest = turn % 2 == 0 ? 120 : 220;
  };
  EXPECT_LT(shown_at(sea, {}, 180.0), 0.0) << "and is never the same";
  for (double bearing = 90.0; bearing < 250.0; bearing += 30.0) {
    sea.targets.push_back(at(bearing, 3000));
    sea.targets.back().also = [](Plot& plot) { plot.greatest = 120; };
  }
  sea.targets.erase(sea.targets.begin());
  sea.targets.push_back(at(270, 3000));
  sea.targets.back().also = [](Plot& plot) { plot.greatest = 255; };
  Tracker tracker;
  sail(sea, tracker, 0.0, 120.0);
  EXPECT_EQ(bearings(tracker), (std::vector<int>{270})) << "the others are its lobes";
}

TEST(UnderWay, IsNoEchoNearByThatGoesAlongWithOwnShip) {
  MadeSea sea;
  sea.own = straight_way({0, 0}, 0.0, 10.0);
  sea.targets = {{.way = straight_way({100, 50}, 0.0, 10.0)}};
  for (int i = 0; i < 6; ++i) {
    sea.targets.push_back({.way = straight_way({4000, 1000.0 * i}, 0.0, 0.0)});
    sea.targets.back().also = [](Plot& plot) { plot.extended = true; };
  }
  EXPECT_LT(shown_at(sea, {}, 180.0), 0.0);
  sea.targets[0].way = straight_way({1000, 500}, 0.0, 10.0);
  EXPECT_GT(shown_at(sea, {}, 180.0), 0.0);
}

TEST(UnderWay, IsNoEchoWhoseLengthIsNeverTheSame) {
  MadeSea sea;
  sea.targets = {at(90, 3000)};
  sea.targets[0].also = [turn = 0](Plot& plot) mutable {
    plot.length_m = ++turn % 2 == 0 ? 20.0 : 200.0;
  };
  EXPECT_LT(shown_at(sea, {}, 180.0), 0.0);
  sea.targets[0].also = [](Plot& plot) { plot.length_m = 110.0; };
  EXPECT_GT(shown_at(sea, {}, 180.0), 0.0);
}

}  // namespace
}  // namespace skerry::server
