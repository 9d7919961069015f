// Ships and marks as AIS and tracking are told of them.
#include "server/app/traffic_list.hpp"

#include <gtest/gtest.h>

#include <set>

#include "server/world/dead_reckoning.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr const char* kScenario = R"(name: s
own_ships:
  - {name: Frida, position: {lat: 60, lon: 5}, course_deg: 90, speed_kn: -4, mmsi: 257111111,
     ship_type: cargo, radars: [{}]}
  - {name: Ymer, position: {lat: 60, lon: 6}, radars: [{}]}
targets:
  - {name: Tanker, position: {lat: 60.1, lon: 5}, course_deg: 0, speed_kn: 20, length_m: 180,
     beam_m: 30, ship_type: tanker, mmsi: 257000002}
  - {name: Green, position: {lat: 60.2, lon: 5}, kind: buoy, aid_type: starboard_hand_buoy}
  - {name: Skiff, position: {lat: 60.3, lon: 5}, kind: small_craft, course_deg: 180, speed_kn: 6}
  - {name: Coaster, position: {lat: 60.4, lon: 5}}
racons:
  - {name: Holmen, position: {lat: 60.5, lon: 5}, code: K}
)";

TEST(TrafficList, HasShipsBoatsMarksAndOwnShipsWhereTheyAreNow) {
  World world(parse_scenario(kScenario, "f"));
  for (int i = 0; i < 600; ++i) world.step();
  const WorldState state = world.state();
  const auto items = traffic_of(state, state.time + 50ms);
  ASSERT_EQ(items.size(), 7u);
  for (std::size_t i = 0; i < items.size(); ++i) EXPECT_EQ(items[i].number, i + 1);

  EXPECT_EQ(items[0].name, "Frida");
  EXPECT_EQ(items[0].mmsi, 257'111'111u);
  EXPECT_EQ(items[0].ship_type, 70);
  EXPECT_EQ(items[0].heading_deg, 90.0);
  EXPECT_EQ(items[0].course_over_ground_deg, 270.0) << "astern";
  EXPECT_DOUBLE_EQ(items[0].speed_mps, knots_in_mps(4.0));

  const TrafficItem& tanker = items[2];
  EXPECT_EQ(tanker.kind, TrafficKind::ship);
  EXPECT_EQ(tanker.ship_type, 80);
  EXPECT_EQ(tanker.length_m, 180.0);
  EXPECT_EQ(tanker.position, position_at(state.targets[0], 50ms).position);
  EXPECT_NEAR(tanker.position.latitude_deg, 60.1 + 20.0 / 3600.0, 2e-5);

  EXPECT_EQ(items[3].kind, TrafficKind::aid_to_navigation);
  EXPECT_EQ(items[3].aid_type, 25);
  EXPECT_EQ(items[3].speed_mps, 0.0);
  EXPECT_EQ(items[3].position, (GeoPoint{60.2, 5.0}));
  EXPECT_EQ(items[4].kind, TrafficKind::boat);
  EXPECT_NEAR(items[4].position.latitude_deg, 60.3 - 6.0 / 3600.0, 2e-5);
  EXPECT_EQ(items[5].name, "Coaster");
  EXPECT_EQ(items[6].kind, TrafficKind::aid_to_navigation);
  EXPECT_EQ(items[6].aid_type, 2);
}

TEST(TrafficList, EverybodyHasAnMmsiOfItsOwn) {
  const scenario::Scenario scenario = parse_scenario(kScenario, "f");
  const WorldState state = World(scenario).state();
  std::set<std::uint32_t> seen;
  for (const TrafficItem& item : traffic_of(state, state.time)) {
    EXPECT_GE(item.mmsi, 100'000'000u) << item.name;
    EXPECT_LE(item.mmsi, 999'999'999u) << item.name;
    EXPECT_EQ(item.mmsi / 10'000'000 == 99, item.kind == TrafficKind::aid_to_navigation)
        << item.name;
    EXPECT_TRUE(seen.insert(item.mmsi).second) << item.name;
  }
  EXPECT_EQ(scenario.targets(3).mmsi(), parse_scenario(kScenario, "f").targets(3).mmsi());
}

TEST(TrafficList, LeavesOutWhoIsRemovedAndAddsBehindAllOthers) {
  World world(parse_scenario(kScenario, "f"));
  wire::ExerciseOrder order;
  order.mutable_new_target()->set_name("Late");
  order.mutable_new_target()->set_latitude_deg(60.0);
  order.mutable_new_target()->set_longitude_deg(5.5);
  ASSERT_EQ(world.fault_of(order), std::nullopt);
  world.order(order, "test");
  order.mutable_target()->set_target(0);
  order.mutable_target()->set_removed(true);
  world.order(order, "test");
  world.step();
  const WorldState state = world.state();
  const auto items = traffic_of(state, state.time);
  ASSERT_EQ(items.size(), 7u) << "one more and one less";
  EXPECT_EQ(items[2].name, "Green");
  EXPECT_EQ(items[2].number, 4u) << "numbers stay";
  EXPECT_EQ(items[5].name, "Holmen");
  EXPECT_EQ(items[5].number, 7u);
  EXPECT_EQ(items[6].name, "Late");
  EXPECT_EQ(items[6].number, 8u);
}

TEST(TrafficList, HasWhatAFaultyAisSaysBesideTheTruth) {
  World world(parse_scenario(kScenario, "f"));
  wire::ExerciseOrder order;
  order.mutable_target()->set_target(0);
  order.mutable_target()->set_ais_heading_error_deg(15.0);
  order.mutable_target()->set_ais_position_error_m(300.0);
  world.order(order, "test");
  order.mutable_target()->Clear();
  order.mutable_target()->set_target(3);
  order.mutable_target()->set_ais_off(true);
  world.order(order, "test");
  world.step();
  const WorldState state = world.state();
  const auto items = traffic_of(state, state.time);
  const TrafficItem& tanker = items[2];
  EXPECT_EQ(tanker.heading_deg, 0.0);
  ASSERT_TRUE(tanker.ais.has_value());
  EXPECT_EQ(tanker.ais->heading_deg, 15.0);
  EXPECT_NEAR((tanker.ais->position->latitude_deg - tanker.position.latitude_deg) * 60.0 * 1852.0,
              300.0, 2.0);
  EXPECT_FALSE(tanker.ais->silent);
  ASSERT_TRUE(items[5].ais.has_value());
  EXPECT_TRUE(items[5].ais->silent);
}

}  // namespace
}  // namespace skerry::server
