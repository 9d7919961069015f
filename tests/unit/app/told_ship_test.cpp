// What an own ship's sensors say of her.
#include "server/app/told_ship.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/app/traffic_list.hpp"
#include "server/relayed/values_in_range.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_reading.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/random_faults.hpp"

namespace skerry::server {
namespace {

// A container ship on 030 at 12 kn, wind from 080 at 20 kn, a current to 140 at 1.5 kn.
class ToldShip : public testing::Test {
 protected:
  ToldShip()
      : world_(parse_scenario(
            "name: s\nsea: {wind_from_deg: 80, wind_kn: 20, current_set_deg: 140, current_kn: "
            "1.5}\n"
            "own_ships:\n  - name: F\n    ship_class: container\n    mmsi: 257111111\n"
            "    position: {lat: 60, lon: 5}\n    course_deg: 30\n    speed_kn: 12\n"
            "    radars: [{}]\n",
            "f")) {
    for (int i = 0; i < 600; ++i) world_.step();
    state_ = world_.state();
    // The con shows the water of her last tick, the way is the coming one's.
    truth_ = told({});
  }
  wire::OwnShip told(const wire::Faults& faults) {
    ShipState& ship = state_.own_ships.front();
    ship.faults =
        faults.ByteSizeLong() == 0 ? nullptr : std::make_shared<FaultState>(FaultState{faults});
    return told_ship(ship, position_at(ship, {}), reading_at(state_, ship, {}));
  }
  World world_;
  WorldState state_;
  wire::OwnShip truth_;
};

double turned(double from_deg, double to_deg) { return std::remainder(to_deg - from_deg, 360.0); }

TEST_F(ToldShip, WithoutFaultsItIsTheTruth) {
  EXPECT_EQ(truth_.heading_deg(), state_.own_ships.front().heading_deg);
  EXPECT_EQ(truth_.latitude_deg(), state_.own_ships.front().position.latitude_deg);
  EXPECT_FALSE(truth_.no_heading() || truth_.no_motion() || truth_.no_log() || truth_.no_ais());
  wire::Faults of_the_radar;
  of_the_radar.set_radar_noise_db(3);
  EXPECT_EQ(told(of_the_radar).SerializeAsString(), truth_.SerializeAsString());
}

TEST_F(ToldShip, AGyroThatErrsTurnsHeadingAndWhatIsResolvedOnIt) {
  wire::Faults faults;
  faults.set_gyro_bias_deg(10.0);
  faults.set_gyro_drift_deg_min(1.0);
  const wire::OwnShip said = told(faults);
  EXPECT_NEAR(turned(truth_.heading_deg(), said.heading_deg()), 11.0, 1e-9) << "a minute of drift";
  EXPECT_NEAR(said.rate_of_turn_deg_min() - truth_.rate_of_turn_deg_min(), 1.0, 1e-9);
  EXPECT_EQ(said.course_over_ground_deg(), truth_.course_over_ground_deg());
  EXPECT_EQ(said.speed_kn(), truth_.speed_kn());
  EXPECT_LT(said.con().ground_starboard_kn(), truth_.con().ground_starboard_kn() - 1.0);
  // The anemometer is on the ship: the true wind that it makes is off, not that felt.
  EXPECT_NEAR(turned(truth_.con().wind_from_deg(), said.con().wind_from_deg()), 11.0, 6.0);
}

TEST_F(ToldShip, AReceiverThatDriftsIsInCourseAndSpeedOverGround) {
  wire::Faults faults;
  faults.set_gnss_east_m(500.0);
  faults.set_gnss_drift_kn(5.0);
  faults.set_gnss_drift_deg(truth_.course_over_ground_deg());
  const wire::OwnShip said = told(faults);
  EXPECT_NEAR(said.speed_over_ground_kn(), truth_.speed_over_ground_kn() + 5.0, 1e-9);
  EXPECT_NEAR(said.course_over_ground_deg(), truth_.course_over_ground_deg(), 1e-9);
  const double drift_m = 5.0 * 1852.0 / 60.0;
  const double along = truth_.course_over_ground_deg() * kRadiansPerDegree;
  EXPECT_NEAR((said.latitude_deg() - truth_.latitude_deg()) * 60 * 1852, drift_m * std::cos(along),
              0.01);
  EXPECT_NEAR((said.longitude_deg() - truth_.longitude_deg()) * 60 * 1852 *
                  std::cos(truth_.latitude_deg() * kRadiansPerDegree),
              500.0 + drift_m * std::sin(along), 0.01);
  EXPECT_EQ(said.heading_deg(), truth_.heading_deg());
}

TEST_F(ToldShip, WhatIsLostIsNoughtAndSaysSo) {
  wire::Faults faults;
  faults.set_gyro_lost(true);
  wire::OwnShip said = told(faults);
  EXPECT_TRUE(said.no_heading());
  EXPECT_EQ(said.heading_deg(), 0.0);
  EXPECT_EQ(said.rate_of_turn_deg_min(), 0.0);
  EXPECT_FALSE(said.no_motion() || said.no_log());
  faults.Clear();
  faults.set_gnss_lost(true);
  said = told(faults);
  EXPECT_TRUE(said.no_position() && said.no_motion());
  EXPECT_EQ(said.latitude_deg(), 0.0);
  EXPECT_EQ(said.speed_over_ground_kn(), 0.0);
  EXPECT_EQ(said.con().ground_ahead_kn(), 0.0);
  EXPECT_EQ(said.speed_kn(), truth_.speed_kn()) << "the log's";
  faults.Clear();
  faults.set_log_lost(true);
  said = told(faults);
  EXPECT_TRUE(said.no_log());
  EXPECT_EQ(said.speed_kn(), 0.0);
  EXPECT_EQ(said.con().water_ahead_kn(), 0.0);
  EXPECT_NEAR(said.con().ground_ahead_kn(), truth_.con().ground_ahead_kn(), 1e-9);
  faults.Clear();
  faults.set_wind_lost(true);
  faults.set_ais_lost(true);
  said = told(faults);
  EXPECT_TRUE(said.no_wind() && said.no_ais());
  EXPECT_EQ(said.con().wind_kn(), 0.0);
  faults.Clear();
  faults.set_blackout(true);
  said = told(faults);
  EXPECT_TRUE(said.no_heading() && said.no_position() && said.no_motion() && said.no_log() &&
              said.no_wind() && said.no_ais());
  EXPECT_EQ(said.con().rudder_deg(), truth_.con().rudder_deg());
  EXPECT_EQ(said.mmsi(), 257'111'111u);
}

TEST_F(ToldShip, ALogThatErrsIsInTheCurrentThatIsMadeOfIt) {
  wire::Faults faults;
  faults.set_log_bias_kn(2.0);
  const wire::OwnShip said = told(faults);
  EXPECT_NEAR(said.speed_kn() - truth_.speed_kn(), 2.0, 1e-9);
  EXPECT_NEAR(said.con().water_ahead_kn() - truth_.con().water_ahead_kn(), 2.0, 1e-9);
  // What is missing over ground looks like a current against her.
  const auto ahead = [&](const wire::OwnShip& ship) {
    return ship.con().current_kn() *
           std::cos((ship.con().current_set_deg() - ship.heading_deg()) * kRadiansPerDegree);
  };
  EXPECT_NEAR(ahead(said) - ahead(truth_), -2.0, 0.05);
}

TEST_F(ToldShip, AnAnemometerThatErrsIsInTheTrueWind) {
  // As felt: the wind told, and her way over ground told.
  const auto felt = [](const wire::OwnShip& ship) {
    const double from = (ship.con().wind_from_deg() - ship.heading_deg()) * kRadiansPerDegree;
    const double ahead = ship.con().wind_kn() * std::cos(from) + ship.con().ground_ahead_kn();
    const double aside = ship.con().wind_kn() * std::sin(from) + ship.con().ground_starboard_kn();
    return std::pair(std::hypot(ahead, aside), std::atan2(aside, ahead) * kDegreesPerRadian);
  };
  const auto [well_kn, well_deg] = felt(truth_);
  wire::Faults faults;
  faults.set_wind_speed_bias_kn(4.0);
  faults.set_wind_bias_deg(-15.0);
  faults.set_gyro_bias_deg(20.0);
  const auto [said_kn, said_deg] = felt(told(faults));
  EXPECT_NEAR(said_kn - well_kn, 4.0, 1e-6);
  EXPECT_NEAR(turned(well_deg, said_deg), -15.0, 1e-6);
  // Without a compass it is still felt.
  faults.set_gyro_lost(true);
  const auto [lone_kn, lone_deg] = felt(told(faults));
  EXPECT_NEAR(lone_kn - well_kn, 4.0, 1e-6);
  EXPECT_NEAR(turned(well_deg, lone_deg), -15.0, 1e-6);
}

TEST_F(ToldShip, HerAisSaysTheSameAndTheTruthStays) {
  wire::Faults faults;
  faults.set_gyro_lost(true);
  faults.set_gnss_north_m(1852.0);
  const wire::OwnShip said = told(faults);
  const TrafficItem item = traffic_of(state_, state_.time).front();
  ASSERT_TRUE(item.ais);
  EXPECT_FALSE(item.ais->silent || item.ais->heading_deg || item.ais->rate_of_turn_deg_min);
  EXPECT_EQ(item.ais->position->latitude_deg, said.latitude_deg());
  EXPECT_EQ(item.position.latitude_deg, truth_.latitude_deg());
  faults.set_blackout(true);
  told(faults);
  EXPECT_TRUE(traffic_of(state_, state_.time).front().ais->silent);
  told({});
  EXPECT_FALSE(traffic_of(state_, state_.time).front().ais);
}

// A relay keeps to the ranges of messages: what is told is within them as it is.
TEST_F(ToldShip, WhateverIsWrongIsWithinTheRangesOfTheMessage) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5000; ++i) {
    state_.exercise = std::chrono::seconds(random() % 500'000);
    const wire::OwnShip said = told(random_faults(random));
    wire::OwnShip kept = said;
    bring_into_range(kept);
    ASSERT_EQ(kept.SerializeAsString(), said.SerializeAsString()) << said.DebugString();
  }
}

}  // namespace
}  // namespace skerry::server
