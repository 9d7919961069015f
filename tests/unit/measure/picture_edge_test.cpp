#include "echo/measure/picture_edge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/kernel/hash.hpp"
#include "echo/measure/picture_score.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kSpokes = 360, kCells = 500;

struct Video {
  std::vector<std::uint8_t> cells = std::vector<std::uint8_t>(std::size_t{kSpokes} * kCells, 0);
  void fill(std::uint32_t spoke, std::uint32_t begin, std::uint32_t end, std::uint8_t value = 200) {
    for (std::uint32_t c = begin; c < end; ++c) cells[std::size_t{spoke} * kCells + c] = value;
  }
  PictureTurn turn() const { return {kSpokes, kCells, 2.0, 1.2, 255, cells}; }
};

TEST(PictureEdge, FirstEchoIsTheFirstThatIsNoSpeck) {
  Video video;
  video.fill(3, 50, 57);  // 14 m: a speck
  video.fill(3, 100, 140);
  video.fill(3, 141, 160);  // one silent cell between
  video.fill(3, 200, 220);
  video.fill(4, 90, 100, 100);  // below the threshold
  const auto echoes = first_echoes(video.turn(), {});
  ASSERT_EQ(echoes.size(), kSpokes);
  EXPECT_EQ(echoes[3].begin, 100u);
  EXPECT_EQ(echoes[3].end, 160u);
  EXPECT_EQ(echoes[3].last, 220u);
  EXPECT_EQ(echoes[4].begin, FirstEcho::kNone);
}

TEST(PictureEdge, StatisticsAreThoseOfAKnownCoast) {
  Video video;
  for (std::uint32_t s = 0; s < kSpokes; ++s) {
    const std::uint32_t begin = s < 180 ? 100 : 200;  // two jumps of 200 m, one at the bow
    video.fill(s, begin, begin + 20 + s % 2);
  }
  const EdgeStatistics e = edge_statistics(video.turn(), {});
  EXPECT_EQ(e.spokes, kSpokes);
  EXPECT_DOUBLE_EQ(e.mean_range_m, 300.0);
  EXPECT_DOUBLE_EQ(e.thickness_m[0], 40.0);
  EXPECT_DOUBLE_EQ(e.thickness_m[4], 42.0);
  EXPECT_NEAR(e.within_a_cell, 358.0 / 359.0, 1e-12);
  EXPECT_NEAR(e.jumps, 1.0 / 359.0, 1e-12);
  // Through the bow, and only the quiet half.
  const EdgeStatistics half = edge_statistics(video.turn(), {.from_deg = 181.0, .to_deg = 358.0});
  EXPECT_EQ(half.spokes, 178u);
  EXPECT_DOUBLE_EQ(half.within_a_cell, 1.0);
  const EdgeStatistics across = edge_statistics(video.turn(), {.from_deg = 350.0, .to_deg = 9.0});
  EXPECT_EQ(across.spokes, 20u);
  EXPECT_NEAR(across.jumps, 1.0 / 19.0, 1e-12);
}

TEST(PictureEdge, OfNothingIsNotANumber) {
  const Video video;
  const EdgeStatistics e = edge_statistics(video.turn(), {});
  EXPECT_EQ(e.spokes, 0u);
  EXPECT_TRUE(std::isnan(e.mean_range_m));
  EXPECT_TRUE(std::isnan(e.thickness_m[2]));
  EXPECT_TRUE(std::isnan(e.within_a_cell));
}

// A moving average of w independent values correlates by 1 - lag / w.
TEST(PictureCorrelation, OfAMovingAverageFallsInAStraightLine) {
  Video video;
  constexpr std::uint32_t kWidth = 8;
  const auto noise = [](std::uint32_t spoke, std::uint32_t cell) {
    return as_unit(mixed(7, spoke * 100000ull + cell));
  };
  for (std::uint32_t s = 0; s < kSpokes; ++s) {
    for (std::uint32_t c = 0; c < kCells; ++c) {
      double sum = 0.0;
      for (std::uint32_t k = 0; k < kWidth; ++k) sum += noise(s + k, c);
      video.fill(s, c, c + 1, static_cast<std::uint8_t>(1.0 + 250.0 * sum / kWidth));
    }
  }
  const PictureCorrelation c = picture_correlation(video.turn(), {});
  // 180 000 pairs, neighbours dependent over 8: standard error under 0.01.
  EXPECT_NEAR(c.spoke[0], 7.0 / 8.0, 0.02);
  EXPECT_NEAR(c.spoke[1], 6.0 / 8.0, 0.02);
  EXPECT_NEAR(c.spoke[2], 4.0 / 8.0, 0.03);
  EXPECT_NEAR(c.spoke[3], 0.0, 0.03);
  EXPECT_NEAR(c.range[0], 0.0, 0.02);

  // Bearings without an echo are not counted, and the mean of turns takes turn-to-turn noise away.
  Video other = video;
  for (std::size_t i = 0; i < other.cells.size(); i += 3) other.cells[i] = 0;
  EXPECT_NEAR(picture_correlation(other.turn(), {}).spoke[0], 7.0 / 8.0, 0.02);
  Video noisy = video, opposite = video;
  for (std::size_t i = 0; i < noisy.cells.size(); ++i) {
    const int swing = static_cast<int>(as_unit(mixed(9, i)) * 40.0);
    noisy.cells[i] = static_cast<std::uint8_t>(std::clamp(noisy.cells[i] + swing - 20, 1, 255));
    opposite.cells[i] =
        static_cast<std::uint8_t>(std::clamp(opposite.cells[i] - swing + 20, 1, 255));
  }
  const PictureTurn both[] = {noisy.turn(), opposite.turn()};
  EXPECT_LT(picture_correlation(noisy.turn(), {}).spoke[0], 0.8);
  EXPECT_NEAR(mean_picture_correlation(both, {}, 1.0).spoke[0], 7.0 / 8.0, 0.02);
}

}  // namespace
}  // namespace skerry::echo
