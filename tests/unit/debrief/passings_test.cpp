// How near ships came, against closed forms.
#include "server/debrief/passings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "protocol/quantity/angle.hpp"
#include "server/debrief/words.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;

ShipState ship(const std::string& name, double north_m, double east_m, double course, double kn) {
  ShipState state;
  state.name = name;
  state.position = advanced({50.0, 3.0}, {north_m, east_m});
  state.heading_deg = state.course_over_ground_deg = course;
  state.speed_mps = kn * kKnot;
  return state;
}

void sail(ShipState& state, double seconds) {
  const double course = degrees(state.course_over_ground_deg).in_radians();
  state.position = advanced(state.position, {seconds * state.speed_mps * std::cos(course),
                                             seconds * state.speed_mps * std::sin(course)});
}

// Both sail on for that long, looked at every `step_s`.
std::vector<ShipPassing> passed(ShipState own, ShipState other, double length_s, double step_s,
                                const DebriefLimits& limits = {}) {
  Passings passings(limits);
  for (double at = 0.0; at <= length_s; at += step_s) {
    WorldState state;
    state.own_ships = {own};
    state.targets = {other};
    passings.look(state, {at, at});
    sail(own, step_s);
    sail(other, step_s);
  }
  return passings.nearest();
}

TEST(Passings, OfACrossingIsThatOfTheClosedForm) {
  // She comes from starboard and passes astern: 200 m.
  const auto all = passed(ship("Own", 0, 0, 0, 10), ship("Other", 2000, 2200, 270, 10), 900.0, 1.0);
  ASSERT_EQ(all.size(), 1u);
  const ShipPassing& passing = all[0];
  // Seen from the own ship she moves west and south at 10 kn each.
  // 2 km of a plane bend that much.
  EXPECT_NEAR(passing.closest_m, 200.0 / std::sqrt(2.0), 0.5);
  EXPECT_NEAR(passing.when.at_s, 2100.0 / (10.0 * kKnot), 0.1);
  EXPECT_NEAR(passing.bearing_deg, 135.0, 0.2);
  EXPECT_NEAR(passing.own_side_deg, 135.0, 0.2);
  EXPECT_NEAR(passing.other_side_deg, 45.0, 0.2);
  EXPECT_EQ(side_text(passing), "starboard to starboard");
  ASSERT_TRUE(passing.first_under);
  EXPECT_NEAR(passing.first_under->at_s, 0.0, 1e-9) << "its CPA is small from the begin";
  EXPECT_NEAR(passing.least_forecast_m, 200.0 / std::sqrt(2.0), 0.5);
}

TEST(Passings, DoNotDependOnHowOftenTheyAreLookedAt) {
  const ShipState own = ship("Own", 0, 0, 20, 18), other = ship("Other", 4000, 300, 190, 22);
  const auto often = passed(own, other, 600.0, 0.1), seldom = passed(own, other, 600.0, 7.0);
  ASSERT_EQ(often.size(), 1u);
  ASSERT_EQ(seldom.size(), 1u);
  EXPECT_NEAR(often[0].closest_m, seldom[0].closest_m, 0.1);
  EXPECT_NEAR(often[0].when.at_s, seldom[0].when.at_s, 0.1);
}

TEST(Passings, ForecastsAreThoseOfStraightWays) {
  std::mt19937 random(4);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  double worst_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    const ShipState a = ship("A", 0, 0, between(0, 360), between(1, 25));
    const ShipState b =
        ship("B", between(-9000, 9000), between(-9000, 9000), between(0, 360), between(1, 25));
    const ForecastCpa forecast = forecast_cpa(a, b);
    if (forecast.after_s < 0.0 || forecast.after_s > 3000.0) continue;
    ShipState a_then = a, b_then = b;
    sail(a_then, forecast.after_s);
    sail(b_then, forecast.after_s);
    const ShortWay way = short_way_between(a_then.position, b_then.position);
    worst_m = std::max(worst_m, std::fabs(std::hypot(way.north_m, way.east_m) - forecast.range_m));
  }
  std::printf("forecast against sailing on: at most %.2f m apart\n", worst_m);
  EXPECT_LT(worst_m, 60.0) << "the parallels of places 30 km apart";
}

TEST(Passings, CountTheTimeUnderTheLimit) {
  DebriefLimits limits;
  limits.cpa_nm = 0.5;
  limits.tcpa_min = 5.0;
  // Head on at 20 kn together from 6 NM: under the limit from 5 min before they meet until after.
  const auto all =
      passed(ship("Own", 0, 0, 0, 10), ship("Other", 6 * 1852, 50, 180, 10), 1500.0, 1.0, limits);
  ASSERT_EQ(all.size(), 1u);
  const double meet_s = 6.0 * 180.0, leave_s = meet_s + 0.5 * 180.0;
  ASSERT_TRUE(all[0].first_under);
  EXPECT_NEAR(all[0].first_under->at_s, meet_s - 300.0, 1.5);
  EXPECT_NEAR(all[0].under_limit_s, leave_s - (meet_s - 300.0), 2.5);
  EXPECT_EQ(side_text(all[0]), "starboard to starboard");
}

TEST(Passings, LeaveOutWhoStayedFarAndWaysThatNobodySailed) {
  EXPECT_TRUE(passed(ship("Own", 0, 0, 0, 10), ship("Other", 0, 9000, 0, 10), 600.0, 1.0).empty());
  // Put from 4 NM on one side to 4 NM on the other: she passed nobody.
  Passings passings({});
  WorldState state;
  state.own_ships = {ship("Own", 0, 0, 0, 0)};
  state.targets = {ship("Other", 0, -4 * 1852, 0, 0)};
  passings.look(state, {0.0, 0.0});
  state.targets = {ship("Other", 0, 4 * 1852, 0, 0)};
  passings.look(state, {1.0, 1.0});
  EXPECT_TRUE(passings.nearest().empty());
}

}  // namespace
}  // namespace skerry::server
