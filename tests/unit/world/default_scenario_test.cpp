// The scenario that the server starts with: whole, and afloat.
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <string>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/chart/land_mask.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

double distance_m(const GeoPoint& a, const GeoPoint& b) {
  double distance = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, distance);
  return distance;
}

TEST(DefaultScenario, HasTwoOwnShipsOneOfThemWithXAndSBandAndADozenTargets) {
  const scenario::Scenario bergen = default_scenario();
  ASSERT_EQ(bergen.own_ships_size(), 2);
  EXPECT_EQ(std::count_if(bergen.targets().begin(), bergen.targets().end(),
                          [](const auto& t) { return t.kind() == scenario::Target::ship; }),
            12);
  for (const scenario::OwnShip& ship : bergen.own_ships()) {
    ASSERT_GE(ship.radars_size(), 1);
    for (const scenario::Radar& radar : ship.radars()) {
      EXPECT_EQ(radar.spokes(), 4096u);
      EXPECT_EQ(radar.cells(), 1024u);
      EXPECT_EQ(radar.bits(), 8u);
    }
    EXPECT_EQ(radar_set(ship.radars(0)).rpm, 24.0);
    EXPECT_EQ(radar_set(ship.radars(0)).band(), echo::Band::x);
    EXPECT_GT(ship.speed_kn(), 5.0);
    EXPECT_GT(ship.position().lat(), 60.2);
    EXPECT_LT(ship.position().lat(), 60.6);
    EXPECT_GT(ship.position().lon(), 4.8);
    EXPECT_LT(ship.position().lon(), 5.3);
  }
  EXPECT_EQ(bergen.own_ships(0).radars(0).controls().range_nm(), 6.0);
  EXPECT_EQ(bergen.own_ships(1).radars(0).controls().range_nm(), 12.0);
  ASSERT_EQ(bergen.own_ships(1).radars_size(), 2);
  EXPECT_EQ(radar_set(bergen.own_ships(1).radars(1)).band(), echo::Band::s);
}

TEST(DefaultScenario, HasALightSeaSomeBuoysAndARacon) {
  const scenario::Scenario bergen = default_scenario();
  EXPECT_EQ(bergen.sea().state(), 2.0);
  EXPECT_EQ(bergen.rain_size(), 0);
  EXPECT_EQ(bergen.racons_size(), 1);
  EXPECT_GE(std::count_if(bergen.targets().begin(), bergen.targets().end(),
                          [](const auto& t) { return t.kind() != scenario::Target::ship; }),
            4);
}

TEST(DefaultScenario, IsTheFileItWasBuiltFrom) {
  const scenario::Scenario file =
      load_scenario(SKERRY_SOURCE_DIR "/server/world/scenarios/bergen.yaml");
  EXPECT_EQ(file.SerializeAsString(), default_scenario().SerializeAsString());
}

TEST(DefaultScenario, EveryTargetBeginsWithinSixMilesOfAnOwnShip) {
  const WorldState start = World(default_scenario()).state();
  for (const ShipState& target : start.targets) {
    double nearest = 1e9;
    for (const ShipState& own : start.own_ships) {
      nearest = std::min(nearest, distance_m(own.position, target.position));
    }
    EXPECT_LT(nearest, 6.0 * 1852.0) << target.name;
    EXPECT_GT(nearest, 200.0) << target.name;
  }
}

// Every five seconds, at the ship and at eight places around her.
TEST(DefaultScenario, EveryShipStaysClearOfLandForHalfAnHour) {
  std::filesystem::path file;
  try {
    file = echo::GshhgReader::find_finest();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "no chart: " << error.what();
  }
  const GeoPoint off_bergen{60.4, 4.9};
  const echo::CoastChart chart =
      echo::GshhgReader::open(file).load(off_bergen, nautical_miles(30.0));
  constexpr double kClearance = 150.0;  // metres
  const auto afloat = [&](const ShipState& ship, ScenarioTime time) {
    ASSERT_LT(distance_m(off_bergen, ship.position), 29.0 * 1852.0) << ship.name;
    for (int i = 0; i <= 8; ++i) {
      GeoPoint place = ship.position;
      if (i > 0) {
        GeographicLib::Geodesic::WGS84().Direct(ship.position.latitude_deg,
                                                ship.position.longitude_deg, 45.0 * i, kClearance,
                                                place.latitude_deg, place.longitude_deg);
      }
      ASSERT_FALSE(echo::is_land(chart, place))
          << ship.name << " is ashore or nearly so at " << ship.position.latitude_deg << " N "
          << ship.position.longitude_deg << " E after " << in_seconds(time.time_since_epoch())
          << " s";
    }
  };
  ASSERT_TRUE(echo::is_land(chart, {60.39, 5.33})) << "Bergen is on land";
  const scenario::Scenario bergen = default_scenario();
  for (const scenario::Target& target : bergen.targets()) {
    if (target.kind() == scenario::Target::ship) continue;
    EXPECT_FALSE(echo::is_land(chart, {target.position().lat(), target.position().lon()}))
        << target.name();
  }
  World world(bergen);
  for (int tick = 0; tick <= 18'000 && !HasFailure(); ++tick) {
    if (tick % 200 == 0) {  // 20 s: half a ship's clearance at 15 kn
      const WorldState state = world.state();
      for (const ShipState& ship : state.own_ships) afloat(ship, state.time);
      for (const ShipState& ship : state.targets) afloat(ship, state.time);
    }
    world.step();
  }
}

}  // namespace
}  // namespace skerry::server
