#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdio>

#include "server/world/dead_reckoning.hpp"
#include "server/world/target_track.hpp"
#include "server/world/traffic/traffic_class.hpp"
#include "tests/unit/world/traffic_kit.hpp"

namespace skerry::server {
namespace {

wire::TargetChange order_to(std::uint32_t ship) {
  wire::TargetChange change;
  change.set_target(ship);
  return change;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_motion(const ShipState& a, const ShipState& b) {
  return same_bits(a.position.latitude_deg, b.position.latitude_deg) &&
         same_bits(a.position.longitude_deg, b.position.longitude_deg) &&
         same_bits(a.heading_deg, b.heading_deg) &&
         same_bits(a.course_over_ground_deg, b.course_over_ground_deg) &&
         same_bits(a.speed_mps, b.speed_mps) &&
         same_bits(a.rate_of_turn_deg_s, b.rate_of_turn_deg_s);
}

TEST(TrafficShip, WithoutNewKeysIsATargetTrackBitForBit) {
  TrafficRun run(
      "targets:\n"
      "  - {name: A, position: {lat: 60, lon: 5}, course_deg: 47, speed_kn: 11}\n"
      "  - {name: B, position: {lat: 60, lon: 5.1}, speed_kn: 17, wake: true,\n"
      "     waypoints: [{lat: 60.02, lon: 5.1}, {lat: 60.02, lon: 5.2}]}\n"
      "  - {name: C, position: {lat: 60, lon: 5.2}}\n");
  const scenario::Scenario scene = traffic_scene(
      "targets:\n"
      "  - {name: A, position: {lat: 60, lon: 5}, course_deg: 47, speed_kn: 11}\n"
      "  - {name: B, position: {lat: 60, lon: 5.1}, speed_kn: 17, wake: true,\n"
      "     waypoints: [{lat: 60.02, lon: 5.1}, {lat: 60.02, lon: 5.2}]}\n"
      "  - {name: C, position: {lat: 60, lon: 5.2}}\n");
  // Orders that are not about her way leave it alone.
  wire::TargetChange silent = order_to(0);
  silent.set_ais_off(true);
  silent.set_sart(true);
  run.traffic.order(silent, run.now);
  for (int tick = 0; tick < 12'000; ++tick) {
    for (int i = 0; i < 3; ++i) {
      const ShipState now = run.ship(static_cast<std::size_t>(i));
      const ShipState was = TargetTrack(scene.targets(i)).at(run.now);
      ASSERT_TRUE(same_motion(now, was)) << i << ' ' << tick;
      ASSERT_EQ(now.mmsi, was.mmsi);
      ASSERT_EQ(now.wake, was.wake);
      if (tick % 100 != 0) break;  // A at each tick, the others now and then
    }
    run.step();
  }
  EXPECT_TRUE(run.ship(0).ais_off);
  EXPECT_TRUE(run.ship(0).sart);
  EXPECT_FALSE(run.ship(1).ais_off);
}

TEST(TrafficShip, EachTickLeadsToTheNext) {
  TrafficRun run(
      "sea: {state: 4, wind_from_deg: 200, current_kn: 1, current_set_deg: 80}\n"
      "targets:\n"
      "  - {name: A, ship_class: coaster, position: {lat: 60, lon: 5}, route_end: round,\n"
      "     waypoints: [{lat: 60.02, lon: 5}, {lat: 60.02, lon: 5.05}, {lat: 60, lon: 5.05}]}\n"
      "  - {name: B, ship_class: bulker, position: {lat: 60.1, lon: 5}, anchored: true}\n"
      "  - {name: C, ship_class: fishing, position: {lat: 60.2, lon: 5}, fishes_within_nm: 1}\n"
      "  - {name: D, ship_class: tug, position: {lat: 60, lon: 5.01}, follows: A}\n");
  std::vector<ShipState> before = run.traffic.states(run.now);
  for (int tick = 0; tick < 30'000; ++tick) {
    run.step();
    const std::vector<ShipState> now = run.traffic.states(run.now);
    ASSERT_EQ(now.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const ShipPlace there = position_at(before[i], kTrafficTick);
      ASSERT_TRUE(same_bits(there.position.latitude_deg, now[i].position.latitude_deg));
      ASSERT_TRUE(same_bits(there.position.longitude_deg, now[i].position.longitude_deg));
      ASSERT_LT(off_deg(there.heading_deg, now[i].heading_deg), 1e-8) << i << ' ' << tick;
    }
    before = now;
  }
}

TEST(TrafficShip, EveryClassTurnsWithinHerLimits) {
  for (const TrafficClass& c : traffic_classes()) {
    TrafficRun run("targets: [{name: A, position: {lat: 60, lon: 5}, course_deg: 10, ship_class: " +
                   std::string(c.key) + "}]\n");
    wire::TargetChange turn = order_to(0);
    turn.set_course_deg(150.0);
    ASSERT_FALSE(run.traffic.fault_of(turn));
    run.traffic.order(turn, run.now);
    double fastest = 0.0, past = 0.0;
    for (int tick = 0; tick < 9000; ++tick) {
      run.step();
      const ShipState ship = run.ship(0);
      fastest = std::max(fastest, std::fabs(ship.rate_of_turn_deg_s) * 60.0);
      past = std::max(past, std::remainder(ship.heading_deg - 150.0, 360.0));
      if (tick < 10) past = 0.0;
    }
    EXPECT_LE(fastest, c.most_rate_deg_min * (1 + 1e-9)) << c.key;
    EXPECT_GT(fastest, 0.6 * c.most_rate_deg_min) << c.key;
    EXPECT_LT(past, 0.05) << c.key << " overshoots";
    EXPECT_LT(off_deg(run.ship(0).heading_deg, 150.0), 0.05) << c.key;
    EXPECT_NEAR(run.ship(0).speed_mps, knots_in_mps(c.service_kn), 1e-6) << c.key;
  }
}

TEST(TrafficShip, TurnsAtAWaypointWithoutOvershoot) {
  double worst_m = 0.0;
  for (const char* key : {"vlcc", "container", "coaster", "fast_ferry", "pilot"}) {
    for (const double corner : {30.0, 90.0, 120.0}) {
      const GeoPoint mark{60.0, 5.0};
      const double north = 8000.0 * std::cos(corner * M_PI / 180.0);
      const double east = 8000.0 * std::sin(corner * M_PI / 180.0);
      const GeoPoint begin = advanced(mark, ShortWay{-9000.0, 0.0});
      const GeoPoint end = advanced(mark, ShortWay{north, east});
      TrafficRun run("targets: [{name: A, ship_class: " + std::string(key) +
                     ", position: {lat: " + std::to_string(begin.latitude_deg) + ", lon: 5}, " +
                     "waypoints: [{lat: 60, lon: 5}, {lat: " + std::to_string(end.latitude_deg) +
                     ", lon: " + std::to_string(end.longitude_deg) + "}]}]\n");
      double past_m = 0.0;
      for (int tick = 0; tick < 30'000; ++tick) {
        run.step();
        const ShipState ship = run.ship(0);
        const ShortWay way = short_way_between(mark, ship.position);
        // To port of the second leg: beyond it.
        const double left = (way.north_m * east - way.east_m * north) / 8000.0;
        const double along = (way.north_m * north + way.east_m * east) / 8000.0;
        if (along > 6000.0) break;
        if (off_deg(ship.heading_deg, corner) < 60.0) past_m = std::max(past_m, left);
      }
      const TrafficClass& c = *find_traffic_class(key);
      const double radius = knots_in_mps(c.service_kn) / (c.most_rate_deg_min / 60.0) * 57.3;
      worst_m = std::max(worst_m, past_m / radius);
      EXPECT_LT(past_m, 0.05 * radius + 2.0) << key << ' ' << corner;
    }
  }
  std::printf("beyond the next leg: at worst %.3f of the radius of her turn\n", worst_m);
}

TEST(TrafficShip, ComesWhenSheIsDue) {
  // 25 NM in two hours, with a corner and a stop.
  TrafficRun run(
      "targets:\n"
      "  - {name: A, ship_class: coaster, speed_kn: 8, position: {lat: 60, lon: 5},\n"
      "     waypoints: [{lat: 60.2, lon: 5, arrive_min: 65}, {lat: 60.4, lon: 5, arrive_min: "
      "120}]}\n"
      "  - {name: B, ship_class: ferry, position: {lat: 60, lon: 6},\n"
      "     waypoints: [{lat: 60.4, lon: 6, arrive_min: 120, stop_min: 10}, {lat: 60.5, lon: 6}]}"
      "\n");
  const GeoPoint middle{60.2, 5.0}, end{60.4, 5.0};
  double middle_s = 0.0, end_s = 0.0, stop_s = 0.0;
  for (int tick = 0; tick < 80'000; ++tick) {
    run.step();
    const ShipState a = run.ship(0), b = run.ship(1);
    if (middle_s == 0.0 && a.position.latitude_deg >= middle.latitude_deg) {
      middle_s = in_seconds(run.now);
    }
    if (end_s == 0.0 && a.speed_mps == 0.0) end_s = in_seconds(run.now);
    if (stop_s == 0.0 && in_seconds(run.now) > 60.0 && b.speed_mps == 0.0)
      stop_s = in_seconds(run.now);
  }
  std::printf("passed %.1f s, stopped %.1f s and %.1f s from when she was due\n", middle_s - 3900.0,
              end_s - 7200.0, stop_s - 7200.0);
  EXPECT_NEAR(middle_s, 3900.0, 2.0);
  EXPECT_NEAR(end_s, 7200.0, 2.0);
  EXPECT_NEAR(stop_s, 7200.0, 2.0);
  EXPECT_LT(metres_apart(run.ship(0).position, end), 0.1);
}

TEST(TrafficShip, AFerryKeepsToHerTimetable) {
  // 3 NM in 12 minutes, 5 minutes at each end, to and fro for four hours.
  TrafficRun run(
      "targets: [{name: A, ship_class: ferry, position: {lat: 60, lon: 5}, route_end: back,\n"
      "  waypoints: [{lat: 60.05, lon: 5, arrive_min: 14, stop_min: 5}]}]\n");
  const double trip_s = 19.0 * 60.0;
  double worst_m = 0.0;
  for (int trip = 0; trip < 12; ++trip) {
    // In the middle of each stop she lies at its end.
    run.step_to(trip * trip_s + 14.0 * 60.0 + 150.0);
    const GeoPoint there{trip % 2 == 0 ? 60.05 : 60.0, 5.0};
    worst_m = std::max(worst_m, metres_apart(run.ship(0).position, there));
    EXPECT_LT(run.ship(0).speed_mps, 0.01) << trip;
    // A minute after she was due to leave she makes way.
    run.step_to((trip + 1) * trip_s + 60.0);
    EXPECT_GT(run.ship(0).speed_mps, 1.0) << trip;
  }
  std::printf("at her stops: %.1f m off at worst\n", worst_m);
  EXPECT_LT(worst_m, 60.0);
}

TEST(TrafficShip, RoutesEndAsTheyAreToldTo) {
  const auto route = [](const std::string& end) {
    return "targets: [{name: A, ship_class: pilot, speed_kn: 20, position: {lat: 60, lon: 5},\n"
           "  waypoints: [{lat: 60.01, lon: 5}, {lat: 60.01, lon: 5.02}], route_end: " +
           end + "}]\n";
  };
  TrafficRun stop(route("stop")), vanish(route("vanish")), again(route("again")),
      round(route("round"));
  bool was_put = false;
  double nearest_first = 1e9;
  GeoPoint last = again.ship(0).position;
  for (int tick = 0; tick < 9000; ++tick) {
    for (TrafficRun* run : {&stop, &vanish, &again, &round}) run->step();
    const GeoPoint here = again.ship(0).position;
    was_put =
        was_put || (metres_apart(here, last) > 1000.0 && metres_apart(here, {60.0, 5.0}) < 1.0);
    last = here;
    if (tick > 3000) {
      nearest_first = std::min(nearest_first, metres_apart(round.ship(0).position, {60.01, 5.0}));
    }
  }
  EXPECT_LT(metres_apart(stop.ship(0).position, {60.01, 5.02}), 1.0);
  EXPECT_EQ(stop.ship(0).speed_mps, 0.0);
  EXPECT_TRUE(vanish.traffic.states(vanish.now).empty());
  EXPECT_TRUE(vanish.told(0).removed());
  EXPECT_TRUE(was_put);
  EXPECT_LT(nearest_first, 400.0);
}

TEST(TrafficShip, StartsWhenSheIsToldTo) {
  TrafficRun run(
      "targets: [{name: A, ship_class: tug, course_deg: 90, position: {lat: 60, lon: 5}, "
      "start_min: 10}]\n");
  run.step_to(599.0);
  EXPECT_EQ(run.ship(0).position, (GeoPoint{60.0, 5.0}));
  run.step_to(900.0);
  EXPECT_GT(metres_apart(run.ship(0).position, {60.0, 5.0}), 1000.0);
}

TEST(TrafficShip, SwingsRoundHerAnchor) {
  TrafficRun run(
      "sea: {wind_kn: 20, wind_from_deg: 270}\n"
      "targets: [{name: A, ship_class: bulker, position: {lat: 60, lon: 5}, anchored: true, "
      "swing_radius_m: 150}]\n");
  const GeoPoint anchor{60.0, 5.0};
  double worst_m = 0.0, worst_bow = 0.0, most = -99.0, least = 99.0;
  for (int tick = 0; tick < 36'000; ++tick) {
    run.step();
    const ShipState ship = run.ship(0);
    const ShortWay way = short_way_between(ship.position, anchor);
    worst_m = std::max(worst_m, std::fabs(std::hypot(way.north_m, way.east_m) - 150.0));
    const double to_anchor = std::atan2(way.east_m, way.north_m) * 180.0 / M_PI;
    worst_bow = std::max(worst_bow, off_deg(ship.heading_deg, to_anchor));
    const double off = std::remainder(ship.heading_deg - 270.0, 360.0);
    most = std::max(most, off);
    least = std::min(least, off);
  }
  std::printf("at anchor: %.2e m off the circle, bow %.2e deg off, sheers %.1f to %.1f deg\n",
              worst_m, worst_bow, least, most);
  EXPECT_LT(worst_m, 0.05);
  EXPECT_LT(worst_bow, 0.1);
  EXPECT_GT(most, 9.0);
  EXPECT_LT(most, 21.0);
  EXPECT_LT(least, -9.0);
  EXPECT_GT(least, -21.0);
  // The tide turns her: against two knots of current the wind is little.
  run.environment.current_kn = 2.0;
  run.environment.current_set_deg = 0.0;
  run.environment.wind_kn = 3.0;
  run.step_to(3600.0 + 3600.0);
  EXPECT_LT(off_deg(run.ship(0).heading_deg, 180.0), 25.0);
}

TEST(TrafficShip, KeepsStationOnATurningLeader) {
  TrafficRun run(
      "targets:\n"
      "  - {name: Lead, ship_class: naval, speed_kn: 14, course_deg: 0, position: {lat: 60, lon: "
      "5}}\n"
      "  - {name: Wing, ship_class: naval, speed_kn: 14, position: {lat: 59.99, lon: 5.02},\n"
      "     follows: Lead, follow_bearing_deg: 135, follow_distance_nm: 0.5}\n");
  const auto off_station = [&] {
    const ShipState lead = run.ship(0), wing = run.ship(1);
    const double bearing = (lead.heading_deg + 135.0) * M_PI / 180.0;
    const ShortWay way = short_way_between(lead.position, wing.position);
    return std::hypot(way.north_m - 926.0 * std::cos(bearing),
                      way.east_m - 926.0 * std::sin(bearing)) /
           926.0;
  };
  run.step_to(1800.0);
  EXPECT_LT(off_station(), 0.05);
  wire::TargetChange turn = order_to(0);
  turn.set_course_deg(90.0);
  run.traffic.order(turn, run.now);
  run.step_to(3600.0);
  std::printf("on station after a turn of 90 deg: off by %.4f of the distance\n", off_station());
  EXPECT_LT(off_station(), 0.05);
  EXPECT_LT(off_deg(run.ship(1).heading_deg, 90.0), 1.0);
}

TEST(TrafficShip, FishesWithinHerGround) {
  TrafficRun run(
      "targets: [{name: A, ship_class: fishing, position: {lat: 60, lon: 5}, fishes_within_nm: 1}]"
      "\n");
  double farthest = 0.0, fastest = 0.0;
  int legs = 0;
  double last = run.ship(0).ordered_course_deg;
  for (int tick = 0; tick < 144'000; ++tick) {
    run.step();
    const ShipState ship = run.ship(0);
    farthest = std::max(farthest, metres_apart(ship.position, {60.0, 5.0}));
    fastest = std::max(fastest, ship.speed_mps);
    if (ship.ordered_course_deg != last) ++legs;
    last = ship.ordered_course_deg;
  }
  std::printf("fishing for 4 h: %d legs, up to %.0f m away\n", legs, farthest);
  EXPECT_LT(farthest, kMile);
  EXPECT_LT(fastest, knots_in_mps(4.01));
  EXPECT_GT(legs, 12);
  EXPECT_LT(legs, 100);
}

TEST(TrafficShip, TakesOrders) {
  TrafficRun run(
      "targets:\n"
      "  - {name: A, position: {lat: 60, lon: 5}, speed_kn: 12,\n"
      "     waypoints: [{lat: 60.02, lon: 5}, {lat: 60.1, lon: 5}]}\n"
      "  - {name: B, ship_class: tug, position: {lat: 61, lon: 5}}\n");
  run.step_to(600.0);
  EXPECT_EQ(run.told(0).route_size(), 1);
  wire::TargetChange course = order_to(0);
  course.set_course_deg(90.0);
  course.set_speed_kn(6.0);
  ASSERT_FALSE(run.traffic.fault_of(course));
  const ShipState before = run.ship(0);
  const auto kept = run.traffic.keep(0);
  run.traffic.order(course, run.now);
  EXPECT_LT(metres_apart(before.position, run.ship(0).position), 1e-6) << "no jump";
  run.step_to(1500.0);
  EXPECT_LT(off_deg(run.ship(0).heading_deg, 90.0), 0.1);
  EXPECT_NEAR(run.ship(0).speed_mps, knots_in_mps(6.0), 0.01);
  EXPECT_TRUE(run.told(0).on_course());
  // Back to her route.
  wire::TargetChange resume = order_to(0);
  resume.set_resume(true);
  run.traffic.order(resume, run.now);
  run.step_to(9000.0);
  EXPECT_FALSE(run.told(0).on_course());
  EXPECT_LT(metres_apart(run.ship(0).position, {60.1, 5.0}), 5.0);
  // Undone: as she was.
  run.traffic.put_back(*kept);
  EXPECT_EQ(run.told(0).on_course(), false);
  // Elsewhere, taken off and put back.
  wire::TargetChange put = order_to(1);
  put.set_latitude_deg(60.5);
  put.set_longitude_deg(6.0);
  run.traffic.order(put, run.now);
  EXPECT_EQ(run.ship(1).position, (GeoPoint{60.5, 6.0}));
  wire::TargetChange gone = order_to(1);
  gone.set_removed(true);
  run.traffic.order(gone, run.now);
  EXPECT_EQ(run.traffic.states(run.now).size(), 1u);
  gone.set_removed(false);
  run.traffic.order(gone, run.now);
  EXPECT_EQ(run.traffic.states(run.now).size(), 2u);

  wire::TargetChange fast = order_to(1);
  fast.set_speed_kn(30.0);
  EXPECT_EQ(run.traffic.fault_of(fast).value_or(""),
            "speed: 30 kn for B, a tug, is more than she can do; allowed: up to 13.5 kn");
  EXPECT_EQ(run.traffic.fault_of(order_to(2)).value_or(""),
            "target: there is no ship 2 among the targets");
  wire::TargetChange half = order_to(1);
  half.set_latitude_deg(60.0);
  EXPECT_TRUE(run.traffic.fault_of(half));
}

}  // namespace
}  // namespace skerry::server
