// Places between points, and forecasts of passing.
#include "server/plotter/judge/place_series.hpp"

#include <gtest/gtest.h>

#include "protocol/quantity/length.hpp"
#include "protocol/quantity/speed.hpp"
#include "tests/unit/plotter/judge/made_scene.hpp"

namespace skerry::server {
namespace {

constexpr double kClose_m = 0.01;

TruthPoint at(double t, double east_m, double north_m) {
  return {made::kBegin_s + t, made::plane().to_geo({east_m, north_m}), {}, {}};
}

TEST(TruthSeries, GoesStraightBetweenPointsAndNoFurther) {
  const TruthSeries series(std::vector{at(20, 0, 200), at(0, 0, 0), at(10, 100, 0), at(80, 0, 0)},
                           made::plane());
  const auto middle = series.at(made::kBegin_s + 5.0);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->place.east_m, 50.0, kClose_m);
  EXPECT_NEAR(middle->velocity_mps.east_m, 10.0, kClose_m);
  EXPECT_FALSE(series.at(made::kBegin_s + 50.0));  // a minute without a point
  EXPECT_TRUE(series.at(made::kBegin_s - 0.4));
  EXPECT_FALSE(series.at(made::kBegin_s - 0.6));
  EXPECT_TRUE(series.at(made::kBegin_s + 80.4));
  EXPECT_FALSE(series.at(made::kBegin_s + 80.6));
}

TEST(TruthSeries, TakesMotionThatIsToldBeforeThatOfPlaces) {
  std::vector<TruthPoint> points{at(0, 0, 0), at(10, 100, 0)};
  for (TruthPoint& point : points) {
    point.course_deg = 90.0;
    point.speed_kn = 3.0;
  }
  const auto state = TruthSeries(points, made::plane()).at(made::kBegin_s + 5.0);
  ASSERT_TRUE(state);
  EXPECT_NEAR(state->velocity_mps.east_m, 3.0 * kKnot, 1e-9);
}

TEST(TruthSeries, IsSteadyUntilItTurns) {
  const auto target = made::target("a", 0, 120, [](double t) {
    return t < 60.0 ? PlanePoint{0.0, 5.0 * t} : PlanePoint{5.0 * (t - 60.0), 300.0};
  });
  const TruthSeries series(target.points, made::plane());
  EXPECT_TRUE(series.is_steady(made::kBegin_s + 20.0, 30.0));
  EXPECT_FALSE(series.is_steady(made::kBegin_s + 40.0, 30.0));
  EXPECT_TRUE(series.is_steady(made::kBegin_s + 100.0, 30.0));
}

TEST(ToldSeries, IsShownFromWhenItWasToldAndForSoLong) {
  ToldTrack track = made::track("1", 10, 10, [](double) { return PlanePoint{}; });
  track.points[0].course_deg = 90.0;
  track.points[0].speed_kn = 10.0;
  const ToldSeries series(track.points, made::plane());
  EXPECT_FALSE(series.at(made::kBegin_s + 9.9, 5.0));
  const auto later = series.at(made::kBegin_s + 14.0, 5.0);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->state.place.east_m, 40.0 * kKnot, kClose_m);
  EXPECT_FALSE(series.at(made::kBegin_s + 15.1, 5.0));
}

TEST(ToldSeries, EndsWhenItIsLost) {
  ToldTrack track = made::track("1", 0, 5, [](double) { return PlanePoint{}; });
  track.points.back().status = ToldStatus::lost;
  const ToldSeries series(track.points, made::plane());
  EXPECT_TRUE(series.at(made::kBegin_s + 4.5, 5.0));
  EXPECT_FALSE(series.at(made::kBegin_s + 5.5, 5.0));
}

// IEC 62388 / 33 CFR 164 scenarios 1 and 2: relative motion of 20 and 10 kn.
TEST(PassingForecast, HasTheClosestApproachOfTheStandardScenarios) {
  const double mile = nautical_miles(1.0).in_metres();
  const auto first = forecast_passing({0.0, 8.0 * mile}, velocity_of(180.0, 20.0));
  EXPECT_NEAR(first.range_m, 0.0, 1e-6);
  EXPECT_NEAR(*first.time_s, 24.0 * 60.0, 1e-6);
  const auto second = forecast_passing({0.0, mile}, velocity_of(90.0, 10.0));
  EXPECT_NEAR(second.range_m, mile, 1e-6);
  EXPECT_NEAR(*second.time_s, 0.0, 1e-6);
  const auto still = forecast_passing({3.0, 4.0}, {0.01, 0.0});
  EXPECT_EQ(still.range_m, 5.0);
  EXPECT_FALSE(still.time_s);
}

TEST(Courses, AreComparedTheShortWay) {
  EXPECT_DOUBLE_EQ(turn_between(350.0, 10.0), -20.0);
  EXPECT_DOUBLE_EQ(turn_between(10.0, 350.0), 20.0);
  EXPECT_DOUBLE_EQ(course_of({-1.0, 0.0}), 270.0);
}

}  // namespace
}  // namespace skerry::server
