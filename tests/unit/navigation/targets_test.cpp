#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

constexpr double kNm = 1852.0;

// Flinders Peak to Buninyong: the worked example of the Geocentric Datum of Australia technical
// manual (GRS80, from which WGS-84 differs by less than 0.1 mm here).
TEST(TargetGeometry, AgreesWithAPublishedLine) {
  const GeoPoint flinders{-(37 + 57 / 60.0 + 3.72030 / 3600), 144 + 25 / 60.0 + 29.52440 / 3600};
  const GeoPoint buninyong{-(37 + 39 / 60.0 + 10.15610 / 3600), 143 + 55 / 60.0 + 35.38390 / 3600};
  const TargetPlace place = place_of(buninyong, flinders);
  EXPECT_NEAR(place.range_m, 54972.271, 0.001);
  EXPECT_NEAR(place.bearing_deg, 306 + 52 / 60.0 + 5.37 / 3600, 0.01 / 3600);
}

// Against ships that sail second by second.
TEST(TargetGeometry, ClosestApproachIsWhereStepsFindIt) {
  const struct {
    TargetPlace place;
    TargetMotion target, own;
  } cases[] = {{{5000, 45}, {270, 8}, {0, 6}},
               {{9000, 300}, {120, 10}, {80, 3}},
               {{2000, 180}, {200, 5}, {350, 7}},
               {{1000, 0}, {0, 0}, {0, 4}}};
  for (const auto& one : cases) {
    const Approach approach = approach_of(one.place, one.target, one.own);
    const auto distance_at = [&](double t) {
      const auto part = [&](auto f) {
        return one.place.range_m * f(one.place.bearing_deg * M_PI / 180) +
               t * (one.target.speed_mps * f(one.target.course_deg * M_PI / 180) -
                    one.own.speed_mps * f(one.own.course_deg * M_PI / 180));
      };
      return std::hypot(part([](double a) { return std::sin(a); }),
                        part([](double a) { return std::cos(a); }));
    };
    double best = distance_at(0), when = 0;
    for (int t = -4000; t <= 4000; ++t) {
      if (distance_at(t) < best) {
        best = distance_at(t);
        when = t;
      }
    }
    EXPECT_NEAR(approach.tcpa_s, when, 1.0);
    EXPECT_NEAR(approach.cpa_m, best, 1.0);
  }
  const Approach kept = approach_of({3000, 90}, {45, 7}, {45, 7});
  EXPECT_EQ(kept.cpa_m, 3000);
  EXPECT_EQ(kept.tcpa_s, 0);
}

class Tracking : public testing::Test {
 protected:
  std::vector<Track> update(double time_s) {
    return table.update({60.0, 5.0}, world.items, at_seconds(time_s));
  }
  TestWorld world;
  TrackTable table{12 * kNm, 3, std::chrono::seconds(4)};
};

TEST_F(Tracking, TheNearestAreTrackedAndMarksAreNot) {
  world.add(10, 8);
  world.add(11, 2);
  world.add(12, 4, 5, TrafficKind::boat);
  world.add(13, 6);
  world.add(14, 1, 0, TrafficKind::aid_to_navigation);
  world.add(15, 1, 0, TrafficKind::other);
  const auto tracks = update(0);
  ASSERT_EQ(tracks.size(), 3u);
  EXPECT_EQ(tracks[0].target.number, 11u);
  EXPECT_EQ(tracks[1].target.number, 12u);
  EXPECT_EQ(tracks[2].target.number, 13u);
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(tracks[i].number, i + 1);
}

TEST_F(Tracking, ATargetKeepsItsNumberWhileOthersComeNearer) {
  world.add(1, 10);
  world.add(2, 11);
  ASSERT_EQ(update(0).size(), 2u);
  world.add(3, 1);
  world.add(4, 1);
  const auto tracks = update(1);
  ASSERT_EQ(tracks.size(), 3u) << "three at most";
  EXPECT_EQ(tracks[0].target.number, 1u);
  EXPECT_EQ(tracks[1].target.number, 2u);
  EXPECT_EQ(tracks[2].target.number, 3u);
}

TEST_F(Tracking, OneThatLeavesIsSaidToBeLostAndThenItsNumberIsFree) {
  world.add(1, 11.9);
  world.add(2, 5);
  EXPECT_EQ(update(0).size(), 2u);
  world.items[0].position.latitude_deg = 60.0 + 12.9 / 60;
  EXPECT_FALSE(update(1).at(1).lost) << "within a tenth of the range she stays";
  world.items[0].position.latitude_deg = 60.0 + 13.4 / 60;
  world.add(3, 7);
  auto tracks = update(2);
  ASSERT_EQ(tracks.size(), 3u);
  EXPECT_TRUE(tracks[1].lost);
  EXPECT_EQ(tracks[1].target.number, 1u);
  EXPECT_EQ(tracks[2].target.number, 3u) << "the next free number";
  world.items[0].position.latitude_deg = 60.0 + 5.0 / 60;
  tracks = update(4);
  ASSERT_EQ(tracks.size(), 4u) << "found again, she is a new track";
  EXPECT_TRUE(tracks[1].lost);
  EXPECT_EQ(tracks[3].target.number, 1u);
  tracks = update(6.5);
  ASSERT_EQ(tracks.size(), 3u);
  for (const Track& track : tracks) EXPECT_FALSE(track.lost);
}

}  // namespace
}  // namespace skerry::server
