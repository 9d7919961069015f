// Turbines, wakes and cables.
#include <gtest/gtest.h>

#include "echo/targets/echo_parts.hpp"
#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

// Cross-section of the blades, m2.
double blades_of(const WindTurbine& turbine, PlanePoint own_ship, double seconds) {
  std::vector<EchoPart> parts;
  turbine_parts(turbine, own_ship, seconds, 1, parts);
  EXPECT_EQ(parts.size(), kTurbineParts);
  double sum = 0.0;
  for (std::size_t k = 2; k < parts.size(); ++k) sum += parts[k].cross_section_m2;
  return sum;
}

TEST(Turbine, SeenEdgeOnABladeFlashesTwiceATurn) {
  WindTurbine turbine;
  turbine.place = {0.0, 3000.0};
  turbine.facing_deg = 270.0;  // across the line of sight from the south
  turbine.rotor_rpm = 10.0;    // a turn in 6 s, so six flashes of three blades in it
  int flashes = 0;
  bool before = blades_of(turbine, {0, 0}, 0.0) > 1000.0;
  for (int k = 1; k <= 6000; ++k) {
    const bool now = blades_of(turbine, {0, 0}, 0.001 * k) > 1000.0;
    flashes += now && !before;
    before = now;
  }
  EXPECT_EQ(flashes, 6);
  turbine.facing_deg = 180.0;  // towards the radar: all blades are square all the time
  for (int k = 0; k < 60; ++k) EXPECT_NEAR(blades_of(turbine, {0, 0}, 0.1 * k), 9000.0, 1.0);
  turbine.rotor_rpm = 0.0;
  turbine.facing_deg = 270.0;
  EXPECT_EQ(blades_of(turbine, {0, 0}, 0.0), blades_of(turbine, {0, 0}, 1234.5));
}

TEST(Turbine, BladesTurnAboutTheHubWithinTheRotor) {
  WindTurbine turbine;
  turbine.place = {0.0, 3000.0};
  std::vector<EchoPart> now, later;
  turbine_parts(turbine, {0, 0}, 10.0, 1, now);
  turbine_parts(turbine, {0, 0}, 13.0, 1, later);  // half a turn at 10 rpm
  for (std::size_t k = 2; k < now.size(); ++k) {
    EXPECT_NEAR(now[k].height_m + later[k].height_m, 180.0, 1e-6);
    EXPECT_LE(now[k].height_m, 150.0);
    EXPECT_GE(now[k].height_m, 30.0);
    EXPECT_LT(std::hypot(now[k].place.east_m, now[k].place.north_m - 3000.0), 61.0);
  }
}

TEST(Wake, TrailsAsternAndFades) {
  Hull hull{{0, 0}, {0.0, 8.0}, 0.0, 0.0, 100.0, 15.0, 20.0, 5};
  std::vector<EchoPart> parts;
  wake_parts(hull, 0.0, 1, parts);
  EXPECT_TRUE(parts.empty());
  hull.wake = true;
  constexpr double kStep = 480.0 / kWakeParts;  // metres: 60 s at 8 m/s
  std::vector<double> mean(kWakeParts, 0.0);
  for (std::uint64_t pass = 0; pass < 2000; ++pass) {
    wake_parts(hull, 0.0, pass, parts);
    ASSERT_EQ(parts.size(), kWakeParts);
    for (std::size_t k = 0; k < kWakeParts; ++k) mean[k] += parts[k].cross_section_m2 / 2000.0;
  }
  for (std::size_t k = 0; k < kWakeParts; ++k) {
    EXPECT_NEAR(parts[k].place.north_m, -50.0 - kStep * (static_cast<double>(k) + 0.5), 1e-6);
    EXPECT_NEAR(parts[k].place.east_m, 0.0, 1e-9);
    // 5e-4 of a step by 15 m, fading over 20 s; the mean of 2000 strays 2.2 %.
    const double age = kStep / 8.0 * (static_cast<double>(k) + 0.5);
    EXPECT_NEAR(mean[k] / (5e-4 * kStep * 15.0 * std::exp(-age / 20.0)), 1.0, 0.12);
  }
  hull.velocity = {0.0, 0.5};
  wake_parts(hull, 0.0, 1, parts);
  EXPECT_TRUE(parts.empty());
}

TEST(Wake, LiesOnTheCircleAShipTurnsOn) {
  // 10 m/s and 3 deg/s to starboard: a circle of 191 m about a place east of her.
  Hull hull{{0, 0}, {0.0, 10.0}, 0.0, 3.0, 0.0, 15.0, 20.0, 5};
  hull.wake = true;
  std::vector<EchoPart> parts;
  wake_parts(hull, 0.0, 1, parts);
  const double radius = 10.0 / (3.0 * std::numbers::pi / 180.0);
  for (const EchoPart& part : parts) {
    EXPECT_NEAR(std::hypot(part.place.east_m - radius, part.place.north_m), radius, 3.0);
  }
}

TEST(Cable, EchoesWhereTheLineOfSightIsSquareToItAndMovesWithTheOwnShip) {
  const OverheadCable cable{{-1000.0, 2000.0}, {1000.0, 2000.0}, 30.0, 1};
  for (const double east : {-900.0, 0.0, 400.0}) {
    const auto part = cable_part(cable, {east, 500.0});
    ASSERT_TRUE(part);
    EXPECT_NEAR(part->place.east_m, east, 1e-9);
    EXPECT_NEAR(part->place.north_m, 2000.0, 1e-9);
    EXPECT_NEAR(part->cross_section_m2, 3.0 * std::numbers::pi * 0.015 * 1500.0, 1e-6);
  }
  EXPECT_FALSE(cable_part(cable, {1200.0, 500.0}));
  EXPECT_FALSE(cable_part({{5.0, 5.0}, {5.0, 5.0}, 30.0, 1}, {0.0, 0.0}));

  const RadarModel model = model_at(3.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.cables = {cable};
  int echoes = 0;
  for (double bearing = 1.0; bearing < 360.0; bearing += 1.4)
    echoes += echoes_about(returns, model, scene, bearing).empty() ? 0 : 1;
  EXPECT_GE(echoes, 2);  // one place, seen by the sectors about it
  EXPECT_LE(echoes, 4);
}

}  // namespace
}  // namespace skerry::echo
