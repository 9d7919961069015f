#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "echo/fractal/edge_refiner.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

std::string refusal(const CoastStyle& style) {
  try {
    EdgeRefiner refiner(style);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(EdgeHardCases, LengthsRoomsAndParametersAtTheirLimits) {
  std::size_t most = 0, edges = 0;
  for (const CoastMethod method : scenes::every_method()) {
    const double greatest = greatest_dimension(method);
    for (const double dimension :
         {1.0, 1.0 + 1e-15, 1.0 + 1e-9, 1.000001, 1.001, 0.5 * (1.0 + greatest), greatest}) {
      if (dimension > greatest) continue;
      for (const double amplitude : {0.0, 1e-12, 1.0, 4.0}) {
        for (const double gamma : {1.05, 1.5, 8.0}) {
          if (gamma != 1.5 && method != CoastMethod::weierstrass) continue;
          for (int phases = 0; phases < 3; ++phases) {
            if (phases > 0 && method != CoastMethod::weierstrass) continue;
            const EdgeRefiner refiner(
                {method, dimension, amplitude, gamma, static_cast<SeriesPhases>(phases)});
            for (const double length : {0.0, 1e-3, 1.0, 1e3, 5e5}) {
              for (const double tan : {0.0, 1e-300, 1e-9, 0.01, kMaxHalfAngleTan}) {
                const GrowingEdge edge{{-0.6 * length, 30.0}, {0.4 * length, 30.0}, 99, tan};
                // Around a ship abeam of the edge; 500 km of it at 0.05 m would be 10^7 vertices.
                const DetailLimit limit{.slack_m = 20.0,
                                        .range_m = 2000.0,
                                        .cell_m = length > 1e4 ? 20.0 : 2.0,
                                        .spoke_radians = 0.0015};
                std::vector<PlanePoint> out;
                refiner.refine(edge, limit, out);
                ASSERT_FALSE(out.empty());
                ASSERT_EQ(out.back(), edge.to);
                double before = edge.from.east_m;
                for (const PlanePoint& p : out) {
                  const double inside =
                      std::min(p.east_m - edge.from.east_m, edge.to.east_m - p.east_m);
                  ASSERT_LE(std::fabs(p.north_m - 30.0), tan * inside + 1e-9 * (1.0 + length));
                  if (method == CoastMethod::midpoint || method == CoastMethod::weierstrass) {
                    ASSERT_TRUE(p.east_m > before || length == 0.0);
                  }
                  before = p.east_m;
                }
                const bool stays = length == 0.0 || tan <= 1e-9 || amplitude <= 1e-12 ||
                                   dimension == 1.0 || method == CoastMethod::straight;
                if (stays) {
                  ASSERT_EQ(out.size(), 1u);
                }
                most = std::max(most, out.size());
                ++edges;
              }
            }
          }
        }
      }
    }
  }
  std::printf("%zu edges, at most %zu vertices\n", edges, most);
  EXPECT_GT(most, 1000u);
  EXPECT_LT(most, 200000u);
}

// Halving goes on to 0.05 m: 500 km has 22 levels within 10 m of the ship, and neighbouring
// vertices still differ.
TEST(EdgeHardCases, FiveHundredKilometresDownToCentimetres) {
  for (const CoastMethod method : {CoastMethod::midpoint, CoastMethod::weierstrass}) {
    for (const double dimension : {1.02, 1.15, 1.5}) {
      const EdgeRefiner refiner({.method = method, .dimension = dimension});
      const GrowingEdge edge{{-2e5, 1e4}, {3e5, -2e4}, 5, kMaxHalfAngleTan};
      // A first, coarse look to find where the coast is.
      std::vector<PlanePoint> coarse, fine;
      refiner.refine(edge, {.cell_m = 1e4}, coarse);
      const PlanePoint on_coast = coarse[coarse.size() / 2];
      refiner.refine(edge, {.centre = on_coast, .range_m = 10.0, .cell_m = 0.1}, fine);
      const PlanePoint along = (edge.to - edge.from) * (1.0 / length_of(edge.to - edge.from));
      double shortest = 1e9;
      for (std::size_t i = 1; i < fine.size(); ++i) {
        const double step = dot(along, fine[i] - fine[i - 1]);
        ASSERT_GT(step, 0.0);
        shortest = std::min(shortest, step);
      }
      std::printf("%s D %.2f: %zu vertices, the nearest two %.3f m apart along the edge\n",
                  name_of(method).data(), dimension, fine.size(), shortest);
      EXPECT_LT(shortest, 0.15);
      EXPECT_LT(fine.size(), 100000u);
      std::size_t found = 0;
      for (const PlanePoint& p : fine) found += p == on_coast;
      EXPECT_EQ(found, 1u);
    }
  }
}

TEST(EdgeHardCases, ParametersOutOfRangeAreRefusedWithTheRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const CoastMethod method : scenes::every_method()) {
    const double greatest = greatest_dimension(method);
    EXPECT_EQ(refusal({.method = method, .dimension = greatest}), "");
    EXPECT_EQ(refusal({.method = method, .dimension = 1.0}), "");
    for (const double wrong : {nan, infinite, -infinite, 0.0, 1.0 - 1e-9, greatest + 1e-9, 2.0}) {
      const std::string text = refusal({.method = method, .dimension = wrong});
      EXPECT_NE(text.find("dimension is "), std::string::npos) << text;
      EXPECT_NE(text.find("1.000000 to " + std::to_string(greatest)), std::string::npos) << text;
    }
    for (const double wrong : {nan, infinite, -1e-9, 4.0 + 1e-9}) {
      const std::string text = refusal({.method = method, .dimension = 1.0, .amplitude = wrong});
      EXPECT_NE(text.find("amplitude"), std::string::npos) << text;
      EXPECT_NE(text.find("0.000000 to 4.000000"), std::string::npos) << text;
    }
    for (const double wrong : {nan, infinite, 1.0, 1.05 - 1e-9, 8.0 + 1e-9}) {
      const std::string text = refusal({.method = method, .dimension = 1.0, .gamma = wrong});
      EXPECT_NE(text.find("gamma"), std::string::npos) << text;
      EXPECT_NE(text.find("1.050000 to 8.000000"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace skerry::echo
