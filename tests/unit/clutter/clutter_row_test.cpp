#include "echo/kernel/clutter_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "echo/clutter/gamma_law.hpp"
#include "echo/clutter/lattice_field.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/rain_row.hpp"
#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

// In [low, high), of a key and an index.
float value_of(std::uint64_t key, std::size_t i, double low, double high) {
  return static_cast<float>(low + (high - low) * as_unit(mixed(key, i)));
}
std::vector<float> row_of(std::uint64_t key, std::size_t n, double low, double high) {
  std::vector<float> row(n);
  for (std::size_t i = 0; i < n; ++i) row[i] = value_of(key, i, low, high);
  return row;
}

TEST(ClutterRow, WalksToTheNearestValues) {
  const std::vector<float> ring = row_of(1, kLatticeSize, -3.0, 3.0);
  const std::vector<std::uint32_t> packed = packed_ring(ring);
  FieldWalk a, b;
  a = {123456, 0.3f, 0.7f, 1.37321f, -0.61234f, 0.8f};
  b = {77, 0.9f, 0.1f, -2.23607f, 3.31662f, 0.6f};
  std::vector<float> first;
  on_every_isa([&] {
    for (std::size_t n : {0, 1, 2, 15, 16, 17, 33, 67, 1000}) {
      std::vector<float> out(n);
      std::vector<double> exact(n);
      walk_field(packed, kLatticeStep, a, b, 0, out);
      walk_field_reference(ring, kLatticeStep, a, b, exact);
      std::size_t off = 0;
      for (std::size_t i = 0; i < n; ++i)
        off += std::fabs(out[i] - exact[i]) > 0.5 * kPackedStep * (0.8 + 0.6) + 1e-5;
      // A few of a thousand places are within 1e-3 of half-way.
      EXPECT_LE(off, n / 100);
      if (n == 1000) {
        if (first.empty()) first = out;
        EXPECT_EQ(out, first);
      }
    }
  });
}

TEST(ClutterRow, TextureIsThatOfItsReference) {
  double worst = 0.0;
  std::vector<float> kept;
  on_every_isa([&] {
    for (const std::size_t n : {1, 2, 31, 32, 33, 67, 1000}) {
      const std::vector<float> first = row_of(2, n, -4.6, 4.6), second = row_of(3, n, -4.6, 4.6);
      const std::vector<float> apart2 = row_of(4, n, 0.0, 4000.0), spread = row_of(5, n, 0.0, 1.0);
      std::vector<RankLaw> laws;
      for (std::size_t k = 0; k <= n / kSamplesPerLaw; ++k) {
        laws.push_back(gamma_law(0.1 * std::pow(300.0, value_of(6, k, 0.0, 1.0))));
      }
      for (const float share : {0.0f, 0.2f, 0.5f, 1.0f}) {
        TextureMix mix;
        mix.first = first, mix.second = second, mix.share = share;
        mix.apart2 = apart2, mix.decay = 0.001f;
        mix.spread = spread, mix.spread_share = -0.7f;
        std::vector<float> out(n);
        std::vector<double> exact(n);
        texture_octaves(mix, laws, out);
        texture_octaves_reference(mix, laws, exact);
        for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::fabs(out[i] - exact[i]));
        if (n == 1000 && share == 0.2f) {
          if (kept.empty()) kept = out;
          EXPECT_EQ(out, kept);
        }
      }
    }
  });
  std::printf("worst error %.2g octaves\n", worst);
  EXPECT_LE(worst, 3e-3);
}

TEST(ClutterRow, WaveIsThatOfItsReference) {
  double worst = 0.0;
  std::vector<float> kept;
  on_every_isa([&] {
    for (const std::size_t n : {1, 31, 32, 33, 67, 1000}) {
      std::vector<WaveBlock> blocks;
      for (std::size_t k = 0; k <= n / kSamplesPerLaw; ++k) {
        blocks.push_back({value_of(1, k, 0.0, 2.0), 0.3f, value_of(2, k, -0.25, 0.25)});
      }
      std::vector<float> out(n, 1.0f);
      std::vector<double> exact(n, 1.0);
      add_wave(blocks, 0.37f, -0.0713f, 0, out);
      add_wave_reference(blocks, double{0.37f}, double{-0.0713f}, exact);
      for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::fabs(out[i] - exact[i]));
      if (n == 1000) {
        if (kept.empty()) kept = out;
        EXPECT_EQ(out, kept);
      }
    }
  });
  std::printf("worst error %.2g octaves of 2\n", worst);
  EXPECT_LE(worst, 2.0 * 1.2e-3);
}

TEST(ClutterRow, LaysTextureAsItsReference) {
  double worst = 0.0;
  std::vector<float> kept;
  on_every_isa([&] {
    for (const std::uint32_t cells : {1u, 2u, 4u, 8u, 16u}) {
      for (std::size_t n = 1; n <= 67; ++n) {
        const std::vector<float> mean = row_of(1, n, 1e-3, 1e6);
        const std::vector<float> octaves = row_of(2, n / cells + 2, -14.0, 8.0);
        std::vector<float> spoilt = octaves, row(n, -1.0f);
        std::vector<double> exact(n);
        lay_texture(spoilt, cells, mean, row);
        lay_texture_reference(octaves, cells, mean, exact);
        for (std::size_t i = 0; i < n; ++i) {
          worst = std::max(worst, std::fabs(row[i] - exact[i]) / (exact[i] + 1e-30));
        }
        if (n == 67 && cells == 4) {
          if (kept.empty()) kept = row;
          EXPECT_EQ(row, kept);
        }
      }
    }
  });
  std::printf("worst relative error %.2g\n", worst);
  EXPECT_LE(worst, 3e-5);
}

TEST(ClutterRow, LeavesNoDenormalsBehind) {
  std::vector<float> octaves(64, -60.0f), row(40, 5.0f);
  const std::vector<float> mean(40, 1e-3f);
  lay_texture(octaves, 1, mean, row);
  for (const float v : row) EXPECT_EQ(v, 0.0f);
}

TEST(ClutterRow, AddsSpeckledClutterToPowerOfTheCellsAskedFor) {
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      const std::vector<float> a = row_of(1, n, 0.0, 9.0), b = row_of(2, n, 0.0, 9.0);
      const std::vector<float> drawn = row_of(3, n, 0.0, 5.0);
      std::vector<PackedPower> speckle(n);
      std::transform(drawn.begin(), drawn.end(), speckle.begin(), packed_value);
      for (std::size_t begin = 0; begin <= n; begin += 3) {
        for (std::size_t end = begin; end <= n; ++end) {
          std::vector<float> power(n, 2.0f);
          add_speckled(a, b, 0.25f, speckle, power, begin, end);
          for (std::size_t i = 0; i < n; ++i) {
            const float all = 2.0f + (0.75f * a[i] + 0.25f * b[i]) * unpacked_value(speckle[i]);
            ASSERT_FLOAT_EQ(power[i], i >= begin && i < end ? all : 2.0f) << begin << " " << end;
          }
        }
      }
    }
  });
}

TEST(ClutterRow, RainAddsItsEchoAndDimsWhatItHolds) {
  std::vector<float> kept;
  on_every_isa([&] {
    for (const std::size_t step : {1, 2, 4, 8, 16}) {
      for (std::size_t n = 1; n <= 67; ++n) {
        const std::vector<float> echoes = row_of(1, n / step + 2, 0.0, 50.0);
        const std::vector<float> left = row_of(2, n / step + 2, 0.1, 1.0);
        const std::vector<float> level = row_of(3, n, 0.1, 100.0), speckle = row_of(4, n, 0.1, 5.0);
        const std::vector<float> before = row_of(5, n, 0.0, 1e4);
        std::vector<float> power = before;
        pass_rain(echoes, left, step, level, speckle, power);
        for (std::size_t i = 0; i < n; ++i) {
          const std::size_t j = i / step;
          const double part = static_cast<double>(i % step) / static_cast<double>(step);
          const double e = echoes[j] + part * (double{echoes[j + 1]} - echoes[j]);
          const double t = left[j] + part * (double{left[j + 1]} - left[j]);
          const double exact = (before[i] + double{level[i]} * e * speckle[i]) * t;
          ASSERT_NEAR(power[i], exact, 1e-6 * exact) << step << " " << i;
        }
        if (n == 67 && step == 4) {
          if (kept.empty()) kept = power;
          EXPECT_EQ(power, kept);
        }
      }
    }
  });
}

}  // namespace
}  // namespace skerry::echo
