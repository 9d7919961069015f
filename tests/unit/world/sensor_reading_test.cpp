// Errors of an own ship's sensors.
#include "server/world/sensors/sensor_reading.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>

#include "server/world/own_ship.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/random_faults.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

TEST(SensorReading, WithoutFaultsNothingIsWrong) {
  EXPECT_EQ(reading_of(nullptr, 5s, 1), SensorReading{});
  const FaultState none{};
  EXPECT_EQ(reading_of(&none, 5s, 1), SensorReading{});
  EXPECT_EQ(moved_by({60.0, 5.0}, {}), (GeoPoint{60.0, 5.0}));
}

TEST(SensorReading, BiasAndDriftAddUp) {
  FaultState state;
  state.faults.set_gyro_bias_deg(2.0);
  state.faults.set_gyro_drift_deg_min(-3.0);
  state.faults.set_log_bias_kn(1.5);
  state.faults.set_gnss_north_m(300.0);
  state.faults.set_gnss_drift_kn(36.0);
  state.faults.set_gnss_drift_deg(90.0);
  state.gyro_drifts_since = 60s;
  state.gnss_drifts_since = 120s;
  const SensorReading reading = reading_of(&state, 180s, 1);
  EXPECT_DOUBLE_EQ(reading.heading_deg, 2.0 - 6.0);
  EXPECT_DOUBLE_EQ(reading.rate_of_turn_deg_min, -3.0);
  EXPECT_DOUBLE_EQ(reading.log_kn, 1.5);
  EXPECT_DOUBLE_EQ(reading.north_m, 300.0);
  EXPECT_NEAR(reading.east_m, 36.0 * 1852.0 / 60.0, 1e-9);
  EXPECT_NEAR(reading.drift_east_mps, 18.52, 1e-12);
  // Before the drift was ordered there is none of it.
  EXPECT_DOUBLE_EQ(reading_of(&state, 30s, 1).heading_deg, 2.0);
  // A mile to the north is a minute of latitude.
  state.faults.set_gnss_north_m(1852.0);
  EXPECT_NEAR(moved_by({60.0, 179.9999}, reading_of(&state, 120s, 1)).latitude_deg,
              60.0 + 1.0 / 60.0, 1e-12);
  EXPECT_LT(moved_by({60.0, 179.9999}, reading_of(&state, 180s, 1)).longitude_deg, 0.0);
}

TEST(SensorReading, NoiseIsNormalEnoughAndAnotherOneEveryTenthOfASecond) {
  FaultState state;
  state.faults.set_gyro_noise_deg(0.5);
  double sum = 0.0, squares = 0.0, worst = 0.0, before = 0.0, product = 0.0;
  constexpr int kCount = 20'000;
  for (int i = 0; i < kCount; ++i) {
    const Duration begin = i * 100ms;
    const double error = reading_of(&state, begin, 7).heading_deg;
    EXPECT_EQ(error, reading_of(&state, begin + 99ms, 7).heading_deg);
    sum += error;
    squares += error * error;
    product += error * before;
    before = error;
    worst = std::max(worst, std::fabs(error));
  }
  const double deviation = std::sqrt(squares / kCount);
  std::printf("mean %.4f, deviation %.4f, worst %.2f\n", sum / kCount, deviation, worst);
  EXPECT_NEAR(sum / kCount, 0.0, 4.0 * 0.5 / std::sqrt(double{kCount}));
  EXPECT_NEAR(deviation, 0.5, 0.01);
  EXPECT_LE(worst, 6.0 * 0.5);
  EXPECT_LT(std::fabs(product / squares), 0.03);
  EXPECT_NE(reading_of(&state, 1s, 7).heading_deg, reading_of(&state, 1s, 8).heading_deg);
}

TEST(SensorReading, HasTheSameBitsOnEveryMachine) {
  FaultState state;
  state.faults.set_gyro_noise_deg(0.3);
  state.faults.set_gyro_drift_deg_min(0.7);
  state.faults.set_log_noise_kn(0.2);
  state.faults.set_gnss_noise_m(11.0);
  state.faults.set_gnss_drift_kn(2.3);
  state.faults.set_gnss_drift_deg(123.4);
  std::uint64_t sum = 0;
  const auto add = [&](double value) { sum = sum * 31 + std::bit_cast<std::uint64_t>(value); };
  for (int i = 0; i < 1000; ++i) {
    const SensorReading reading = reading_of(&state, i * 730ms, 5);
    add(reading.heading_deg);
    add(reading.log_kn);
    const GeoPoint place = moved_by({59.9, 5.1}, reading);
    add(place.latitude_deg);
    add(place.longitude_deg);
  }
  std::printf("sum %016lx\n", static_cast<unsigned long>(sum));
  EXPECT_EQ(sum, 0x04db0c3ea6075c60ull);
}

TEST(SensorReading, ABlackoutLosesAll) {
  FaultState state;
  state.faults.set_blackout(true);
  state.faults.set_gyro_bias_deg(3.0);
  state.faults.set_gnss_north_m(100.0);
  const SensorReading reading = reading_of(&state, 1s, 1);
  EXPECT_TRUE(reading.no_heading && reading.no_position && reading.no_log && reading.no_wind &&
              reading.no_ais);
  EXPECT_EQ(reading.heading_deg, 0.0);
  EXPECT_FALSE(reading.moves_position());
}

TEST(SensorReading, IsWithinItsBoundsWhateverIsWrong) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 20'000; ++i) {
    FaultState state{random_faults(random)};
    const Duration now = std::chrono::seconds(random() % 2'000'000);
    const SensorReading reading = reading_of(&state, now, random());
    ASSERT_LE(std::fabs(reading.heading_deg), 180.0);
    ASSERT_LE(std::fabs(reading.rate_of_turn_deg_min), 60.0);
    ASSERT_LE(std::fabs(reading.log_kn), 50.0);
    ASSERT_LE(std::fabs(reading.north_m), kFarthestOffM);
    ASSERT_LE(std::fabs(reading.east_m), kFarthestOffM);
    ASSERT_LE(std::hypot(reading.drift_north_mps, reading.drift_east_mps), 30.9);
    const GeoPoint place = moved_by(
        {90.0 - static_cast<double>(random() % 181), 180.0 - static_cast<double>(random() % 360)},
        reading);
    ASSERT_LE(std::fabs(place.latitude_deg), 90.0);
    ASSERT_LE(std::fabs(place.longitude_deg), 180.0);
  }
}

TEST(OwnShipFaults, WhatCompassAndReceiverSaidLastIsHeld) {
  World world(parse_scenario(
      "name: s\nown_ships:\n"
      "  - {name: F, position: {lat: 60, lon: 5}, course_deg: 350, speed_kn: 10, radars: [{}]}\n",
      "f"));
  OwnShip ship(parse_scenario("name: s\nown_ships:\n  - {name: F, position: {lat: 60, lon: 5}, "
                              "course_deg: 350, speed_kn: 10, radars: [{}]}\n",
                              "f")
                   .own_ships(0),
               *world.environment(), World::kTick, 1);
  const auto step = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) ship.step(*world.environment());
  };
  wire::Faults faults;
  faults.set_gyro_drift_deg_min(30.0);
  ship.set_faults(faults);
  step(600);
  faults.set_gyro_lost(true);
  faults.set_gnss_lost(true);
  ship.set_faults(faults);
  const GeoPoint lost_at = ship.state().position;
  step(600);
  faults.set_log_lost(true);
  ship.set_faults(faults);
  ASSERT_TRUE(ship.state().faults->held_heading_deg);
  EXPECT_NEAR(*ship.state().faults->held_heading_deg, 20.0, 1e-6) << "350 and 30 of drift";
  EXPECT_EQ(*ship.state().faults->held_position, lost_at);
  // The drift goes on all the while.
  faults.set_gyro_lost(false);
  ship.set_faults(faults);
  EXPECT_FALSE(ship.state().faults->held_heading_deg);
  EXPECT_NEAR(reading_of(ship.state().faults.get(), 120s, 1).heading_deg, 60.0, 1e-6);
}

}  // namespace
}  // namespace skerry::server
