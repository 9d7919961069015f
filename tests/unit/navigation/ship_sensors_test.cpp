// What sensors say is near the truth, changes, and is the same for everybody.
#include "server/navigation/ship_sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skerry::server {
namespace {

wire::OwnShip ship_at(double seconds) {
  wire::OwnShip ship;
  ship.set_name("Tern");
  ship.set_mmsi(257000001);
  ship.set_latitude_deg(60.0);
  ship.set_longitude_deg(5.0);
  ship.set_heading_deg(359.99);
  ship.set_course_over_ground_deg(0.01);
  ship.set_speed_over_ground_kn(12.0);
  ship.set_utc_ns(1'700'000'000'000'000'000ull + static_cast<std::uint64_t>(seconds * 1e9));
  return ship;
}

double off(double a, double b) { return std::remainder(a - b, 360.0); }

TEST(ShipSensors, HaveTheErrorsThatTheyState) {
  const SensorErrors errors;
  double heading = 0.0, speed = 0.0, north = 0.0, east = 0.0, mean = 0.0;
  constexpr int kTicks = 20'000;
  for (int i = 0; i < kTicks; ++i) {
    const wire::OwnShip truth = ship_at(i / 10.0), told = sensed(truth, errors);
    const double yaw = off(told.heading_deg(), truth.heading_deg());
    ASSERT_LT(std::fabs(yaw), errors.yaw_deg + 6.0 * errors.heading_deg);
    ASSERT_GE(told.heading_deg(), 0.0);
    ASSERT_LT(told.heading_deg(), 360.0);
    ASSERT_LT(std::fabs(off(told.course_over_ground_deg(), truth.course_over_ground_deg())),
              3.0 * errors.course_deg);
    mean += yaw / kTicks;
    heading += yaw * yaw / kTicks;
    speed += std::pow(told.speed_over_ground_kn() - 12.0, 2) / kTicks;
    north += std::pow((told.latitude_deg() - 60.0) * 111'120.0, 2) / kTicks;
    east += std::pow((told.longitude_deg() - 5.0) * 111'120.0 * 0.5, 2) / kTicks;
  }
  EXPECT_NEAR(mean, 0.0, 0.01);
  const double yaw_rms = errors.yaw_deg * std::sqrt((0.36 + 0.16) / 2.0);
  EXPECT_NEAR(std::sqrt(heading), std::hypot(errors.heading_deg, yaw_rms), 0.01);
  EXPECT_NEAR(std::sqrt(speed), errors.speed_kn, 0.002);
  EXPECT_NEAR(std::sqrt(north), errors.position_m, 0.03);
  EXPECT_NEAR(std::sqrt(east), errors.position_m, 0.03);
}

TEST(ShipSensors, TellEverybodyTheSameAndSoonAnother) {
  const wire::OwnShip first = sensed(ship_at(5.0), {}), again = sensed(ship_at(5.0), {});
  EXPECT_EQ(first.SerializeAsString(), again.SerializeAsString());
  const wire::OwnShip later = sensed(ship_at(5.2), {});
  EXPECT_NE(first.heading_deg(), later.heading_deg());
  EXPECT_NE(first.course_over_ground_deg(), later.course_over_ground_deg());
  EXPECT_NE(first.latitude_deg(), later.latitude_deg());
}

TEST(ShipSensors, LeaveWhatIsNotTheirs) {
  wire::OwnShip ship = ship_at(5.0);
  EXPECT_EQ(sensed(ship, SensorErrors::none()).SerializeAsString(), ship.SerializeAsString());
  ship.set_driven(true);
  EXPECT_EQ(sensed(ship, {}).SerializeAsString(), ship.SerializeAsString());
  ship = ship_at(5.0);
  ship.set_no_heading(true);
  ship.set_no_motion(true);
  ship.set_no_position(true);
  EXPECT_EQ(sensed(ship, {}).SerializeAsString(), ship.SerializeAsString());
}

TEST(ShipSensors, AShipThatLiesStillGoesNotAstern) {
  for (int i = 0; i < 100; ++i) {
    wire::OwnShip ship = ship_at(i / 10.0);
    ship.set_speed_over_ground_kn(0.0);
    ASSERT_GE(sensed(ship, {}).speed_over_ground_kn(), 0.0);
  }
}

}  // namespace
}  // namespace skerry::server
