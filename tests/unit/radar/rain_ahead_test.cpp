// The map that is made ahead is the one that a radar then asks for.
#include "server/radar/rain_ahead.hpp"

#include <gtest/gtest.h>

#include "echo/scene/scene.hpp"
#include "server/radar/scene_drift.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

constexpr double kReach_m = 50e3;

TEST(RainAhead, MakesTheMapsThatRadarsAskForThen) {
  const scenario::Scenario scenario = parse_scenario(R"(
name: Rain
seed: 77
own_ships: [{name: Alfa, position: {lat: 50, lon: 3}, radars: [{}]}]
rain:
  - {position: {lat: 50.1, lon: 3}, radius_nm: 3, kind: cell}
  - {position: {lat: 50, lon: 3.1}, radius_nm: 1, kind: shower}
  - {position: {lat: 49.9, lon: 3}, radius_nm: 2, kind: even}
  - {position: {lat: -30, lon: 100}, radius_nm: 2, kind: squall_line}
)",
                                                     "rain.yaml");
  Timeline timeline{World(scenario)};
  const ScenarioTime now{std::chrono::seconds(40)};
  const WorldStatePtr state = timeline.at(now);
  const std::vector<echo::RainMapPtr> made = RainAhead::make(*state, scenario.seed(), now);
  ASSERT_EQ(made.size(), 2u) << "an even area has no map, and nobody sees the one far away";

  const echo::LocalPlane plane(state->own_ships[0].position);
  echo::Scene scene;
  lay_weather(*state, plane, kReach_m, scenario.seed(), scene);
  ASSERT_EQ(scene.rain.size(), 3u);
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double then = in_seconds((now + RainAhead::kLead).time_since_epoch());
    EXPECT_EQ(made[i], echo::rain_map_for(echo::rain_map_key(scene.rain[i], then))) << "area " << i;
  }
}

TEST(RainAhead, IsAheadByLessThanTheShortestStep) {
  EXPECT_LT(std::chrono::duration<double>(RainAhead::kLead).count(), echo::rain_step(0.0));
  EXPECT_GT(RainAhead::kLead, 2 * RainAhead::kPause);
}

TEST(RainAhead, EndsWhenItIsToldTo) {
  Timeline timeline{World(default_scenario())};
  RainAhead ahead(timeline, 1, [] { return ScenarioTime{}; });
  ahead.start();
  ahead.stop();
}

}  // namespace
}  // namespace skerry::server
