// Weather in time: what drifts, and what an instructor changes.
#include "server/world/environment.hpp"

#include <gtest/gtest.h>

#include "server/world/scenario.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {
namespace {

World world_with(const std::string& more) {
  return World(
      parse_scenario("name: s\nown_ships:\n  - name: F\n    position: {lat: 60, lon: 5}\n"
                     "    radars: [{}]\n" +
                         more + "\n",
                     "f"));
}

TEST(Environment, IsThatOfTheScenario) {
  const World world = world_with(
      "sea: {state: 3.5, wind_from_deg: 360, swell: {height_m: 2, period_s: 9, from_deg: 270}}\n"
      "atmosphere: {k_factor: 1.1, ducting: 0.25}\n"
      "rain: [{position: {lat: 60, lon: 5}, radius_nm: 1, rate_mm_h: 16}, {position: {lat: 60, "
      "lon: 5}, kind: squall_line}, {position: {lat: 60, lon: 5}, kind: even}]\n"
      "artefacts: {side_lobes: false}");
  const Environment& environment = *world.environment();
  EXPECT_EQ(environment.sea.state, 3.5);
  EXPECT_EQ(environment.sea.wind_from_deg, 0.0);
  EXPECT_EQ(environment.sea.swell.height_m, 2.0);
  EXPECT_EQ(environment.sea.swell.from_deg, 270.0);
  EXPECT_EQ(environment.atmosphere.k_factor, 1.1);
  EXPECT_EQ(environment.atmosphere.ducting, 0.25);
  ASSERT_EQ(environment.rain.size(), 3u);
  EXPECT_EQ(environment.rain[0].id, 1u);
  EXPECT_EQ(environment.rain[0].kind, echo::RainKind::cell);
  EXPECT_EQ(environment.rain[1].kind, echo::RainKind::squall_line);
  EXPECT_EQ(environment.rain[2].kind, echo::RainKind::even);
  EXPECT_EQ(environment.rain[0].radius_m, 1852.0);
  EXPECT_FALSE(environment.artefacts.side_lobes);
  EXPECT_TRUE(environment.artefacts.antenna_motion);
}

TEST(Environment, WithoutASectionIsCalmClearAndStandard) {
  const Environment environment = *world_with("").environment();
  EXPECT_EQ(environment.sea.state, 0.0);
  EXPECT_TRUE(environment.rain.empty());
  EXPECT_EQ(environment.atmosphere.k_factor, 4.0 / 3.0);
  EXPECT_EQ(environment.atmosphere.ducting, 0.0);
  EXPECT_EQ(environment.artefacts, echo::Artefacts{});
}

TEST(Environment, RainSartsAndSmallTargetsDriftAsTheirSpeedSays) {
  World world = world_with(
      "rain: [{position: {lat: 60, lon: 5}, drift_deg: 0, drift_kn: 60}]\n"
      "sarts: [{position: {lat: 60, lon: 5}, course_deg: 180, speed_kn: 6}]\n"
      "targets:\n"
      "  - {name: b, kind: buoy, position: {lat: 60, lon: 5}}\n"
      "  - {name: c, kind: small_craft, position: {lat: 60, lon: 5}, course_deg: 0, speed_kn: 36}");
  for (int tick = 0; tick < 600; ++tick) world.step();  // a minute
  const WorldState state = world.state();
  const double per_mile = 1.0 / 60.16;  // degrees of latitude, there, to a thousandth
  ASSERT_EQ(state.rain.size(), 1u);
  EXPECT_NEAR(state.rain[0].centre.latitude_deg, 60.0 + per_mile, 1e-4);
  ASSERT_EQ(state.sarts.size(), 1u);
  EXPECT_NEAR(state.sarts[0].position.latitude_deg, 60.0 - 0.1 * per_mile, 1e-5);
  ASSERT_EQ(state.adrift.size(), 1u) << "the buoy is moored";
  EXPECT_EQ(state.adrift[0].number, 1u);
  EXPECT_NEAR(state.adrift[0].position.latitude_deg, 60.0 + 0.6 * per_mile, 1e-4);
}

TEST(Environment, AChangeIsInForceFromTheNextTickOn) {
  Timeline timeline(world_with("sea: {state: 2}"));
  const ScenarioTime second{std::chrono::seconds(1)};
  EXPECT_EQ(timeline.at(second)->environment->sea.state, 2.0);
  Environment rough = *timeline.environment();
  rough.sea.state = 5.0;
  EXPECT_EQ(timeline.set_environment(rough), 11u);
  EXPECT_EQ(timeline.at(second)->environment->sea.state, 2.0) << "already made";
  EXPECT_EQ(timeline.at(second + World::kTick)->environment->sea.state, 5.0);
  EXPECT_EQ(timeline.environment()->sea.state, 5.0);
}

}  // namespace
}  // namespace skerry::server
