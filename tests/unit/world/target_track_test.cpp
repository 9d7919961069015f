#include "server/world/target_track.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Rhumb.hpp>
#include <chrono>
#include <cstdio>

#include "tests/unit/world/geodesy.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

scenario::Target target(double latitude, double longitude, double course, double speed_kn) {
  scenario::Target ship;
  ship.set_name("Rosund");
  ship.mutable_position()->set_lat(latitude);
  ship.mutable_position()->set_lon(longitude);
  ship.set_course_deg(course);
  ship.set_speed_kn(speed_kn);
  ship.set_length_m(82);
  ship.set_beam_m(12);
  ship.set_height_m(13);
  return ship;
}

void add_waypoint(scenario::Target& ship, double latitude, double longitude) {
  wire::Waypoint& waypoint = *ship.add_waypoints();
  waypoint.set_lat(latitude);
  waypoint.set_lon(longitude);
}

TEST(TargetTrack, WithoutWaypointsIsARhumbLine) {
  const TargetTrack track(target(60.4, 5.0, 47.0, 10.0));
  for (const auto t : {0s, 1s, 1800s, 36'000s}) {
    GeoPoint rhumb;
    GeographicLib::Rhumb::WGS84().Direct(60.4, 5.0, 47.0, 18'520.0 / 3600.0 * in_seconds(t),
                                         rhumb.latitude_deg, rhumb.longitude_deg);
    const ShipState ship = track.at(t);
    EXPECT_LT(metres_between(ship.position, rhumb), 1e-6);
    EXPECT_EQ(ship.heading_deg, 47.0);
    EXPECT_EQ(ship.course_over_ground_deg, 47.0);
    EXPECT_DOUBLE_EQ(ship.speed_mps, 18'520.0 / 3600.0);
    EXPECT_EQ(ship.rate_of_turn_deg_s, 0.0);
  }
  const ShipState ship = track.at(0s);
  EXPECT_EQ(ship.name, "Rosund");
  EXPECT_EQ(ship.length_m, 82.0);
  EXPECT_EQ(ship.beam_m, 12.0);
  EXPECT_EQ(ship.height_m, 13.0);
}

TEST(TargetTrack, LiesStillWithoutSpeedAndBeforeTheStart) {
  EXPECT_EQ(TargetTrack(target(60.4, 5.0, 47.0, 0.0)).at(10h).position, (GeoPoint{60.4, 5.0}));
  EXPECT_EQ(TargetTrack(target(60.4, 5.0, 47.0, 9.0)).at(-10h).position, (GeoPoint{60.4, 5.0}));
}

TEST(TargetTrack, SailsItsWaypointsAlongGeodesicsAndStops) {
  scenario::Target ship = target(60.0, 179.0, 0.0, 36.0);  // 18.52 m/s
  add_waypoint(ship, 61.0, -179.0);
  add_waypoint(ship, 61.5, -178.0);
  const TargetTrack track(ship);
  const double first = metres_between({60.0, 179.0}, {61.0, -179.0});
  const double second = metres_between({61.0, -179.0}, {61.5, -178.0});
  double worst = 0.0;
  for (double part = 0.0; part < 1.0; part += 0.01) {
    const ShipState at = track.at(seconds_as_duration(part * first / 18.52));
    // On the geodesic: the ways to both ends add up, and the first is what was sailed.
    const double to_start = metres_between(at.position, {60.0, 179.0});
    const double to_end = metres_between(at.position, {61.0, -179.0});
    worst =
        std::max({worst, std::fabs(to_start - part * first), std::fabs(to_start + to_end - first)});
    EXPECT_TRUE(is_sane(at.position));
  }
  std::printf("waypoint leg: worst %.2e m along the geodesic\n", worst);
  EXPECT_LT(worst, 1e-6);

  const ShipState on_second = track.at(seconds_as_duration((first + 0.5 * second) / 18.52));
  EXPECT_NEAR(metres_between(on_second.position, {61.0, -179.0}), 0.5 * second, 1e-5);
  EXPECT_DOUBLE_EQ(on_second.speed_mps, 18.52);

  const ShipState stopped = track.at(seconds_as_duration((first + second) / 18.52 + 1e-6));
  EXPECT_LT(metres_between(stopped.position, {61.5, -178.0}), 1e-6);
  EXPECT_EQ(stopped.speed_mps, 0.0);
  EXPECT_EQ(track.at(24h * 365).position, stopped.position);
  EXPECT_EQ(track.at(24h * 365).heading_deg, stopped.heading_deg);
  EXPECT_LT(metres_between(geodesic_step({61.0, -179.0}, 0, 0), {61.0, -179.0}), 1e-9);
}

TEST(TargetTrack, HeadsAlongItsLeg) {
  scenario::Target ship = target(60.0, 5.0, 0.0, 10.0);
  add_waypoint(ship, 60.0, 6.0);
  add_waypoint(ship, 59.0, 6.0);
  const TargetTrack track(ship);
  EXPECT_NEAR(track.at(0s).heading_deg, 89.567, 1e-2) << "a great circle bends to the pole";
  EXPECT_NEAR(track.at(24h).heading_deg, 180.0, 1e-9);
  for (const auto t : {100s, 5000s, 15'000s}) {
    const ShipState now = track.at(t);
    const ShipState later = track.at(t + 1s);
    EXPECT_LT(
        metres_between(geodesic_step(now.position, now.heading_deg, now.speed_mps), later.position),
        1e-6);
  }
}

TEST(TargetTrack, StaysOnEarthForYears) {
  for (const double course : {0.0, 0.001, 90.0, 135.0, 180.0, 360.0}) {
    const TargetTrack track(target(89.0, 180.0, course, 60.0));
    for (int hour = 0; hour < 24 * 365 * 2; hour += 7) {
      const ShipState ship = track.at(std::chrono::hours(hour));
      ASSERT_TRUE(is_sane(ship.position)) << course << ' ' << hour;
      ASSERT_TRUE(ship.heading_deg >= 0.0 && ship.heading_deg < 360.0);
    }
  }
}

}  // namespace
}  // namespace skerry::server
