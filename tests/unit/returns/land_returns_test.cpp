#include "echo/returns/land_returns.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

std::vector<float> land_power(std::vector<LandInterval> land, LandModel model,
                              std::size_t cells = 1024) {
  std::vector<float> power(cells, 0.0f);
  add_land(land, model, lattice_path({60.0, 5.0}, {}, 0x20000000u, model.cell_m), power);
  return power;
}

LandModel land_model(double cell_m) { return {cell_m, 20.0, 0.0015, 1e18, 9}; }

TEST(LandReturns, TheLeadingEdgeStandsInTheCellOfTheCrossing) {
  for (double begin = 500.0; begin < 9000.0; begin += 123.4) {
    const auto power = land_power({{begin, begin + 4000.0}}, land_model(10.8));
    const auto first = static_cast<std::size_t>(begin / 10.8);
    for (std::size_t i = 0; i < first; ++i) ASSERT_EQ(power[i], 0.0f);
    ASSERT_GT(power[first], 0.0f) << begin;
  }
}

TEST(LandReturns, LandHasDepthAndShadows) {
  double echoing = 0, silent = 0, deep = 0;
  for (double begin = 1000.0; begin < 6000.0; begin += 53.0) {
    const auto power = land_power({{begin, begin + 2500.0}}, land_model(10.8));
    const auto first = static_cast<std::size_t>(begin / 10.8);
    for (std::size_t k = 0; k < 200; ++k) {
      (power[first + k] > 0.0f ? echoing : silent) += 1;
      if (k > 10 && power[first + k] > 0.0f) deep += 1;
    }
  }
  std::printf("cells behind the edge: %.0f %% echo, %.0f %% lie in shadow\n",
              100 * echoing / (echoing + silent), 100 * silent / (echoing + silent));
  EXPECT_GT(deep, 0.1 * (echoing + silent));
  EXPECT_GT(silent, 0.1 * (echoing + silent));
}

// A surface falls off as R^-3: the bank's own return, over distances well within the horizon.
TEST(LandReturns, FallOffWithTheCubeOfRange) {
  const auto bank = [&](double range) {
    const auto model = land_model(10.0);
    return static_cast<double>(
        land_power({{range, range + 1.0}}, model, 2048)[static_cast<std::size_t>(range / 10.0)]);
  };
  double sum = 0.0;
  int n = 0;
  for (double r = 1005.0; r < 5000.0; r += 40.0, ++n) sum += std::log2(bank(2 * r) / bank(r));
  std::printf("slope of the shore's return: R^%.2f\n", sum / n);
  EXPECT_NEAR(sum / n, -3.0, 0.3);  // the bank's cover varies by place
}

TEST(LandReturns, LowLandSinksBelowTheHorizon) {
  const double horizon = radar_horizon(20.0, 4.0);
  const auto model = land_model(100.0);
  const auto near = land_power({{0.8 * horizon, 0.8 * horizon + 1.0}}, model);
  const auto far = land_power({{1.6 * horizon, 1.6 * horizon + 1.0}}, model);
  EXPECT_GT(near[static_cast<std::size_t>(0.8 * horizon / 100.0)], 0.0f);
  EXPECT_EQ(far[static_cast<std::size_t>(1.6 * horizon / 100.0)], 0.0f);
}

TEST(LandReturns, TheLatticePathIsFixedToTheEarth) {
  const GeoPoint a{61.0, 5.0};
  double worst = 0.0;
  for (double bearing = 0.0; bearing < 360.0; bearing += 15.0) {
    const auto units = static_cast<std::uint32_t>(bearing / 360.0 * 4294967296.0);
    const LatticePath path = lattice_path(a, {}, units, 10.0);
    for (double i : {100.0, 1000.0, 2222.0}) {
      GeoPoint p;
      GeographicLib::Geodesic(6371000.0, 0.0)
          .Direct(a.latitude_deg, a.longitude_deg, bearing, (i + 0.5) * 10.0, p.latitude_deg,
                  p.longitude_deg);
      const LatticePath there = lattice_path(p, {}, 0, 0.0);
      worst = std::max(worst,
                       std::hypot(path.north0 + i * (path.north1 + i * path.north2) - there.north0,
                                  path.east0 + i * (path.east1 + i * path.east2) - there.east0));
    }
  }
  std::printf("lattice path off by %.2f m at 12 NM\n", worst);
  EXPECT_LE(worst, 0.3);
}

}  // namespace
}  // namespace skerry::echo
