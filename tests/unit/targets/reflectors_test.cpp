#include "echo/targets/reflectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {
namespace {

constexpr double kX = kLightSpeed / 9.41e9, kS = kLightSpeed / 3.05e9;

// Digits of SOURCES.md "Vectors" and "Targets".
TEST(Reflectors, TriangularTrihedralsAreThoseOfTheSheet) {
  EXPECT_NEAR(trihedral_cross_section(0.3, kX), 33.428, 0.0005);
  EXPECT_NEAR(trihedral_cross_section(0.3, kS), 3.5118, 0.00005);
  EXPECT_NEAR(trihedral_edge(10.0, kX), 0.2219, 0.00005);
  EXPECT_NEAR(trihedral_edge(7.5, kX), 0.2065, 0.00005);
  EXPECT_NEAR(trihedral_cross_section(0.2219, kX) / trihedral_cross_section(0.2219, kS), 9.52,
              0.005);
}

TEST(Reflectors, OthersStandToTheTrihedralAsTheirFormulasSay) {
  const double a = 0.4;
  EXPECT_NEAR(square_trihedral_cross_section(a, kX) / trihedral_cross_section(a, kX), 9.0, 1e-9);
  // A dihedral of the same edges: 8 against 4/3.
  EXPECT_NEAR(dihedral_cross_section(a, a, kX) / trihedral_cross_section(a, kX), 6.0, 1e-9);
  EXPECT_NEAR(plate_cross_section(a * a, kX) / trihedral_cross_section(a, kX), 3.0, 1e-9);
  // A lens is a plate of its own cross-section.
  EXPECT_NEAR(luneburg_cross_section(a, kX) / plate_cross_section(std::numbers::pi * a * a, kX),
              1.0, 1e-9);
  EXPECT_NEAR(sphere_cross_section(a), 0.502655, 1e-6);
}

TEST(Reflectors, AWireEchoesInProportionToItsRange) {
  EXPECT_NEAR(wire_cross_section(0.015, 2000.0) / wire_cross_section(0.015, 500.0), 4.0, 1e-12);
  // 94 m2 for 30 mm at 1 NM or so: the first zone's length sqrt(l R) times the width of a cylinder.
  EXPECT_NEAR(wire_cross_section(0.015, 2000.0), 94.25, 0.01);
}

}  // namespace
}  // namespace skerry::echo
