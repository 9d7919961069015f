#include "echo/returns/natural_land.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/returns/shore_returns.hpp"

namespace skerry::echo {
namespace {

LandModel model_of(double cell_m) { return {cell_m, 20.0, 0.0015, 1e15, 9}; }

// Heights where they show, against both noises at every cell.
TEST(NaturalLand, CoarseNoiseStaysInItsBound) {
  double worst = 0.0;
  int cells = 0;
  for (const double cell : {1.36, 5.4, 10.85, 43.4, 170.0}) {
    for (std::uint32_t k = 0; k < 16; ++k) {
      const LandModel model = model_of(cell);
      const LatticePath path = lattice_path({60.0, 5.0}, {}, k << 28, cell);
      std::vector<float> power(1024, 0.0f);
      GroundProfile profile;
      profile.clear(1024);
      const LandInterval land{40.0 * cell, 1000.0 * cell};
      add_land({&land, 1}, model, path, power, &profile);
      for (std::uint32_t i = 0; i < 1024; ++i) {
        const auto height = static_cast<double>(profile.height_m[i]);
        if (height <= 0.0) continue;
        float broad, fine;
        relief_noise(path, broad_octaves(cell), model.seed, i, {&broad, 1});
        relief_noise(path, fine_octaves(cell), model.seed ^ kFineSeed, i, {&fine, 1});
        const double middle = (i + 0.5) * cell;
        const double inland = std::max(0.0, std::min(middle - land.begin_m, land.end_m - middle));
        worst = std::max(worst, std::fabs(height - land_height(inland, static_cast<double>(broad),
                                                               static_cast<double>(fine))));
        ++cells;
      }
    }
  }
  std::printf("joined noise: %d cells' heights off by %.2f m at most\n", cells, worst);
  EXPECT_GT(cells, 5000);
  EXPECT_LE(worst, 1.0);
}

TEST(NaturalLand, ShadowsAreThoseOfTheHighestSlopeBefore) {
  const double cell = 10.85;
  const LandModel model = model_of(cell);
  for (std::uint32_t k = 0; k < 16; ++k) {
    const LatticePath path = lattice_path({60.0, 5.0}, {}, k << 28, cell);
    std::vector<float> power(1024, 0.0f);
    GroundProfile profile;
    profile.clear(1024);
    const std::vector<LandInterval> land = {{900.0, 2500.0}, {4000.0, 9000.0}};
    add_land(land, model, path, power, &profile);
    double shadow = -1e9;
    for (std::size_t i = 0; i < 1024; ++i) {
      EXPECT_NEAR(static_cast<double>(profile.shadow[i]), std::max(shadow, -1e9),
                  1e-6 + (shadow < -1e8 ? 1.0 : 0.0));
      const auto height = static_cast<double>(profile.height_m[i]);
      const double range = (static_cast<double>(i) + 0.5) * cell;
      if (height > 0.0)
        shadow = std::max(shadow, (height - 20.0) / range - range / (2.0 * kEffectiveEarth));
      // Whatever stands out echoes, and nothing else does.
      if (power[i] > 0.0f) {
        EXPECT_GT(height, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace skerry::echo
