// Each score against what was reckoned by hand.
#include "server/plotter/judge/track_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/plotter/judge/made_scene.hpp"

namespace skerry::server {
namespace {

// Of places on the plane, m.
constexpr double kClose = 0.01;

JudgeRule every_second() {
  JudgeRule rule;
  rule.step_s = 1.0;
  rule.hold_s = 0.5;
  return rule;
}

PlanePoint north_at_5(double t) { return {0.0, 5.0 * t}; }

// Own ship lies at the plane's anchor, so that the scene's plane is the test's.
Truth one_target(double until_s) {
  return {{made::target("a", 0, until_s, north_at_5)}, made::still(0, until_s)};
}

TEST(TrackScore, OfTheTruthItselfIsWithoutFault) {
  const Told told{"perfect", {made::track("1", 0, 100, north_at_5)}};
  const SceneScore score = track_score(one_target(100), told, every_second());
  ASSERT_EQ(score.steps.size(), 101u);
  EXPECT_NEAR(score.mean_ospa_m, 0.0, kClose);
  EXPECT_NEAR(score.mean_gospa_m, 0.0, kClose);
  EXPECT_EQ(score.tracked_share, 1.0);
  EXPECT_EQ(score.targets[0].continuity, 1.0);
  EXPECT_EQ(score.targets[0].initiation_s, 0.0);
  EXPECT_EQ(score.breaks + score.swaps + score.false_tracks + score.never_tracked, 0u);
  EXPECT_NEAR(score.hours, 100.0 / 3600.0, 1e-12);
}

TEST(TrackScore, ErrorsOfPlaceAreThoseOfTheTrack) {
  // 3-4-5 for 90 steps, 6-8-10 for the last 10.
  const Told told{"off", {made::track("1", 0, 99, [](double t) {
                    const double k = t < 89.5 ? 1.0 : 2.0;
                    return north_at_5(t) + PlanePoint{3.0, 4.0} * k;
                  })}};
  const SceneScore score = track_score(one_target(99), told, every_second());
  const TargetScore& target = score.targets[0];
  ASSERT_TRUE(target.place_rms_m && target.place_95_m);
  EXPECT_NEAR(*target.place_rms_m, std::sqrt((90.0 * 25.0 + 10.0 * 100.0) / 100.0), kClose);
  EXPECT_NEAR(*target.place_95_m, 10.0, kClose);
  EXPECT_NEAR(score.mean_ospa_m, 0.9 * 5.0 + 0.1 * 10.0, kClose);
}

TEST(TrackScore, PercentilesAreOfTheNearestRank) {
  std::vector<double> values;
  for (int i = 20; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(percentile_of(values, 95.0), 19.0);
  EXPECT_EQ(percentile_of({7.0}, 95.0), 7.0);
  EXPECT_EQ(percentile_of({}, 95.0), std::nullopt);
}

TEST(TrackScore, CountsFromWhenATargetWasThereToItsFirstTrack) {
  Told told{"late", {made::track("1", 0, 19, north_at_5, ToldStatus::tentative)}};
  const ToldTrack shown = made::track("1", 20, 100, north_at_5);
  told.tracks[0].points.insert(told.tracks[0].points.end(), shown.points.begin(),
                               shown.points.end());
  const SceneScore score = track_score(one_target(100), told, every_second());
  EXPECT_EQ(score.targets[0].initiation_s, 20.0);
  EXPECT_NEAR(score.targets[0].tracked_share, 81.0 / 101.0, 1e-12);
  EXPECT_EQ(score.targets[0].continuity, 1.0);
  EXPECT_NEAR(score.mean_missed, 20.0 / 101.0, 1e-12);
}

TEST(TrackScore, CountsFromWhenATargetWasSeenIfThatIsKnown) {
  Truth truth = one_target(100);
  for (int t = 0; t <= 100; ++t) truth.targets[0].looks.push_back({made::kBegin_s + t, t >= 30});
  const Told told{"", {made::track("1", 40, 100, north_at_5)}};
  const SceneScore score = track_score(truth, told, every_second());
  EXPECT_EQ(score.targets[0].steps, 71u);
  EXPECT_EQ(score.targets[0].initiation_s, 10.0);
}

TEST(TrackScore, CountsBreaksAndNumbers) {
  const Told told{"torn",
                  {made::track("1", 0, 40, north_at_5), made::track("2", 60, 100, north_at_5)}};
  const SceneScore score = track_score(one_target(100), told, every_second());
  const TargetScore& target = score.targets[0];
  EXPECT_EQ(target.breaks, 1u);
  EXPECT_EQ(target.numbers, 2u);
  EXPECT_EQ(target.swaps, 0u);
  EXPECT_NEAR(target.continuity, 82.0 / 101.0, 1e-12);
}

TEST(TrackScore, ATargetThatGoesAwayHasNoBreak) {
  const Truth truth{
      {made::target("a", 0, 50, north_at_5), made::target("b", 0, 100,
                                                          [](double) {
                                                            return PlanePoint{900.0, 0.0};
                                                          })},
      made::still(0, 100)};
  const Told told{"", {made::track("1", 0, 50, north_at_5)}};
  const SceneScore score = track_score(truth, told, every_second());
  EXPECT_EQ(score.targets[0].breaks, 0u);
  EXPECT_EQ(score.never_tracked, 1u);
}

TEST(TrackScore, ATargetThatComesBackHasNoBreak) {
  Truth truth = one_target(120);
  std::erase_if(truth.targets[0].points, [](const TruthPoint& point) {
    return point.utc_s > made::kBegin_s + 40.0 && point.utc_s < made::kBegin_s + 80.0;
  });
  const Told told{"", {made::track("1", 0, 40, north_at_5), made::track("2", 90, 120, north_at_5)}};
  EXPECT_EQ(track_score(truth, told, every_second()).breaks, 0u);
  EXPECT_EQ(track_score(one_target(120), told, every_second()).breaks, 1u);
}

// Two meet head on, 30 m apart, and their tracks go on with the other.
TEST(TrackScore, ATrackThatGoesOverToAnotherTargetIsASwap) {
  const auto a = [](double t) { return PlanePoint{0.0, 10.0 * (t - 50.0)}; };
  const auto b = [](double t) { return PlanePoint{30.0, -10.0 * (t - 50.0)}; };
  const Truth truth{{made::target("a", 0, 100, a), made::target("b", 0, 100, b)},
                    made::still(0, 100)};
  const auto bounced = [&](const auto& before, const auto& after) {
    return [&, before, after](double t) { return t < 50.0 ? before(t) : after(t); };
  };
  const Told swapped{
      "", {made::track("1", 0, 100, bounced(a, b)), made::track("2", 0, 100, bounced(b, a))}};
  const SceneScore bad = track_score(truth, swapped, every_second());
  EXPECT_EQ(bad.swaps, 2u);
  EXPECT_EQ(bad.tracks[0].targets, 2u);
  const Told right{"", {made::track("1", 0, 100, a), made::track("2", 0, 100, b)}};
  EXPECT_EQ(track_score(truth, right, every_second()).swaps, 0u);
}

// Two side by side, 20 m apart; for a while each track errs 12 m towards the other.
TEST(TrackScore, AnErrorOfPlaceIsNoSwap) {
  const auto a = [](double t) { return PlanePoint{0.0, 5.0 * t}; };
  const auto b = [](double t) { return PlanePoint{20.0, 5.0 * t}; };
  const Truth truth{{made::target("a", 0, 60, a), made::target("b", 0, 60, b)}, made::still(0, 60)};
  const auto errs = [](const auto& place, double east_m) {
    return [place, east_m](double t) {
      return place(t) + PlanePoint{t >= 20.0 && t < 40.0 ? east_m : 0.0, 0.0};
    };
  };
  const Told told{
      "", {made::track("1", 0, 60, errs(a, 12.0)), made::track("2", 0, 60, errs(b, -12.0))}};
  EXPECT_EQ(track_score(truth, told, every_second()).swaps, 0u);
  JudgeRule hasty = every_second();
  hasty.keep_m = 0.0;
  EXPECT_EQ(track_score(truth, told, hasty).swaps, 4u);  // both, there and back
}

TEST(TrackScore, FalseTracksGoByTheHourAndByTheirShare) {
  const auto slow = [](double t) { return PlanePoint{100.0, 0.1 * t}; };
  const auto nothing = [](double) { return PlanePoint{-5000.0, 0.0}; };
  const Truth truth{{made::target("a", 0, 3600, slow)}, made::still(0, 3600)};
  const Told told{"", {made::track("1", 0, 3600, slow), made::track("2", 0, 360, nothing)}};
  JudgeRule rule = every_second();
  rule.step_s = 10.0;
  const SceneScore score = track_score(truth, told, rule);
  EXPECT_EQ(score.false_tracks, 1u);
  ASSERT_TRUE(score.false_per_hour);
  EXPECT_NEAR(*score.false_per_hour, 1.0, 1e-9);
  EXPECT_NEAR(score.false_share, 37.0 / (361.0 + 37.0), 1e-12);
  EXPECT_NEAR(score.mean_made_up, 37.0 / 361.0, 1e-12);
}

TEST(TrackScore, ATrackThatWasATargetOnceIsNotFalse) {
  const Told told{"", {made::track("1", 0, 100, [](double t) {
                    return t < 0.5 ? PlanePoint{} : PlanePoint{-5000.0, 0.0};
                  })}};
  const SceneScore score = track_score(one_target(100), told, every_second());
  EXPECT_EQ(score.false_tracks, 0u);
  EXPECT_NEAR(score.false_share, 100.0 / 101.0, 1e-12);
}

TEST(TrackScore, StepsHaveWhatGospaIsMadeOf) {
  const auto at = [](double east, double north) {
    return [=](double) { return PlanePoint{east, north}; };
  };
  const Truth truth{{made::target("a", 0, 5, at(0, 100)), made::target("b", 0, 5, at(1000, 0))},
                    made::still(0, 5)};
  const Told told{"",
                  {made::track("1", 0, 5, at(30, 100)), made::track("2", 0, 5, at(5000, 0)),
                   made::track("3", 0, 5, at(0, 7000))}};
  const SceneScore score = track_score(truth, told, every_second());
  const StepScore& step = score.steps.at(2);
  EXPECT_NEAR(step.errors_part, 900.0, 1.0);
  EXPECT_NEAR(step.missed_part, 20'000.0, 1e-6);
  EXPECT_NEAR(step.made_up_part, 40'000.0, 1e-6);
  EXPECT_NEAR(step.gospa_m, std::sqrt(60'900.0), kClose);
  EXPECT_NEAR(step.ospa_m, std::sqrt((900.0 + 2.0 * 40'000.0) / 3.0), kClose);
  EXPECT_EQ(step.missed, 1u);
  EXPECT_EQ(step.made_up, 2u);
}

TEST(TrackScore, ErrorsOfCourseAndSpeedAreThoseOfTheToldMotion) {
  const auto north_10 = [](double t) { return PlanePoint{0.0, 10.0 * kKnot * t}; };
  const Truth truth{{made::target("a", 0, 100, north_10)}, made::still(0, 100)};
  Told told{"", {made::track("1", 0, 100, north_10)}};
  for (ToldPoint& point : told.tracks[0].points) {
    point.course_deg = 350.0;
    point.speed_kn = 12.0;
  }
  const SceneScore score = track_score(truth, told, every_second());
  ASSERT_TRUE(score.targets[0].course_95_deg && score.targets[0].speed_95_kn);
  EXPECT_NEAR(*score.targets[0].course_95_deg, 10.0, 0.01);
  EXPECT_NEAR(*score.targets[0].speed_95_kn, 2.0, 0.001);
  EXPECT_NEAR(*score.targets[0].errors[50].course_deg, -10.0, 0.01);
}

// One mile to the east of own ship, two to the south, going north with 10 kn: CPA 1 NM in 12 min.
TEST(TrackScore, ErrorsOfCpaAreAgainstBothGoingOnStraight) {
  const auto passing = [](double t) { return PlanePoint{1852.0, -3704.0 + 10.0 * kKnot * t}; };
  const Truth truth{{made::target("a", 0, 120, passing)}, made::still(0, 120)};
  Told told{"", {made::track("1", 0, 120, [&](double t) {
              return passing(t) + PlanePoint{100.0, 0.0};
            })}};
  for (ToldPoint& point : told.tracks[0].points) {
    point.course_deg = 0.0;
    point.speed_kn = 10.0;
  }
  SceneScore score = track_score(truth, told, every_second());
  const TrackError& moved = score.targets[0].errors.at(60);
  ASSERT_TRUE(moved.cpa_nm && moved.tcpa_min);
  EXPECT_NEAR(*moved.cpa_nm, 100.0 / 1852.0, 1e-3);
  EXPECT_NEAR(*moved.tcpa_min, 0.0, 0.02);
  // What it says itself comes before what its motion gives.
  for (ToldPoint& point : told.tracks[0].points) {
    point.cpa_nm = 0.9;
    point.tcpa_min = 10.0;
  }
  score = track_score(truth, told, every_second());
  const TrackError& said = score.targets[0].errors.at(60);
  EXPECT_NEAR(*said.cpa_nm, -0.1, 1e-3);
  EXPECT_NEAR(*said.tcpa_min, -1.0, 0.02);  // 11 min are left after one
  EXPECT_EQ(score.targets[0].forecasts, 121u);
  // Told 30 s before: it has run on since.
  std::erase_if(told.tracks[0].points,
                [](const ToldPoint& point) { return point.utc_s > made::kBegin_s + 30.0; });
  JudgeRule patient = every_second();
  patient.hold_s = 60.0;
  score = track_score(truth, told, patient);
  EXPECT_NEAR(*score.targets[0].errors.at(60).tcpa_min, -1.5, 0.02);  // 9.5 of 11 min
}

// Settled from when the track has been the same for so long.
TEST(TrackScore, AccuracyIsThatOfSettledTracks) {
  const auto north_10 = [](double t) { return PlanePoint{300.0, 10.0 * kKnot * t}; };
  const Truth truth{{made::target("a", 0, 400, north_10)}, made::still(0, 400)};
  Told told{"", {made::track("1", 0, 99, north_10), made::track("2", 100, 400, north_10)}};
  for (ToldTrack& track : told.tracks) {
    for (ToldPoint& point : track.points) {
      const double t = point.utc_s - made::kBegin_s;
      point.course_deg = t < 200.0 ? 10.0 : 4.0;
      point.speed_kn = 10.2;
    }
  }
  const TargetScore target = track_score(truth, told, every_second()).targets[0];
  // 60 .. 99 s and 160 .. 400 s; 280 .. 400 s.
  EXPECT_EQ(target.after_one_minute.steps, 40u + 241u);
  EXPECT_EQ(target.after_three_minutes.steps, 121u);
  ASSERT_TRUE(target.after_three_minutes.course_95_deg);
  EXPECT_NEAR(*target.after_one_minute.course_95_deg, 10.0, 0.01);
  EXPECT_NEAR(*target.after_three_minutes.course_95_deg, 4.0, 0.01);
  EXPECT_NEAR(*target.after_three_minutes.relative_speed_95_kn, 0.2, 0.001);
  // After one minute 11 deg are allowed; after three 3 deg of relative course are not kept.
  EXPECT_EQ(target.after_one_minute.exceeded, 0u);
  EXPECT_EQ(target.after_three_minutes.exceeded, 1u);
}

TEST(Accuracy, ASpeedMayErrByItsShareIfThatIsMore) {
  TrackError error;
  error.settled = Settled::three_minutes;
  error.relative_speed_kn = 0.9;
  error.true_relative_kn = 85.0;
  EXPECT_EQ(accuracy_after(std::vector{error}, Settled::one_minute, kAfterThreeMinutes).exceeded,
            1u);
  error.true_relative_kn = 95.0;
  EXPECT_EQ(accuracy_after(std::vector{error}, Settled::one_minute, kAfterThreeMinutes).exceeded,
            0u);
}

TEST(TrackScore, NoCpaIsJudgedOfWhoTurns) {
  const auto turning = [](double t) {
    return PlanePoint{1000.0 + 200.0 * std::cos(t * 0.05), 200.0 * std::sin(t * 0.05)};
  };
  const Truth truth{{made::target("a", 0, 120, turning)}, made::still(0, 120)};
  Told told{"", {made::track("1", 0, 120, turning)}};
  for (ToldPoint& point : told.tracks[0].points) point.cpa_nm = 0.1;
  const SceneScore score = track_score(truth, told, every_second());
  EXPECT_EQ(score.targets[0].forecasts, 0u);
  EXPECT_EQ(score.targets[0].tracked, 121u);
}

TEST(TrackScore, WhoIsSeenFiveTimesInTenMustKeepItsTrack) {
  const Told told{"", {made::track("1", 0, 19, north_at_5)}};
  const auto judged = [&](int every, int of) {
    Truth truth = one_target(39);
    for (int t = 0; t < 40; ++t)
      truth.targets[0].looks.push_back({made::kBegin_s + t, t % of < every});
    return *track_score(truth, told, every_second()).five_of_ten;
  };
  // Ten looks are there from the tenth step on: 31 steps, of which 11 with a track.
  EXPECT_EQ(judged(1, 2).due, 31u);
  EXPECT_EQ(judged(1, 2).kept, 11u);
  EXPECT_EQ(judged(4, 10).due, 0u);
  EXPECT_FALSE(track_score(one_target(39), told, every_second()).five_of_ten);
}

TEST(TrackScore, WhoIsOutOfRangeCountsNot) {
  Truth truth = one_target(50);
  truth.targets.push_back(made::target("far", 0, 50, [](double) { return PlanePoint{9e3, 0.0}; }));
  const Told told{"",
                  {made::track("1", 0, 50, north_at_5),
                   made::track("2", 0, 50,
                               [](double) {
                                 return PlanePoint{9e3, 20.0};
                               }),
                   made::track("3", 0, 50, [](double) {
                     return PlanePoint{0.0, 9e3};
                   })}};
  JudgeRule rule = every_second();
  EXPECT_GT(track_score(truth, told, rule).mean_made_up, 0.9);
  rule.within_m = 5000.0;
  const SceneScore score = track_score(truth, told, rule);
  EXPECT_NEAR(score.mean_ospa_m, 0.0, kClose);
  EXPECT_EQ(score.targets[1].steps, 0u);
  EXPECT_EQ(score.false_tracks + score.never_tracked, 0u);
}

TEST(TrackScore, WhoComesBackIntoRangeHasNoBreak) {
  const auto passing = [](double t) { return PlanePoint{0.0, 100.0 * t}; };
  const auto returning = [&](double t) { return passing(t < 50.0 ? t : 100.0 - t); };
  const Truth truth{{made::target("a", 0, 100, returning)}, made::still(0, 100)};
  const Told told{"", {made::track("1", 0, 40, returning), made::track("2", 75, 100, returning)}};
  JudgeRule rule = every_second();
  rule.within_m = 3000.0;
  const SceneScore score = track_score(truth, told, rule);
  EXPECT_EQ(score.targets[0].breaks, 0u);
  EXPECT_EQ(score.targets[0].numbers, 2u);
  EXPECT_EQ(track_score(truth, told, every_second()).targets[0].breaks, 1u);
}

TEST(TrackScore, StepsMayBeTheToldTimes) {
  JudgeRule rule = every_second();
  rule.step_s = 0.0;
  const Told told{"", {made::track("1", 10, 20, north_at_5)}};
  const SceneScore score = track_score(one_target(100), told, rule);
  EXPECT_EQ(score.steps.size(), 11u);
  EXPECT_EQ(score.first_s, made::kBegin_s + 10.0);
}

TEST(TrackScore, RefusesWhatItCannotJudge) {
  const Told told{"", {made::track("1", 0, 1, north_at_5)}};
  EXPECT_THROW(track_score({}, told, {}), std::invalid_argument);
  JudgeRule rule = every_second();
  rule.cut_m = 0.0;
  EXPECT_THROW(track_score(one_target(10), told, rule), std::invalid_argument);
  rule = every_second();
  rule.keep_m = rule.cut_m;
  EXPECT_THROW(track_score(one_target(10), told, rule), std::invalid_argument);
  rule = every_second();
  rule.step_s = 1e-6;
  EXPECT_THROW(track_score(one_target(10), told, rule), std::invalid_argument);
  Told crowd;
  for (std::size_t i = 0; i <= kMostShown; ++i)
    crowd.tracks.push_back(made::track(std::to_string(i), 0, 1, north_at_5));
  EXPECT_THROW(track_score(one_target(10), crowd, every_second()), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::server
