#include "echo/kernel/video_stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

std::vector<std::uint8_t> any_video(std::size_t cells, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> video(cells);
  for (auto& v : video) v = static_cast<std::uint8_t>(random() % 3 == 0 ? 0 : random() % 256);
  return video;
}

// Three spokes at once: none may know of the one before it.
constexpr std::size_t kTogether = 3;

TEST(VideoStages, DifferentiationIsWithinItsBound) {
  double worst = 0.0, square = 0.0, count = 0.0;
  on_every_isa([&] {
    std::vector<std::uint8_t> scratch;
    for (std::size_t n : {1u, 2u, 33u, 67u, 300u, 2000u}) {
      for (unsigned octaves = 0; octaves <= 11; ++octaves) {
        for (unsigned weight : {0u, 1u, 128u, 200u, 256u}) {
          const auto before = any_video(kTogether * n, static_cast<std::uint32_t>(n) + octaves);
          auto video = before;
          std::vector<double> exact(n);
          differentiate_video(video, n, octaves, weight, scratch);
          for (std::size_t i = 0; i < kTogether * n; ++i) {
            if (i % n == 0)
              differentiate_video_reference(std::span(before).subspan(i, n), octaves, weight,
                                            exact);
            const double error = std::fabs(video[i] - exact[i % n]);
            ASSERT_LE(error, (octaves + 1) / 2.0 + 1e-9) << n << ' ' << octaves << ' ' << weight;
            worst = std::max(worst, error);
            square += error * error, count += 1.0;
          }
        }
      }
    }
  });
  std::printf("differentiation: worst %.2f video steps, rms %.2f\n", worst,
              std::sqrt(square / count));
  EXPECT_LE(std::sqrt(square / count), 0.5);
}

TEST(VideoStages, StretchIsTheLargestOfItsNeighbours) {
  on_every_isa([&] {
    std::vector<std::uint8_t> scratch;
    for (std::size_t n = 1; n <= 67; ++n) {
      for (unsigned reach = 0; reach <= kMaxStretch; ++reach) {
        const auto before = any_video(kTogether * n, static_cast<std::uint32_t>(n));
        auto video = before;
        std::vector<std::uint8_t> exact(kTogether * n);
        stretch_video(video, n, reach, scratch);
        for (std::size_t s = 0; s < kTogether * n; s += n)
          stretch_video_reference(std::span(before).subspan(s, n), reach,
                                  std::span(exact).subspan(s, n));
        EXPECT_EQ(video, exact) << n << ' ' << reach;
      }
    }
  });
}

TEST(VideoStages, SmoothingIsTheMeanOfMeansWithinHalfAStep) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> scratch;
  on_every_isa([&] {
    for (const std::size_t cells : {16u, 63u, 64u, 200u}) {
      for (unsigned together = 1; together <= kMostSmoothed; ++together) {
        std::vector<std::uint8_t> video(3 * cells);
        for (auto& v : video) v = random() % 2 ? static_cast<std::uint8_t>(random() % 256) : 255;
        const std::vector<std::uint8_t> before = video;
        smooth_video(video, cells, together, scratch);
        for (std::size_t s = 0; s < video.size(); s += cells) {
          std::vector<double> exact(cells);
          smooth_video_reference(std::span(before).subspan(s, cells), together, exact);
          for (std::size_t i = 0; i < cells; ++i)
            EXPECT_NEAR(video[s + i], exact[i], together == 1 ? 0.0 : 0.51) << i << " " << together;
        }
      }
    }
  });
}

TEST(VideoStages, TheLargestIsKeptAndFourBitsAreTheUpperHalf) {
  on_every_isa([&] {
    for (std::size_t n : {1u, 64u, 67u, 1000u}) {
      auto video = any_video(n, 1);
      const auto first = video, a = any_video(n, 2), b = any_video(n, 3);
      keep_largest(video, a, b);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(video[i], std::max({first[i], a[i], b[i]}));
      const auto eight = video;
      halve_bits(video);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(video[i], eight[i] / 16);
    }
  });
}

}  // namespace
}  // namespace skerry::echo
