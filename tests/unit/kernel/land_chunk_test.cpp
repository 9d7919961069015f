#include "echo/kernel/land_chunk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

constexpr double kTwiceEarth = 2.0 * 6371000.0 * 4.0 / 3.0;

TEST(LandChunk, NoObjectsAndAGainOfOneAreNoCover) {
  LandChunk c;
  c.first = 64;
  c.end = 32;
  c.cell = 10.0f;
  c.range = 645.0f;
  c.from_end = 2000.0f;
  c.horizon = 18'000.0f;
  std::array<float, kLandChunk + 1> noise;
  for (std::size_t k = 0; k < noise.size(); ++k) noise[k] = std::sin(static_cast<float>(k));
  c.broad = c.fine = noise.data();
  LandChunkOut bare{}, covered{};
  float bare_shadow = -1e9f, covered_shadow = -1e9f;
  make_land_chunk(c, bare_shadow, bare);
  std::array<float, kLandChunk> objects{}, gains;
  gains.fill(1.0f);
  c.objects = objects.data();
  c.gains = gains.data();
  make_land_chunk(c, covered_shadow, covered);
  EXPECT_EQ(bare_shadow, covered_shadow);
  for (std::size_t k = 0; k < kLandChunk; ++k) {
    EXPECT_EQ(bare.power[k], covered.power[k]);
    EXPECT_EQ(bare.shadow[k], covered.shadow[k]);
    EXPECT_EQ(bare.height[k], covered.height[k]);
  }
}

TEST(LandChunk, MatchesItsReference) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst_height = 0.0, worst_shown = 0.0;
  std::vector<LandChunkOut> first;
  std::vector<float> shadows;
  std::size_t isa = 0;
  on_every_isa([&] {
    random.seed(5);
    for (std::size_t round = 0; round < 400; ++round) {
      LandChunk c;
      c.cell = static_cast<float>(1.0 + 40.0 * unit(random));
      c.first = static_cast<std::int32_t>(32 * (1 + random() % 30));
      c.begin = static_cast<std::int32_t>(random() % 16);
      c.end = 16 + static_cast<std::int32_t>(random() % 17);
      c.range = c.cell * (static_cast<float>(c.first) + 0.5f);
      c.from_begin =
          static_cast<float>(3000.0 * unit(random)) - c.cell * static_cast<float>(c.begin);
      c.from_end = static_cast<float>(3000.0 * unit(random)) + 32.0f * c.cell;
      c.half_curvature = static_cast<float>(1.0 / kTwiceEarth);
      c.horizon = static_cast<float>(std::sqrt(kTwiceEarth * 20.0));
      c.gain = 1e9f;
      c.coarse_shift = static_cast<std::int32_t>(random() % 6);
      std::array<float, kLandChunk + 1> broad, fine;
      for (float& v : broad) v = static_cast<float>(2.0 * unit(random) - 1.0);
      for (float& v : fine) v = static_cast<float>(1.6 * unit(random) - 0.8);
      c.broad = broad.data();
      c.fine = fine.data();
      const LatticePath path{100.0 * unit(random), 3.0, 0.0, 50.0, 9.0, 0.0};
      const OctavePath octave = octave_path(path, {52.0, 0.2f}, 9, 2);
      c.octaves = &octave;
      c.octave_count = 1;
      // Every third round under a cover.
      std::array<float, kLandChunk> objects, gains;
      for (float& v : objects) v = static_cast<float>(15.0 * unit(random));
      for (float& v : gains) v = static_cast<float>(0.1 + 2.0 * unit(random));
      if (round % 3 == 0) {
        c.objects = objects.data();
        c.gains = gains.data();
      }

      double all_broad[kLandChunk], all_fine[kLandChunk], height[kLandChunk], power[kLandChunk];
      const int step = 1 << c.coarse_shift;
      for (int k = 0; k < static_cast<int>(kLandChunk); ++k) {
        const auto at = static_cast<std::size_t>(k / step);
        const double t = static_cast<double>(k % step) / step;
        const auto joined = [&](const auto& v) {
          return static_cast<double>(v[at]) +
                 t * (static_cast<double>(v[at + 1]) - static_cast<double>(v[at]));
        };
        all_broad[k] = joined(broad);
        all_fine[k] = joined(fine) + static_cast<double>(octave_at(octave, c.first + k));
      }
      LandChunkOut out{};
      float shadow = round % 2 ? -1e9f : static_cast<float>(-0.02 * unit(random));
      double exact_shadow = static_cast<double>(shadow);
      make_land_chunk(c, shadow, out);
      make_land_chunk_reference(c, all_broad, all_fine, exact_shadow, height, power);
      for (int k = 0; k < static_cast<int>(kLandChunk); ++k) {
        const double range = static_cast<double>(c.range) + k * static_cast<double>(c.cell);
        if (k < c.begin || k >= c.end) {
          EXPECT_EQ(out.power[k], 0.0f);
          continue;
        }
        worst_height =
            std::max(worst_height, std::fabs(static_cast<double>(out.height[k]) - height[k]));
        const double cover = std::exp2(static_cast<double>(kCoverOctaves) * all_fine[k]);
        const double shown = (static_cast<double>(out.power[k]) - power[k]) * range * range *
                             range / 1e9 / cover /
                             (c.gains ? static_cast<double>(c.gains[k]) : 1.0);
        worst_shown = std::max(worst_shown, std::fabs(shown) / range);
      }
      EXPECT_NEAR(static_cast<double>(shadow), exact_shadow, 1e-6);
      if (isa == 0) {
        first.push_back(out);
        shadows.push_back(shadow);
      } else {
        for (std::size_t k = 0; k < kLandChunk; ++k) {
          ASSERT_EQ(out.power[k], first[round].power[k]);
          ASSERT_EQ(out.shadow[k], first[round].shadow[k]);
          ASSERT_EQ(out.height[k], first[round].height[k]);
        }
        ASSERT_EQ(shadow, shadows[round]);
      }
    }
    ++isa;
  });
  std::printf("heights off by %.3g m, what shows by %.3g of the range\n", worst_height,
              worst_shown);
  EXPECT_LE(worst_height, 1e-3);
  EXPECT_LE(worst_shown, 1e-6);
}

TEST(LandChunk, CoverIsThePowerOfTwoItSays) {
  double worst = 0.0;
  for (float x = -1.0f; x <= 1.0f; x += 0.001f) {
    const double exact = std::exp2(static_cast<double>(kCoverOctaves * x));
    worst = std::max(worst, std::fabs(static_cast<double>(cover_of(x)) / exact - 1.0));
  }
  std::printf("cover off by %.3g\n", worst);
  EXPECT_LE(worst, 4e-6);
}

}  // namespace
}  // namespace skerry::echo
