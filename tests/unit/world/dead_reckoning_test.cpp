#include "server/world/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "tests/unit/world/geodesy.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

ShipState ship(double latitude, double course_deg, double speed_mps, double rate_deg_s) {
  ShipState state;
  state.position = {latitude, 5.0};
  state.heading_deg = state.course_over_ground_deg = course_deg;
  state.speed_mps = speed_mps;
  state.rate_of_turn_deg_s = rate_deg_s;
  return state;
}

// The arc in `kSteps` geodesics, each on the course at its middle.
GeoPoint fine_arc(const ShipState& state, double seconds) {
  constexpr int kSteps = 400;
  GeoPoint p = state.position;
  for (int i = 0; i < kSteps; ++i) {
    const double course =
        state.course_over_ground_deg + state.rate_of_turn_deg_s * seconds * (i + 0.5) / kSteps;
    p = geodesic_step(p, course, state.speed_mps * seconds / kSteps);
  }
  return p;
}

TEST(DeadReckoning, MatchesAFinelySteppedGeodesic) {
  double worst = 0.0;
  for (const double latitude : {0.0, -35.0, 60.4, 85.0}) {
    for (const double course : {0.0, 75.0, 90.0, 200.0, 359.0}) {
      for (const double rate : {0.0, 1.0, -3.0, 12.0}) {
        for (const double speed : {31.0, 6.0, -5.0}) {
          for (const auto dt : {200ms, 100ms, 13ms, -100ms}) {
            const ShipState state = ship(latitude, course, speed, rate);
            const ShipPlace place = position_at(state, dt);
            worst =
                std::max(worst, metres_between(place.position, fine_arc(state, in_seconds(dt))));
            EXPECT_NEAR(std::remainder(place.heading_deg - course - rate * in_seconds(dt), 360.0),
                        0.0, 1e-12);
          }
        }
      }
    }
  }
  std::printf("dead reckoning over 0.2 s against 400 geodesics: worst %.2e m\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(DeadReckoning, KeepsWithinItsBoundOfAGeodesicLeg) {
  double worst = 0.0;
  for (const double latitude : {-70.0, -60.4, 0.0, 45.0, 70.0}) {
    for (const double course : {0.0, 45.0, 90.0, 271.0}) {
      const ShipState state = ship(latitude, course, 31.0, 0.0);
      worst = std::max(worst, metres_between(position_at(state, 200ms).position,
                                             geodesic_step(state.position, course, 6.2)));
    }
  }
  std::printf("rhumb line against geodesic over 0.2 s at 31 m/s: worst %.2e m\n", worst);
  EXPECT_LT(worst, 1e-5);
}

TEST(DeadReckoning, TurnsTheHeadingThroughNorth) {
  EXPECT_NEAR(position_at(ship(60.0, 359.9, 5.0, 2.0), 100ms).heading_deg, 0.1, 1e-9);
  EXPECT_NEAR(position_at(ship(60.0, 0.1, 5.0, -2.0), 100ms).heading_deg, 359.9, 1e-9);
}

TEST(DeadReckoning, OverThePoleHeadsSouth) {
  ShipState state = ship(89.999999, 0.0, 31.0, 0.0);  // 0.11 m from the pole
  const ShipPlace place = position_at(state, 100ms);
  EXPECT_TRUE(place.over_pole);
  EXPECT_EQ(place.heading_deg, 180.0);
  EXPECT_NEAR(place.position.longitude_deg, -175.0, 1e-9);
}

}  // namespace
}  // namespace skerry::server
