#include "echo/kernel/speckle_fade.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(SpeckleFade, MatchesItsReference) {
  std::vector<float> knots;
  for (int k = 0; k < 33; ++k) knots.push_back(0.01f * static_cast<float>(k * k));
  double worst = 0.0;
  std::vector<std::vector<float>> first;
  std::size_t isa = 0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      std::mt19937_64 random(n);
      std::normal_distribution<float> gauss;
      std::vector<std::vector<float>> rows(4, std::vector<float>(n));
      for (auto& row : rows) {
        for (float& v : row) v = gauss(random);
      }
      const FadingRows fading{rows[0].data(), rows[1].data(), rows[2].data(),
                              rows[3].data(), 0.8f,           0.6f};
      const RootLaw law{knots, 10.0f, 0.05f, 9.0f};
      std::vector<float> out(n);
      fade_speckle(fading, law, out);
      for (std::size_t i = 0; i < n; ++i) {
        worst = std::max(worst,
                         std::fabs(static_cast<double>(out[i]) - faded_reference(fading, law, i)));
      }
      if (isa == 0) {
        first.push_back(out);
      } else {
        EXPECT_EQ(out, first[n]);
      }
    }
    ++isa;
  });
  std::printf("worst error of fading: %.3g of the greatest knot\n", worst / 10.24);
  EXPECT_LE(worst / 10.24, 2e-6);
}

}  // namespace
}  // namespace skerry::echo
