#include "echo/targets/hull_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skerry::echo {
namespace {

Hull hull_at(PlanePoint centre, double heading, double length = 120.0, double beam = 18.0) {
  return {centre, {0, 0}, heading, 0.0, length, beam, 15.0, 7};
}

double total(const std::vector<Scatterer>& s) {
  double sum = 0.0;
  for (const Scatterer& p : s) sum += p.cross_section_m2;
  return sum;
}

TEST(HullReturns, CrossSectionIsSkolniksOfTenThousandTonnes) {
  // 52 sqrt(9410) 10^1.5 = 1.59514e5 m2 (physics.md B0); beam chosen for 10 kt.
  const double beam = std::sqrt(10000.0 / (1.025 * 0.7 * 0.4 * 150.0));
  EXPECT_NEAR(ship_cross_section(150.0, beam, 9.41e9) / 1.59514e5, 1.0, 1e-5);
}

TEST(HullReturns, ABroadsideIsTenDecibelsOverTheBow) {
  EXPECT_NEAR(aspect_factor(90.0) / aspect_factor(0.0), 10.0, 1e-9);
  EXPECT_NEAR(aspect_factor(45.0), 1.0, 0.05);
  std::vector<Scatterer> bow, side;
  scatterers_of(hull_at({0, 3000}, 180.0), {0, 0}, 0.0, 20.0, 9.41e9, 10.0, bow);
  scatterers_of(hull_at({0, 3000}, 90.0), {0, 0}, 0.0, 20.0, 9.41e9, 10.0, side);
  EXPECT_NEAR(total(side) / total(bow), 10.0, 1e-6);
}

TEST(HullReturns, ExtendsByLengthAndBeam) {
  std::vector<Scatterer> s;
  const auto extent = [&](double heading) {
    scatterers_of(hull_at({0, 3000}, heading), {0, 0}, 0.0, 20.0, 9.41e9, 2.0, s);
    double near = 1e9, far = 0, left = 1e9, right = -1e9;
    for (const Scatterer& p : s) {
      near = std::min(near, p.range_m), far = std::max(far, p.range_m);
      const double across = p.range_m * std::sin(p.bearing_radians);
      left = std::min(left, across), right = std::max(right, across);
    }
    return std::pair{far - near, right - left};
  };
  const auto [along_end_on, across_end_on] = extent(0.0);
  EXPECT_NEAR(along_end_on, 120.0, 10.0);
  EXPECT_NEAR(across_end_on, 18.0, 3.0);
  const auto [along_abeam, across_abeam] = extent(90.0);
  EXPECT_NEAR(across_abeam, 120.0, 10.0);
  EXPECT_NEAR(along_abeam, 18.0, 3.0);
}

TEST(HullReturns, MovesAndTurnsWithTime) {
  Hull hull = hull_at({0, 3000}, 0.0);
  hull.velocity = {10.0, 0.0};
  std::vector<Scatterer> s;
  scatterers_of(hull, {0, 0}, 2.0, 20.0, 9.41e9, 10.0, s);
  double east = 0.0;
  for (const Scatterer& p : s) east += p.range_m * std::sin(p.bearing_radians) * p.cross_section_m2;
  EXPECT_NEAR(east / total(s), 20.0, 3.0);
}

TEST(HullReturns, SinksBelowTheHorizon) {
  std::vector<Scatterer> s;
  double before = 1e300;
  for (double km : {5.0, 20.0, 25.0, 30.0, 33.0}) {
    scatterers_of(hull_at({0, km * 1000}, 180.0), {0, 0}, 0.0, 20.0, 9.41e9, 50.0, s);
    EXPECT_LE(total(s), before) << km;
    before = total(s);
  }
  scatterers_of(hull_at({0, 35000}, 180.0), {0, 0}, 0.0, 20.0, 9.41e9, 50.0, s);
  EXPECT_TRUE(s.empty());
}

}  // namespace
}  // namespace skerry::echo
