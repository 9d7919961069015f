#include "echo/measure/picture_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace skerry::echo {
namespace {

struct Point {
  double x, y;
};

// A turn on which the closed polygon echoes, from a radar at the origin, cells of 1 m.
std::vector<std::uint8_t> video_of(const std::vector<Point>& ring, std::uint32_t spokes,
                                   std::uint32_t cells) {
  std::vector<std::uint8_t> video(std::size_t{spokes} * cells, 0);
  std::vector<double> crossings;
  for (std::uint32_t s = 0; s < spokes; ++s) {
    const double bearing = (s + 0.5) * 2.0 * std::numbers::pi / spokes;
    const Point along{std::sin(bearing), std::cos(bearing)};
    crossings.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double side_a = along.x * a.y - along.y * a.x, side_b = along.x * b.y - along.y * b.x;
      if ((side_a > 0.0) == (side_b > 0.0)) continue;
      const double t = side_a / (side_a - side_b);
      crossings.push_back(along.x * (a.x + t * (b.x - a.x)) + along.y * (a.y + t * (b.y - a.y)));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const auto first = static_cast<std::uint32_t>(std::max(0.0, crossings[k]));
      const auto last =
          static_cast<std::uint32_t>(std::clamp(crossings[k + 1], 0.0, static_cast<double>(cells)));
      for (std::uint32_t c = first; c < last; ++c) video[std::size_t{s} * cells + c] = 255;
    }
  }
  return video;
}

std::vector<Point> koch_snowflake(Point middle, double radius, int depth) {
  std::vector<Point> ring;
  for (int i = 0; i < 3; ++i) {
    const double a = -i * 2.0 * std::numbers::pi / 3.0 + 0.3;
    ring.push_back({middle.x + radius * std::cos(a), middle.y + radius * std::sin(a)});
  }
  for (int d = 0; d < depth; ++d) {
    std::vector<Point> finer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const Point v{(b.x - a.x) / 3.0, (b.y - a.y) / 3.0};
      const double h = std::sqrt(3.0) / 2.0;
      finer.insert(finer.end(), {a,
                                 {a.x + v.x, a.y + v.y},
                                 {a.x + 1.5 * v.x - h * v.y, a.y + 1.5 * v.y + h * v.x},
                                 {a.x + 2.0 * v.x, a.y + 2.0 * v.y}});
    }
    ring = std::move(finer);
  }
  return ring;
}

std::vector<Point> disc(Point middle, double radius) {
  std::vector<Point> ring;
  for (int i = 0; i < 720; ++i) {
    const double a = i * std::numbers::pi / 360.0;
    ring.push_back({middle.x + radius * std::cos(a), middle.y + radius * std::sin(a)});
  }
  return ring;
}

constexpr std::uint32_t kOutlineSpokes = 4096, kOutlineCells = 1024;
PictureTurn turn_of(const std::vector<std::uint8_t>& video) {
  return {kOutlineSpokes, kOutlineCells, 1.0, 2.0, 255, video};
}

TEST(PictureOutline, OfADiscIsALineAndOfASnowflakeIsKochs) {
  const auto round = video_of(disc({30.0, 560.0}, 400.0), kOutlineSpokes, kOutlineCells);
  const auto flake =
      video_of(koch_snowflake({30.0, 560.0}, 400.0, 5), kOutlineSpokes, kOutlineCells);
  const OutlineDimension d = outline_dimensions(turn_of(round), {}, kOutlineCells).at_beam;
  const OutlineDimension k = outline_dimensions(turn_of(flake), {}, kOutlineCells).at_beam;
  std::printf("disc %.3f %.3f, snowflake %.3f %.3f (1, 1.262)\n", d.below, d.above, k.below,
              k.above);
  EXPECT_NEAR(d.below, 1.0, 0.04);
  EXPECT_NEAR(d.above, 1.0, 0.06);
  // Box counts of a Koch curve: 1.242 +- 0.007 (SOURCES.md "Fractals").
  EXPECT_NEAR(k.below, 1.242, 0.06);
  EXPECT_NEAR(k.above, 1.242, 0.06);
}

TEST(PictureOutline, LeavesTargetsAndSpecksOut) {
  const auto shore = video_of(disc({0.0, 700.0}, 250.0), kOutlineSpokes, kOutlineCells);
  auto busy = shore;
  for (std::uint32_t s = 2000; s < 2010; ++s) {
    for (std::uint32_t c = 500; c < 509; ++c) busy[std::size_t{s} * kOutlineCells + c] = 255;
  }
  const OutlineDimension with = outline_dimensions(turn_of(busy), {}, kOutlineCells).at_beam;
  const OutlineDimension without = outline_dimensions(turn_of(shore), {}, kOutlineCells).at_beam;
  EXPECT_NEAR(with.above, without.above, 0.01);
  // The rim's mean distance is 700 m and a little: sqrt(700^2 + 250^2) to first order.
  EXPECT_NEAR(without.beam_m, 2.0 * std::numbers::pi / 180.0 * 722.0, 0.3);
  EXPECT_EQ(outline_of(turn_of(busy), {}, 400.0).elements,
            outline_of(turn_of(shore), {}, 400.0).elements);
  EXPECT_GT(outline_of(turn_of(busy), {}, 1.0).elements.size(),
            outline_of(turn_of(shore), {}, 1.0).elements.size());
}

TEST(PictureOutline, TakesNothingOutsideTheWindowNorBelowTheThreshold) {
  auto video = video_of(disc({0.0, 700.0}, 250.0), kOutlineSpokes, kOutlineCells);
  const std::size_t all = outline_of(turn_of(video), {}, 1.0).elements.size();
  EXPECT_GT(all, 1000u);
  EXPECT_EQ(outline_of(turn_of(video), {.from_deg = 60.0, .to_deg = 300.0}, 1.0).elements.size(),
            0u);
  EXPECT_EQ(outline_of(turn_of(video), {.from_deg = 300.0, .to_deg = 60.0}, 1.0).elements.size(),
            all);
  for (auto& cell : video) cell = cell > 0 ? 100 : 0;
  EXPECT_EQ(outline_of(turn_of(video), {.threshold = 0.5}, 1.0).elements.size(), 0u);
  EXPECT_EQ(outline_of(turn_of(video), {.threshold = 0.3}, 1.0).elements.size(), all);
}

TEST(PictureOutline, OfAnEmptyPictureIsNotANumber) {
  const std::vector<std::uint8_t> nothing(std::size_t{kOutlineSpokes} * kOutlineCells, 0);
  const OutlineDimensions d = outline_dimensions(turn_of(nothing), {}, kOutlineCells);
  EXPECT_TRUE(std::isnan(d.at_beam.below));
  EXPECT_TRUE(std::isnan(d.recorded.above));
  EXPECT_TRUE(d.local.empty());
}

TEST(PictureOutline, RefusesATurnThatContradictsItself) {
  const std::vector<std::uint8_t> few(10, 0);
  EXPECT_THROW(outline_dimensions(turn_of(few), {}, kOutlineCells), std::invalid_argument);
  const std::vector<std::uint8_t> right(std::size_t{kOutlineSpokes} * kOutlineCells, 0);
  EXPECT_THROW(outline_dimensions(turn_of(right), {.threshold = 0.0}, kOutlineCells),
               std::invalid_argument);
  EXPECT_THROW(outline_dimensions(turn_of(right), {.from_m = 10.0, .to_m = 10.0}, kOutlineCells),
               std::invalid_argument);
  PictureTurn bad = turn_of(right);
  bad.cell_m = std::nan("");
  EXPECT_THROW(outline_dimensions(bad, {}, kOutlineCells), std::invalid_argument);
  bad = turn_of(right);
  bad.spokes = 1u << 31;
  EXPECT_THROW(outline_dimensions(bad, {}, kOutlineCells), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::echo
