#include "server/traffic_logs/traffic_fragment.hpp"

#include <gtest/gtest.h>

#include <string>

#include "server/traffic_logs/ship_kind.hpp"
#include "server/world/scenario.hpp"
#include "server/world/traffic/traffic_class.hpp"
#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

LoggedShip logged_ship(std::uint32_t mmsi, int fixes, double begin_s = 0) {
  LoggedShip ship;
  ship.identity.mmsi = mmsi;
  LoggedPiece piece;
  for (int i = 0; i < fixes; ++i) {
    piece.fixes.push_back(
        log_fix(1000 * kLogBegin_s + static_cast<int>(1000 * begin_s) + 10'000 * i,
                {55.0 + 1e-4 * i, -11.1234567}));
  }
  piece.heard = static_cast<std::uint64_t>(fixes);
  piece.worst_m = mmsi % 10;
  ship.heard = piece.heard;
  ship.pieces = {piece};
  return ship;
}

scenario::Scenario parsed(const std::string& yaml) {
  return parse_scenario(
      "name: a\nown_ships: [{name: B, position: {lat: 55, lon: -11}, radars: [{}]}]\n" + yaml,
      "test.yaml");
}

TEST(TrafficFragment, IsWhatAScenarioReads) {
  LoggedShip ship = logged_ship(219'000'003, 4, 30.5);
  ship.identity.name = "A \"B\" \\ \x01 C: {d}";
  ship.identity.ship_type = 81;
  ship.identity.length_m = 140;
  ship.identity.beam_m = 20;
  ship.pieces[0].heading_deg = 0.0;
  LoggedShip boat = logged_ship(219'000'004, 2);
  boat.identity.class_b = true;
  boat.identity.length_m = 3;  // without a beam
  const auto made = traffic_fragment({ship, boat}, {}, {}, "AIS of x\ny");
  EXPECT_EQ(utc_text(made.begin), "2021-01-05T01:51:55Z");
  EXPECT_EQ(made.targets, 2u);
  EXPECT_EQ(made.waypoints, 4u);
  EXPECT_EQ(made.fixes, 6u);
  EXPECT_EQ(made.worst_m, 4.0);
  EXPECT_NEAR(made.length_min, 1.0083, 1e-3);
  const auto scenario = parsed(made.yaml);
  ASSERT_EQ(scenario.targets_size(), 2);
  const scenario::Target& first = scenario.targets(0);  // who appears first
  EXPECT_EQ(first.name(), "MMSI 219000004");
  EXPECT_EQ(first.ais_class(), scenario::class_b);
  EXPECT_EQ(first.ship_class(), "boat");
  EXPECT_EQ(first.length_m(), 7.0);
  const scenario::Target& target = scenario.targets(1);
  EXPECT_EQ(target.name(), "A \"B\" \\ ? C: {d}");
  EXPECT_EQ(target.mmsi(), 219'000'003u);
  EXPECT_EQ(target.ship_type(), scenario::tanker);
  EXPECT_EQ(target.ship_class(), "product_tanker");
  EXPECT_EQ(target.length_m(), 140.0);
  EXPECT_EQ(target.course_deg(), 360.0);
  EXPECT_TRUE(target.as_logged());
  EXPECT_NEAR(60.0 * target.start_min(), 30.5, 1e-3);
  EXPECT_NEAR(target.position().lon(), -11.1234567, 1e-9);
  ASSERT_EQ(target.waypoints_size(), 3);
  EXPECT_NEAR(60.0 * target.waypoints(2).arrive_min(), 60.5, 1e-3);
  EXPECT_NEAR(target.waypoints(2).lat(), 55.0003, 1e-9);
}

TEST(TrafficFragment, KeepsTheShipsThatAreHeardMost) {
  std::vector<LoggedShip> ships;
  for (int i = 0; i < 20; ++i) ships.push_back(logged_ship(219'000'000u + i, 2 + i));
  const auto made = traffic_fragment(ships, {}, {.most_targets = 5}, "x");
  EXPECT_EQ(made.ships, 5u);
  EXPECT_EQ(made.ships_beyond, 15u);
  EXPECT_NE(made.yaml.find("219000019"), std::string::npos);
  EXPECT_EQ(made.yaml.find("219000014,"), std::string::npos);
  const auto small = traffic_fragment(ships, {}, {.most_waypoints = 30}, "x");
  EXPECT_EQ(small.waypoints, 20u + 10u);
}

// The largest fragment that is made must be one that is read, beside the rest of a scenario.
TEST(TrafficFragment, TheLargestIsReadByAScenario) {
  std::vector<LoggedShip> ships;
  for (int i = 0; i < 1000; ++i) {
    ships.push_back(logged_ship(219'000'000u + i, i < 20 ? 880 : 2));
    ships.back().identity.name = "TWENTY CHARACTERS AA";
    ships.back().identity.length_m = 123.4;
    ships.back().identity.beam_m = 23.4;
    ships.back().identity.ship_type = 40;
    ships.back().identity.class_b = true;
  }
  const auto made = traffic_fragment(ships, {}, {.most_targets = 1000}, "x");
  RecordProperty("bytes", static_cast<int>(made.yaml.size()));
  RecordProperty("waypoints", static_cast<int>(made.waypoints));
  EXPECT_GT(made.waypoints, 14'000u);
  EXPECT_EQ(parsed(made.yaml).targets_size(), static_cast<int>(made.targets));
}

TEST(ShipKind, EveryTypeAndLengthHasAClassThatThereIs) {
  for (unsigned type = 0; type < 256; ++type) {
    for (const double length_m : {0.0, 5.0, 50.0, 150.0, 400.0}) {
      HeardIdentity ship{.mmsi = 1, .ship_type = type, .length_m = length_m};
      EXPECT_NE(find_traffic_class(traffic_class_of(ship)), nullptr) << type;
    }
    EXPECT_TRUE(scenario::ShipType_IsValid(ship_type_of(type)));
  }
  EXPECT_EQ(traffic_class_of({.ship_type = 70, .length_m = 85}), "coaster");
  EXPECT_EQ(traffic_class_of({.ship_type = 74, .length_m = 300}), "bulker");
  EXPECT_EQ(traffic_class_of({.ship_type = 80, .length_m = 330}), "vlcc");
  EXPECT_EQ(traffic_class_of({.ship_type = 60, .length_m = 290}), "cruise");
  EXPECT_EQ(traffic_class_of({.ship_type = 52, .length_m = 90}), "tug");
  EXPECT_EQ(traffic_class_of({}), "coaster");
  EXPECT_EQ(ship_type_of(89), scenario::tanker);
  EXPECT_EQ(ship_type_of(57), scenario::other_ship);
}

}  // namespace
}  // namespace skerry::server
