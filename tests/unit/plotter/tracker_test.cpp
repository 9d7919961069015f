// Plots of known targets, and what the tracker makes of them.
#include "server/plotter/tracks/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/unit/plotter/made_plots.hpp"

namespace skerry::server {
namespace {

constexpr Tracker::Rule kAll{.acquire = Tracker::Acquire::all};

double knots(PlanePoint v) { return length_of(v) * 3600.0 / 1852.0; }
double course_deg(PlanePoint v) {
  const double deg = std::atan2(v.east_m, v.north_m) * kDegreesPerRadian;
  return deg < 0.0 ? deg + 360.0 : deg;
}
double off_deg(double a, double b) { return std::fabs(std::remainder(a - b, 360.0)); }

// How far a track is from a place, m.
double off_m(const MadeSea& sea, const PlottedTrack& track, PlanePoint place) {
  const GeoPoint at = sea.geo(place);
  const double north = (track.place.latitude_deg - at.latitude_deg) * 111'229.0;
  const double east = (track.place.longitude_deg - at.longitude_deg) * 111'500.0 *
                      std::cos(at.latitude_deg / kDegreesPerRadian);
  return std::sqrt(north * north + east * east);
}

// A way that turns at `rate_deg_s` between two times.
Way turning_way(PlanePoint from, double course_deg, double speed_kn, double rate_deg_s,
                double begin_s, double end_s) {
  return [=](double t) {
    const double v = speed_kn * 1852.0 / 3600.0;
    PlanePoint at = from;
    constexpr double kStep = 0.05;
    // Summed up: slow, and exact enough for a test.
    static thread_local std::map<std::pair<double, double>, std::vector<PlanePoint>> known;
    auto& places = known[{from.east_m * 7 + from.north_m, rate_deg_s + course_deg + speed_kn}];
    const auto need = static_cast<std::size_t>(t / kStep) + 1;
    if (places.empty()) places.push_back(from);
    while (places.size() <= need) {
      const double now = static_cast<double>(places.size() - 1) * kStep;
      const double turned = rate_deg_s * (std::clamp(now, begin_s, end_s) - begin_s);
      const double c = (course_deg + turned) / kDegreesPerRadian;
      places.push_back(places.back() + PlanePoint{std::sin(c), std::cos(c)} * (v * kStep));
    }
    at = places[need];
    return at;
  };
}

TEST(Tracker, ShowsATargetAfterAFewTurnsAndKnowsItsMotionAfterAMinute) {
  MadeSea sea;
  sea.own = straight_way({0, 0}, 30, 10);
  sea.targets = {{straight_way({3000, 3000}, 270, 12)}};
  Tracker tracker(kAll);
  double shown_s = 0.0;
  sail(sea, tracker, 0, 180, [&](double t) {
    const auto tracks = tracker.tracks();
    if (!tracks.empty() && shown_s == 0.0) shown_s = t;
    if (t > 57.0 && t < 60.0) {
      ASSERT_EQ(tracks.size(), 1u);
      EXPECT_NEAR(knots(tracks[0].velocity_mps), 12.0, 1.5);
      EXPECT_LT(off_deg(course_deg(tracks[0].velocity_mps), 270.0), 11.0);
    }
  });
  EXPECT_GT(shown_s, 7.0);
  EXPECT_LT(shown_s, 20.0);
  const auto tracks = tracker.tracks();
  ASSERT_EQ(tracks.size(), 1u);
  const PlottedTrack& track = tracks[0];
  EXPECT_NEAR(knots(track.velocity_mps), 12.0, 0.3);
  EXPECT_LT(off_deg(course_deg(track.velocity_mps), 270.0), 1.5);
  const double t = std::chrono::duration<double>(track.time.time_since_epoch()).count();
  EXPECT_LT(off_m(sea, track, sea.targets[0].way(t)), 15.0);
  const PlanePoint own_mps = sea.own(1.0) - sea.own(0.0);
  EXPECT_LT(length_of(track.relative_velocity_mps - (track.velocity_mps - own_mps)), 0.05);
  EXPECT_EQ(track.number, 1u);
  EXPECT_EQ(track.hits, 10);
  EXPECT_EQ(tracker.counts().resets, 0u);
}

TEST(Tracker, LooksOnceATurnAlsoAcrossNorthAndForOneThatGoesWithTheAntenna) {
  MadeSea sea;
  // It crosses north, near enough to go some degrees a turn, with the antenna and against it.
  sea.targets = {{straight_way({-400, 600}, 90, 25)}, {straight_way({400, -700}, 270, -25)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 80, [&](double t) {
    if (t < 30.0) return;
    const auto tracks = tracker.tracks();
    ASSERT_EQ(tracks.size(), 2u) << t;
    for (const PlottedTrack& track : tracks) EXPECT_EQ(track.hits, 10) << t;
  });
  EXPECT_LE(tracker.counts().followed, 2u);
}

// Held and known through a turn of ninety degrees and a full stop.
TEST(Tracker, HoldsOneThatManoeuvres) {
  for (const double rate : {0.5, 1.5, 3.0}) {
    MadeSea sea;
    sea.targets = {{turning_way({2000, 4000}, 180, 15, rate, 120, 120 + 90 / rate)}};
    Tracker tracker(kAll);
    double worst_m = 0.0;
    sail(sea, tracker, 0, 420, [&](double t) {
      const auto tracks = tracker.tracks();
      if (t < 60.0) return;
      ASSERT_EQ(tracks.size(), 1u) << rate << " deg/s, " << t << " s";
      const double at = std::chrono::duration<double>(tracks[0].time.time_since_epoch()).count();
      worst_m = std::max(worst_m, off_m(sea, tracks[0], sea.targets[0].way(at)));
      if (t > 120 + 90 / rate + 60.0) {
        EXPECT_LT(off_deg(course_deg(tracks[0].velocity_mps), 270.0), 8.0) << t;
        EXPECT_NEAR(knots(tracks[0].velocity_mps), 15.0, 1.5) << t;
      }
    });
    EXPECT_EQ(tracker.tracks()[0].number, 1u);
    EXPECT_LT(worst_m, 70.0) << rate;
  }
}

TEST(Tracker, HoldsOneThatIsSeenInHalfOfTheTurns) {
  unsigned numbers = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    MadeSea sea;
    sea.seed = seed;
    sea.targets = {{straight_way({1000, 5000}, 135, 10), 0.5}};
    Tracker tracker(kAll);
    sail(sea, tracker, 0, 600);
    const auto tracks = tracker.tracks();
    ASSERT_EQ(tracks.size(), 1u) << seed;
    numbers += tracks[0].number;
  }
  // By chance one in a thousand runs of ten turns shows nothing: 1200 turns.
  EXPECT_LE(numbers, 5u + 3u);
}

TEST(Tracker, LosesOneThatIsGoneAndSaysSoOnce) {
  MadeSea sea;
  const Way way = straight_way({1000, 5000}, 135, 10);
  sea.targets = {{[=](double t) { return t < 100.0 ? way(t) : PlanePoint{1e6, 1e6}; }}};
  Tracker tracker(kAll);
  double lost_s = 0.0;
  int told = 0;
  sail(sea, tracker, 0, 300, [&](double t) {
    for (const PlottedTrack& track : tracker.take_lost()) {
      ++told;
      lost_s = t;
      EXPECT_EQ(track.status, TrackStatus::lost);
      EXPECT_EQ(track.number, 1u);
    }
  });
  EXPECT_EQ(told, 1);
  EXPECT_GT(lost_s, 100.0 + 5 * 2.5) << "held for five turns at least";
  EXPECT_LT(lost_s, 100.0 + 12 * 2.5);
  EXPECT_TRUE(tracker.tracks().empty());
}

// Two ships whose ways cross, at several angles: each keeps her number.
// Its numbers, of a target that is out of sight for two minutes.
std::vector<std::uint32_t> numbers_of_one_that_hides(double course_then_deg, double off_m,
                                                     double hidden_s = 120.0) {
  MadeSea sea;
  const double mps = 12.0 * 1852.0 / 3600.0, back_s = 120.0 + hidden_s;
  const Way before = straight_way({1500, -3000}, 0.0, 12.0);
  const Way after = straight_way({1500 + off_m, -3000 + mps * back_s}, course_then_deg, 12.0);
  sea.targets = {{.way = [=](double t) {
    if (t < 120.0) return before(t);
    // Far beyond what is used.
    return t < back_s ? PlanePoint{90'000, 0} : after(t - back_s);
  }}};
  Tracker tracker;
  std::set<std::uint32_t> numbers;
  sail(sea, tracker, 0.0, back_s + 60.0, [&](double) {
    for (const PlottedTrack& track : tracker.tracks()) numbers.insert(track.number);
  });
  return {numbers.begin(), numbers.end()};
}

TEST(Tracker, KnowsOneAgainThatComesOutWhereItsCourseHasIt) {
  using Numbers = std::vector<std::uint32_t>;
  EXPECT_EQ(numbers_of_one_that_hides(0.0, 0.0), Numbers{1});
  EXPECT_EQ(numbers_of_one_that_hides(5.0, 100.0), Numbers{1}) << "a little off";
  EXPECT_EQ(numbers_of_one_that_hides(0.0, 800.0), (Numbers{1, 2})) << "elsewhere";
  EXPECT_EQ(numbers_of_one_that_hides(120.0, 0.0), (Numbers{1, 2})) << "another way";
  EXPECT_EQ(numbers_of_one_that_hides(0.0, 0.0, 330.0), (Numbers{1, 2})) << "after long";
}

TEST(Tracker, KeepsTwoApartThatCross) {
  int swaps = 0, runs = 0;
  for (const double angle : {30.0, 60.0, 90.0, 180.0}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed, ++runs) {
      MadeSea sea;
      sea.seed = seed;
      const double mps = 12.0 * 1852.0 / 3600.0, a = angle / kDegreesPerRadian;
      const PlanePoint meet{1000, 4000};
      // They meet after 150 s; the second is 60 m late.
      const PlanePoint one = meet - PlanePoint{0, 1} * (mps * 150.0);
      const PlanePoint two = meet - PlanePoint{std::sin(a), std::cos(a)} * (mps * 150.0 + 60.0);
      sea.targets = {{straight_way(one, 0, 12)}, {straight_way(two, angle, 12)}};
      Tracker tracker(kAll);
      std::map<std::uint32_t, std::size_t> first;
      sail(sea, tracker, 0, 300, [&](double t) {
        if (t < 60.0 || (t > 90.0 && t < 297.0)) return;
        for (const PlottedTrack& track : tracker.tracks()) {
          const double at = std::chrono::duration<double>(track.time.time_since_epoch()).count();
          const std::size_t whose =
              off_m(sea, track, sea.targets[0].way(at)) < off_m(sea, track, sea.targets[1].way(at))
                  ? 0
                  : 1;
          if (t < 90.0) {
            first.emplace(track.number, whose);
          } else if (!first.contains(track.number) || first[track.number] != whose) {
            ++swaps;
          }
        }
      });
      EXPECT_EQ(first.size(), 2u);
    }
  }
  EXPECT_LE(swaps, 2) << "of " << runs << " runs";
}

TEST(Tracker, MakesHardlyATrackOfPlotsThatAreThereByChance) {
  MadeSea sea;
  sea.false_a_turn = 100;
  Tracker tracker(kAll);
  std::set<std::uint32_t> numbers;
  sail(sea, tracker, 0, 1800, [&](double) {
    for (const PlottedTrack& track : tracker.tracks()) numbers.insert(track.number);
  });
  EXPECT_LE(numbers.size(), 2u) << "in half an hour of a hundred false plots a turn";
  EXPECT_LT(tracker.counts().followed, 600u);
}

TEST(Tracker, OfItselfShowsWhatMovesAndByHandWhatStays) {
  MadeSea sea;
  sea.targets = {{straight_way({3000, 3000}, 270, 12)}, {straight_way({-2000, 1000}, 0, 0)}};
  Tracker tracker(Tracker::Rule{});
  sail(sea, tracker, 0, 120);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_NEAR(knots(tracker.tracks()[0].velocity_mps), 12.0, 1.0);
  EXPECT_EQ(tracker.acquire(sea.geo({0, -3000}), 200.0), 0u) << "no echo there";
  const std::uint32_t number = tracker.acquire(sea.geo({-2030, 980}), 200.0);
  EXPECT_EQ(number, 2u);
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_TRUE(tracker.tracks()[1].by_hand);
  EXPECT_TRUE(tracker.cancel(number));
  EXPECT_FALSE(tracker.cancel(number));
  EXPECT_FALSE(tracker.cancel(0));
  sail(sea, tracker, 120, 180);
  EXPECT_EQ(tracker.tracks().size(), 1u) << "cancelled is not acquired anew";
}

TEST(Tracker, HasRoomForSoManyAndNoMore) {
  MadeSea sea;
  for (int i = 0; i < 12; ++i) {
    sea.targets.push_back({straight_way({-3000.0 + 500.0 * i, 2000}, 0, 8)});
  }
  Tracker tracker({.most_tracks = 10, .acquire = Tracker::Acquire::all});
  sail(sea, tracker, 0, 60);
  EXPECT_EQ(tracker.tracks().size(), 10u);
  EXPECT_GT(tracker.counts().left_out, 0u);
}

// Own ship goes so far that the plane is laid anew several times.
TEST(Tracker, IsTheSameWhereverOwnShipGoes) {
  MadeSea sea;
  sea.own = straight_way({0, 0}, 60, 40);
  sea.targets = {{straight_way({1500, -800}, 60, 42)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 2400, [&](double t) {
    if (t < 200.0) return;
    const auto tracks = tracker.tracks();
    ASSERT_EQ(tracks.size(), 1u) << t;
    EXPECT_EQ(tracks[0].number, 1u);
    // The kit's sphere is not the ellipsoid: some thousandths over 50 km.
    EXPECT_NEAR(knots(tracks[0].velocity_mps), 42.0, 0.6) << t;
    EXPECT_NEAR(knots(tracks[0].relative_velocity_mps), 2.0, 0.6) << t;
  });
}

TEST(Tracker, DoesNotLoseWhatItsVideoDoesNotShow) {
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 120);
  // The range is set to less than the target's, or a sector is blind.
  sea.targets[0].seen = 0.0;
  sea.reach_m = 1500.0;
  sail(sea, tracker, 120, 160);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  sea.targets[0].seen = 1.0;
  sea.reach_m = 12'000.0;
  sail(sea, tracker, 160, 200);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].number, 1u);
  EXPECT_TRUE(tracker.take_lost().empty());
}

TEST(Tracker, AcquiresFastOnesAlsoOfSlowAntennas) {
  for (const auto& [rpm, speed_kn] :
       {std::pair{24.0, 75.0}, std::pair{12.0, 60.0}, std::pair{6.0, 50.0}, std::pair{3.0, 35.0}}) {
    MadeSea sea;
    sea.rpm = rpm;
    sea.targets = {{straight_way({-6000, 3000}, 90, speed_kn)}};
    Tracker tracker(kAll);
    sail(sea, tracker, 0, 12 * 60.0 / rpm);
    const auto tracks = tracker.tracks();
    ASSERT_EQ(tracks.size(), 1u) << rpm << " rpm, " << speed_kn << " kn";
    EXPECT_NEAR(knots(tracks[0].velocity_mps), speed_kn, 0.1 * speed_kn);
    EXPECT_GE(tracks[0].hits, 8);
  }
}

// Near by and exactly measured, a ship that turns leaves a narrow gate.
TEST(Tracker, HoldsOneThatTurnsHard) {
  int lost = 0, runs = 0;
  for (const double speed_kn : {10.0, 20.0}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed, ++runs) {
      MadeSea sea;
      sea.seed = seed;
      sea.range_sigma_m = 6.0;
      sea.targets = {{turning_way({1000, 1500}, 180, speed_kn, 3.0, 120, 150)}};
      Tracker tracker(kAll);
      sail(sea, tracker, 0, 240);
      const auto tracks = tracker.tracks();
      if (tracks.size() != 1 || tracks[0].number != 1) ++lost;
    }
  }
  EXPECT_EQ(lost, 0) << "of " << runs;
}

// Every turn the same sector has no video, and a target lies in it.
TEST(Tracker, MissesNothingWhereSpokesAreMissing) {
  for (const double dark_deg : {12.0, 60.0}) {
    MadeSea sea;
    sea.targets = {{straight_way({2000, 2000}, 0, 0)}};
    Tracker tracker(kAll);
    sail(sea, tracker, 0, 60);
    ASSERT_EQ(tracker.tracks().size(), 1u);
    const double width = 1.0 / kDegreesPerRadian;
    for (int n = 0; n < 20 * 360; ++n) {
      const double deg = n % 360;
      if (std::fabs(deg - 45.0) < dark_deg / 2.0) continue;
      const double t = 60.0 + n * 2.5 / 360.0;
      tracker.pass({.time = ScenarioTime(
                        std::chrono::duration_cast<Duration>(std::chrono::duration<double>(t))),
                    .utc = {},
                    .own_ship = sea.origin,
                    .bearing = TrueBearing::from(degrees(deg)),
                    .reach_m = sea.reach_m,
                    .width_rad = width});
    }
    EXPECT_EQ(tracker.tracks().size(), 1u) << dark_deg << " deg";
  }
}

TEST(Tracker, LosesWhatItCannotSeeForMinutes) {
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 60);
  sea.reach_m = 1000.0;
  sea.targets[0].seen = 0.0;
  sail(sea, tracker, 60, 240);
  EXPECT_TRUE(tracker.tracks().empty());
  EXPECT_EQ(tracker.take_lost().size(), 1u);
}

TEST(Tracker, LosesAllWhenTheAntennaStops) {
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 60);
  for (int second = 60; second < 300; second += 5) {
    tracker.pass({.time = ScenarioTime(std::chrono::seconds(second)),
                  .utc = {},
                  .own_ship = sea.origin,
                  .bearing = {},
                  .reach_m = sea.reach_m,
                  .width_rad = 0.01});
  }
  EXPECT_TRUE(tracker.tracks().empty());
}

// So near to one another that all compete with all.
TEST(Tracker, HoldsAFleetInCloseFormation) {
  MadeSea sea;
  sea.range_sigma_m = 5.0;
  sea.bearing_sigma_deg = 0.1;
  for (int i = 0; i < 64; ++i) {
    sea.targets.push_back(
        {straight_way({2000.0 + 60.0 * (i % 8), 2000.0 + 60.0 * (i / 8)}, 45, 10)});
  }
  Tracker tracker(kAll);
  std::size_t lost = 0;
  sail(sea, tracker, 0, 150, [&](double t) {
    if (t > 60.0) lost += tracker.take_lost().size();
  });
  EXPECT_GE(tracker.tracks().size(), 60u);
  EXPECT_LE(tracker.tracks().size(), 70u);
  EXPECT_LE(lost, 4u);
}

TEST(Tracker, TwoPiecesOfOneHullBecomeOne) {
  MadeSea sea;
  sea.range_sigma_m = 5.0;
  for (const double ahead_m : {-45.0, 45.0}) {
    sea.targets.push_back({.way = straight_way({2500, ahead_m}, 0.0, 10.0)});
    sea.targets.back().also = [](Plot& plot) { plot.length_m = 70.0; };
  }
  Tracker tracker(kAll);
  std::size_t most = 0, lost = 0;
  sail(sea, tracker, 0.0, 120.0, [&](double) {
    most = std::max(most, tracker.tracks().size());
    lost += tracker.take_lost().size();
  });
  EXPECT_EQ(most, 2u);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].number, 1u) << "the older one stays";
  EXPECT_EQ(lost, 0u) << "nobody is lost";
  // Two small ones as far apart stay two.
  for (MadeTarget& target : sea.targets) target.also = [](Plot&) {};
  Tracker another(kAll);
  sail(sea, another, 0.0, 120.0);
  EXPECT_EQ(another.tracks().size(), 2u);
}

// The cause of an echo to and fro has no plot for a minute.
TEST(Tracker, LeavesOutAnEchosEchoOnceItsCauseIsSeen) {
  const Way cause = straight_way({2500, 800}, 20.0, 10.0);
  MadeSea sea;
  sea.range_sigma_m = 5.0;
  sea.bearing_sigma_deg = 0.1;
  const Way nowhere = [](double) { return PlanePoint{90'000, 0}; };
  sea.targets = {{.way = [&](double t) { return sea.own(t) + (cause(t) - sea.own(t)) * 2.0; }},
                 {.way = [&](double t) { return t < 60.0 ? nowhere(t) : cause(t); }},
                 // Astern of the cause, at twice her range for a moment: another ship.
                 {.way = straight_way({5600, 1700}, 290.0, 12.0)}};
  Tracker tracker(kAll);
  std::size_t lost = 0, before = 0;
  sail(sea, tracker, 0.0, 180.0, [&](double t) {
    lost += tracker.take_lost().size();
    if (t < 60.0) before = tracker.tracks().size();
  });
  EXPECT_EQ(before, 2u) << "until then it may be a ship";
  const auto tracks = tracker.tracks();
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_LT(off_m(sea, tracks[0], sea.targets[2].way(180.0)), 60.0);
  EXPECT_LT(off_m(sea, tracks[1], cause(180.0)), 60.0);
  EXPECT_EQ(lost, 0u);
}

// Two ships cross at 10 degrees; while they are within 120 m they have one plot,
// between them.
TEST(Tracker, TwoThatMergeForMinutesPartWithTheirOwnNumbers) {
  const Way a = straight_way({-1500, 5000}, 85.0, 10.0),
            b = straight_way({-1500, 5260}, 95.0, 10.0);
  const auto is_merged = [=](double t) { return length_of(a(t) - b(t)) < 120.0; };
  const Way nowhere = [](double) { return PlanePoint{90'000, 0}; };
  MadeSea sea;
  sea.bearing_sigma_deg = 0.1;
  sea.targets = {{.way = [=](double t) { return is_merged(t) ? (a(t) + b(t)) * 0.5 : a(t); }},
                 {.way = [=](double t) { return is_merged(t) ? nowhere(t) : b(t); }}};
  Tracker tracker(kAll);
  std::uint32_t first = 0;
  int merged = 0;
  sail(sea, tracker, 0.0, 600.0, [&](double t) {
    const auto tracks = tracker.tracks();
    if (t < 60.0) return;
    ASSERT_EQ(tracks.size(), 2u) << t;
    merged += is_merged(t);
    if (first == 0) first = off_m(sea, tracks[0], a(t)) < off_m(sea, tracks[1], a(t)) ? 1 : 2;
    EXPECT_LT(off_m(sea, tracks[first - 1], a(t)), 100.0) << t;
    EXPECT_LT(off_m(sea, tracks[2 - first], b(t)), 100.0) << t;
  });
  EXPECT_GT(merged, 40) << "turns";
}

TEST(Tracker, RefusesPlacesThatAreNone) {
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 0, 60);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tracker.acquire({nan, 3.0}, 100.0), 0u);
  EXPECT_EQ(tracker.acquire({50.0, 1e300}, 100.0), 0u);
  EXPECT_EQ(tracker.acquire(sea.origin, nan), 0u);
}

TEST(Tracker, BeginsAnewWhenTheTimeOrOwnShipLeaps) {
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  Tracker tracker(kAll);
  sail(sea, tracker, 1000, 1060);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  sail(sea, tracker, 500, 560);
  EXPECT_EQ(tracker.counts().resets, 1u);
  EXPECT_EQ(tracker.take_lost().size(), 1u);
  EXPECT_EQ(tracker.tracks().size(), 1u);
  sail(sea, tracker, 5000, 5060);
  EXPECT_EQ(tracker.counts().resets, 2u);
  sea.origin = {51.0, 3.0};
  sail(sea, tracker, 5060, 5120);
  EXPECT_EQ(tracker.counts().resets, 3u);
  EXPECT_EQ(tracker.tracks().size(), 1u);
}

TEST(Tracker, StandsWhatIsNoPlot) {
  Tracker tracker(kAll);
  MadeSea sea;
  sea.targets = {{straight_way({2000, 2000}, 270, 12)}};
  sail(sea, tracker, 0, 30);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[] = {nan, std::numeric_limits<double>::infinity(), -1.0, 1e300};
  for (const double value : bad) {
    Plot plot;
    plot.own_ship = sea.origin;
    plot.range_m = value;
    tracker.add(plot);
    plot.range_m = 1000.0;
    plot.range_sigma_m = value;
    tracker.add(plot);
    plot.range_sigma_m = 10.0;
    plot.own_ship.latitude_deg = value == -1.0 ? 91.0 : value;
    tracker.add(plot);
    AntennaPass antenna;
    antenna.own_ship = plot.own_ship;
    tracker.pass(antenna);
  }
  sail(sea, tracker, 30, 60);
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].number, 1u);
}

TEST(Tracker, GivesTheSameBitsAgain) {
  MadeSea sea;
  sea.own = straight_way({0, 0}, 30, 10);
  sea.false_a_turn = 50;
  sea.targets = {{straight_way({3000, 3000}, 270, 12), 0.8}, {straight_way({-2000, 1000}, 45, 6)}};
  Tracker one(kAll), two(kAll);
  sail(sea, one, 0, 300);
  sail(sea, two, 0, 300);
  const auto a = one.tracks(), b = two.tracks();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].place, b[i].place);
    EXPECT_EQ(a[i].velocity_mps, b[i].velocity_mps);
  }
}

TEST(Tracker, RefusesRulesOutOfTheirRange) {
  EXPECT_THROW(Tracker({.most_tracks = 0}), std::invalid_argument);
  EXPECT_THROW(Tracker({.fastest_kn = 5}), std::invalid_argument);
  EXPECT_THROW(Tracker({.furthest_nm = std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

TEST(ClosestApproach, IsThatOfStraightWays) {
  PlottedTrack track;
  track.range_m = 8.0 * 1852.0;
  track.bearing = TrueBearing::from(degrees(0.0));
  track.relative_velocity_mps = {0.0, -20.0 * 1852.0 / 3600.0};
  EXPECT_NEAR(closest_approach(track).range_m, 0.0, 1e-6);
  EXPECT_NEAR(closest_approach(track).time_s, 24.0 * 60.0, 1e-6);
  // Own ship turns to 090 at 10 kn: 5.657 NM in 24 min (A.823's first scenario, as a trial).
  track.relative_velocity_mps = {-10.0 * 1852.0 / 3600.0, -10.0 * 1852.0 / 3600.0};
  EXPECT_NEAR(closest_approach(track).range_m / 1852.0, 5.657, 5e-4);
  EXPECT_NEAR(closest_approach(track).time_s, 24.0 * 60.0, 1e-6);
  track.relative_velocity_mps = {0.0, 5.0};
  EXPECT_LT(closest_approach(track).time_s, 0.0);
  track.relative_velocity_mps = {0.01, 0.01};
  EXPECT_FALSE(closest_approach(track).moves);
  EXPECT_EQ(closest_approach(track).range_m, track.range_m);
}

}  // namespace
}  // namespace skerry::server
