#include "echo/kernel/splat_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(SplatRow, MatchesItsReference) {
  std::mt19937 random(11);
  const auto unit = [&] { return static_cast<float>(random() % 2000) * 1e-3f - 1.0f; };
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t width = 1; width <= 67; ++width) {
      for (const std::size_t count : {1u, 2u, 9u, 40u}) {
        std::vector<std::vector<float>> shares;
        std::vector<SplatPoint> points;
        for (std::size_t p = 0; p < count; ++p) {
          const auto cell =
              static_cast<std::uint32_t>(random() % width / kSplatLanes * kSplatLanes);
          const auto cells = static_cast<std::uint32_t>(1 + random() % (width - cell));
          std::vector<float> own((cells + kSplatLanes - 1) / kSplatLanes * kSplatLanes, 0.0f);
          for (std::uint32_t c = 0; c < cells; ++c) own[c] = unit() * unit();
          shares.push_back(std::move(own));
          points.push_back({shares.back().data(), cell, cells, 1e3f * unit(), 1e3f * unit()});
        }
        std::vector<float> row(width, 1.0f), scratch(2 * (width + kSplatLanes), 7.0f);
        std::vector<double> exact(width, 1.0);
        add_voltages_reference(points, exact);
        add_voltages(points, scratch, row);
        // Against the power of all voltages in phase.
        for (std::size_t i = 0; i < width; ++i) {
          double sum = 0.0;
          for (const SplatPoint& p : points)
            if (i >= p.cell && i < p.cell + p.cells)
              sum += std::fabs(static_cast<double>(p.shares[i - p.cell])) *
                     std::hypot(static_cast<double>(p.in_phase), static_cast<double>(p.quadrature));
          worst = std::max(worst,
                           std::fabs(static_cast<double>(row[i]) - exact[i]) / (1.0 + sum * sum));
        }
      }
    }
  });
  std::printf("worst error, of the power of all in phase: %.3g\n", worst);
  EXPECT_LE(worst, 1e-6);
}

}  // namespace
}  // namespace skerry::echo
