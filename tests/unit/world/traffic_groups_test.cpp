#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "echo/kernel/hash.hpp"
#include "tests/unit/world/refusal.hpp"
#include "tests/unit/world/traffic_kit.hpp"

namespace skerry::server {
namespace {

const std::string kGroups =
    "traffic:\n"
    "  - {name: North, kind: lane, count: 180, from: {lat: 57.5, lon: 2}, via: [{lat: 58, lon: "
    "2.2}],\n     to: {lat: 58.5, lon: 2}, width_nm: 3, gives_way: early}\n"
    "  - {name: East, kind: lane, count: 170, from: {lat: 58, lon: 1.2}, to: {lat: 58, lon: 3},\n"
    "     width_nm: 3, gives_way: early}\n"
    "  - {name: Road, kind: anchorage, count: 40, from: {lat: 58.2, lon: 1.5}, radius_nm: 4}\n"
    "  - {name: Bank, kind: fishing, count: 60, from: {lat: 57.8, lon: 2.6}, radius_nm: 8,\n"
    "     gives_way: late}\n"
    "  - {name: Ferry, kind: crossing, count: 50, from: {lat: 58.1, lon: 1.8}, to: {lat: 58.1, "
    "lon: 2.5},\n     gives_way: early}\n";

bool are_equal(const std::vector<ShipState>& a, const std::vector<ShipState>& b) {
  if (a.size() != b.size()) return false;
  const auto same = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].number != b[i].number || !same(a[i].heading_deg, b[i].heading_deg) ||
        !same(a[i].position.latitude_deg, b[i].position.latitude_deg) ||
        !same(a[i].position.longitude_deg, b[i].position.longitude_deg) ||
        !same(a[i].speed_mps, b[i].speed_mps) ||
        !same(a[i].rate_of_turn_deg_s, b[i].rate_of_turn_deg_s)) {
      return false;
    }
  }
  return true;
}

TEST(TrafficGroups, TheSameSeedMakesTheSameShips) {
  const scenario::Scenario one = traffic_scene(kGroups), two = traffic_scene(kGroups);
  ASSERT_EQ(one.targets_size(), 500);
  EXPECT_EQ(one.SerializeAsString(), two.SerializeAsString());
  EXPECT_EQ(one.targets(0).name(), "North 1");
  EXPECT_EQ(one.targets(499).name(), "Ferry 50");
  scenario::Scenario other = parse_scenario(
      "name: x\nseed: 8\nown_ships: [{name: F, position: {lat: 58, lon: 1}, radars: [{}]}]\n" +
          kGroups,
      "test.yaml");
  int alike = 0;
  for (int i = 0; i < 500; ++i) {
    if (one.targets(i).position().lat() == other.targets(i).position().lat()) ++alike;
  }
  EXPECT_LT(alike, 5);
  for (const scenario::Target& target : one.targets()) EXPECT_NE(target.mmsi(), 0u);
}

TEST(TrafficGroups, LieWhereTheyAreToldTo) {
  const TrafficRun run(kGroups);
  for (const ShipState& ship : run.traffic.states(run.now)) {
    if (ship.number >= 350 && ship.number < 390) {
      EXPECT_LT(metres_apart(ship.position, {58.2, 1.5}), 4.0 * 1852.0 + 130.0);
    } else if (ship.number >= 390 && ship.number < 450) {
      EXPECT_LT(metres_apart(ship.position, {57.8, 2.6}), 8.0 * 1852.0);
    } else if (ship.number >= 180 && ship.number < 350) {
      EXPECT_LT(std::fabs(short_way_between({58.0, 2.0}, ship.position).north_m),
                1.5 * 1852.0 + 200.0);
    }
  }
}

TEST(TrafficGroups, FiveHundredShipsAreEqualBitForBit) {
  TrafficRun first(kGroups), second(kGroups);
  wire::TargetChange order;
  order.set_target(17);
  order.set_course_deg(33.0);
  order.set_speed_kn(5.0);
  const auto begin = std::chrono::steady_clock::now();
  first.step_to(90.0);
  first.traffic.order(order, first.now);
  first.step_to(180.0);
  TrafficRun copy(first);
  const std::vector<ShipState> half = first.traffic.states(first.now);
  first.step_to(360.0);
  const double took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("500 ships: %.3f ms a step\n", took_s * 1000.0 / 3'600.0);
  copy.step_to(360.0);
  second.step_to(90.0);
  second.traffic.order(order, second.now);
  second.step_to(180.0);
  EXPECT_TRUE(are_equal(half, second.traffic.states(second.now)));
  const std::vector<ShipState> states = first.traffic.states(first.now);
  EXPECT_TRUE(are_equal(states, copy.traffic.states(copy.now)));
  EXPECT_EQ(states.size(), 500u);
  for (const ShipState& ship : states) {
    ASSERT_TRUE(std::isfinite(ship.position.latitude_deg));
    ASSERT_TRUE(std::isfinite(ship.position.longitude_deg));
    ASSERT_TRUE(ship.heading_deg >= 0.0 && ship.heading_deg < 360.0);
    ASSERT_TRUE(std::isfinite(ship.speed_mps) && std::isfinite(ship.rate_of_turn_deg_s));
    ASSERT_LT(ship.speed_mps, knots_in_mps(60.0));
  }
}

TEST(TrafficGroups, TheSameBitsOnEveryMachine) {
  TrafficRun run(kGroups);
  run.step_to(300.0);
  std::uint64_t hash = 0;
  for (const ShipState& ship : run.traffic.states(run.now)) {
    for (const double value : {ship.position.latitude_deg, ship.position.longitude_deg,
                               ship.heading_deg, ship.speed_mps, ship.rate_of_turn_deg_s}) {
      hash = echo::mixed(hash, std::bit_cast<std::uint64_t>(value));
    }
  }
  EXPECT_EQ(hash, 13548579378300516295ull);
}

const std::string kHead =
    "name: x\nown_ships: [{name: F, position: {lat: 58, lon: 1}, radars: [{}]}]\n";

std::string target_refusal(const std::string& keys) {
  const std::string text =
      refusal(kHead + "targets: [{name: A, position: {lat: 58, lon: 2}, " + keys + "}]\n");
  const auto at = text.find("targets");
  return at == std::string::npos ? text : text.substr(at);
}

TEST(TrafficKeys, AreRefusedWhereTheyContradict) {
  EXPECT_EQ(target_refusal("ship_class: coaster"), "");
  EXPECT_NE(target_refusal("ship_class: coster").find("did you mean \"coaster\"?"),
            std::string::npos);
  EXPECT_EQ(target_refusal("kind: buoy, ship_class: tug"),
            "targets[0].ship_class: given for kind buoy; allowed: for ships");
  EXPECT_EQ(target_refusal("ship_class: coaster, speed_kn: 20"),
            "targets[0].speed_kn: 20 kn for a coaster; allowed: up to 14 kn");
  EXPECT_EQ(target_refusal("anchored: true, speed_kn: 3"),
            "targets[0].speed_kn: given besides anchored; allowed: one of the two");
  EXPECT_EQ(target_refusal("follows: F"), "");
  EXPECT_EQ(target_refusal("follows: A"),
            "targets[0].follows: she would follow herself in the end; allowed: no circle of "
            "followers");
  EXPECT_NE(target_refusal("follows: G").find("there is no ship \"G\""), std::string::npos);
  EXPECT_EQ(target_refusal("fishes_within_nm: 2, waypoints: [{lat: 59, lon: 2}], speed_kn: 3"),
            "targets[0].waypoints: given besides fishes_within_nm; allowed: one of the two");
  EXPECT_EQ(target_refusal("ship_class: coaster, waypoints: [{lat: 59, lon: 2, arrive_min: 60}]"),
            "targets[0].waypoints[0].arrive_min: she would need 60.1 kn to be there at 60 min; "
            "allowed: up to 14.0 kn");
  EXPECT_EQ(target_refusal("ship_class: coaster, waypoints: [{lat: 58.1, lon: 2, arrive_min: 60}, "
                           "{lat: 58.2, lon: 2, arrive_min: 50}]"),
            "targets[0].waypoints[1].arrive_min: 50 min; allowed: later than 60.0 min, when she "
            "leaves for it");
  EXPECT_EQ(target_refusal("route_end: back, speed_kn: 4"),
            "targets[0].route_end: given without waypoints; allowed: with them");
}

TEST(TrafficKeys, SizesAreThoseOfTheClass) {
  const scenario::Scenario scene = traffic_scene(
      "targets: [{name: A, ship_class: ferry, position: {lat: 60, lon: 5}, beam_m: 17}]\n");
  const scenario::Target& ferry = scene.targets(0);
  EXPECT_EQ(ferry.length_m(), 120.0);
  EXPECT_EQ(ferry.beam_m(), 17.0);
  EXPECT_EQ(ferry.speed_kn(), 18.0);
  EXPECT_EQ(ferry.ship_type(), scenario::passenger);
  EXPECT_TRUE(ferry.wake());
}

TEST(TrafficKeys, GroupsAreRefusedWhereTheyContradict) {
  const std::string group = "traffic: [{name: G, count: 10, from: {lat: 58, lon: 2}, ";
  EXPECT_NE(refusal(kHead + group + "kind: lane}]\n").find("a lane without `to`"),
            std::string::npos);
  EXPECT_NE(refusal(kHead + group + "kind: anchorage, ship_classes: [tankr]}]\n")
                .find("did you mean \"tanker\"?"),
            std::string::npos);
  const std::string many = "{name: G, count: 500, kind: fishing, from: {lat: 58, lon: 2}}";
  EXPECT_EQ(refusal(kHead + "traffic: [" + many + ", " + many + "]\n"), "");
  EXPECT_NE(refusal(kHead + "traffic: [" + many + ", " + many + ", " + many + "]\n")
                .find("1500 ships with those among the targets; allowed: at most 1000"),
            std::string::npos);
}

}  // namespace
}  // namespace skerry::server
