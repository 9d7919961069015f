#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/measure/chord_offsets.hpp"
#include "echo/measure/coast_dimension.hpp"
#include "tests/unit/measure/exact_fbm.hpp"

namespace skerry::echo {
namespace {

using test::koch_curve;
using test::turned;

TEST(Divider, MeasuresAStraightLineWithEveryRuler) {
  const PlaneLine line = {{0.0, 0.0}, {300.0, 400.0}, {600.0, 800.0}, {3000.0, 4000.0}};
  const auto lengths = divider_lengths(line, 7.0, 1000.0);
  ASSERT_EQ(lengths.size(), 8u);
  EXPECT_DOUBLE_EQ(lengths.front().ruler_m, 7.0);
  EXPECT_NEAR(lengths.back().ruler_m, 1000.0, 1e-9);
  for (const RulerLength& l : lengths) EXPECT_NEAR(l.length_m, 5000.0, 1e-6);
  EXPECT_NEAR(divider_dimension(line, 7.0, 1000.0), 1.0, 1e-9);
}

TEST(Divider, StepsAlongASemicircleAreItsChords) {
  PlaneLine line;
  for (int i = 0; i <= 20000; ++i) {
    const double a = 3.14159265358979 * i / 20000.0;
    line.push_back({std::cos(a), std::sin(a)});
  }
  // From its beginning only: 6 chords of 30 deg.
  const double ruler = 2.0 * std::sin(3.14159265358979 / 12.0);
  const auto lengths = divider_lengths(PlaneLine{line.begin(), line.end()}, ruler, 2.0 * ruler);
  EXPECT_NEAR(lengths.front().length_m, 6.0 * ruler, 0.1 * ruler);
}

// SOURCES.md "Fractals" finds 1.304 +- 0.005 from one start; averaged over starts less is left of
// the bias.
TEST(Divider, FindsKochsDimensionWithinItsBias) {
  const auto line = koch_curve(7, 1.0);
  for (double longest : {1.0 / 27.0, 1.0 / 9.0, 1.0 / 4.0}) {
    const double found = divider_dimension(line, 1.0 / 500.0, longest);
    std::printf("Koch 1.262: divider to %.3f %.3f\n", longest, found);
    EXPECT_NEAR(found, std::log(4.0) / std::log(3.0), 0.045);
  }
}

TEST(Divider, IsTheSameInEveryDirection) {
  const auto line = koch_curve(6, 1000.0);
  const double found = divider_dimension(line, 5.0, 100.0);
  for (double degrees : {10.0, 45.0, 133.0, 280.0}) {
    EXPECT_NEAR(divider_dimension(turned(line, degrees), 5.0, 100.0), found, 1e-6);
  }
}

TEST(Divider, SaysNothingOfShortLinesAndBadRulers) {
  const PlaneLine line = {{0.0, 0.0}, {100.0, 0.0}};
  EXPECT_TRUE(std::isnan(divider_dimension(line, 10.0, 26.0)));
  EXPECT_FALSE(std::isnan(divider_dimension(line, 10.0, 25.0)));
  EXPECT_TRUE(std::isnan(divider_dimension(line, 0.0, 10.0)));
  EXPECT_TRUE(std::isnan(divider_dimension(line, 10.0, 10.0)));
  EXPECT_TRUE(std::isnan(divider_dimension({}, 1.0, 2.0)));
  EXPECT_TRUE(std::isnan(divider_dimension(line, 1e-9, 2.0)));  // 1e11 steps
  EXPECT_TRUE(divider_lengths(PlaneLine{{1.0, 1.0}}, 1.0, 2.0).empty());
}

TEST(Divider, DuplicateVerticesChangeNothing) {
  const auto line = koch_curve(5, 1000.0);
  PlaneLine doubled;
  for (PlanePoint p : line) doubled.insert(doubled.end(), 2, p);
  EXPECT_NEAR(divider_dimension(doubled, 10.0, 100.0), divider_dimension(line, 10.0, 100.0), 0.01);
}

TEST(ChordOffsets, OfASawAreItsTeeth) {
  // Teeth 100 long and 20 high; chords from foot to foot.
  PlaneLine line;
  for (int i = 0; i <= 80; ++i) line.push_back({50.0 * i, (i & 1) ? 20.0 : 0.0});
  const ChordOffsets found = chord_offsets(std::vector<PlaneLine>{line}, 100.0, 10.0);
  EXPECT_EQ(found.chords, 40u);
  EXPECT_NEAR(found.middle_rms, 0.2, 1e-9);
  EXPECT_NEAR(found.middle_error, 0.0, 1e-9);
  EXPECT_TRUE(std::isnan(found.graph_dimension));  // 10 steps
}

TEST(ChordOffsets, AreThoseOfTheMidpointsOfBrownianMotion) {
  // A low graph, so that chords lie along it: the middle of a bridge of length 1 has variance
  // 2^-2H - 1/4 (SOURCES.md "Fractals", RMD).
  for (double hurst : {0.6, 0.75, 0.9}) {
    double squares = 0.0;
    constexpr int kGraphs = 20;
    for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
      const auto h = test::exact_fbm(4096, hurst, seed);
      PlaneLine line;
      for (std::size_t i = 0; i < h.size(); ++i)
        line.push_back({100.0 * static_cast<double>(i), h[i]});
      const ChordOffsets found = chord_offsets(std::vector<PlaneLine>{line}, 6400.0, 100.0);
      squares += found.middle_rms * found.middle_rms / kGraphs;
    }
    const double expected = (std::exp2(-2.0 * hurst) - 0.25) * std::pow(64.0, 2.0 * hurst);
    // 20 graphs of 64 chords, nearly independent: the variance is off by sqrt(2 / 1280) = 4 %.
    EXPECT_NEAR(squares * 6400.0 * 6400.0 / expected, 1.0, 0.16) << hurst;
  }
}

TEST(ChordOffsets, FindTheDimensionOfALowGraph) {
  for (double dimension : {1.4, 1.25, 1.1}) {
    double sum = 0.0;
    constexpr int kGraphs = 20;
    for (std::uint64_t seed = 0; seed < kGraphs; ++seed) {
      const auto h = test::exact_fbm(4096, 2.0 - dimension, seed);
      PlaneLine line;
      for (std::size_t i = 0; i < h.size(); ++i)
        line.push_back({100.0 * static_cast<double>(i), h[i]});
      sum += chord_offsets(std::vector<PlaneLine>{line}, 51200.0, 100.0).graph_dimension;
    }
    std::printf("fBm %.2f: offsets from chords %.3f\n", dimension, sum / kGraphs);
    EXPECT_NEAR(sum / kGraphs, dimension, 0.05);
  }
}

TEST(ChordOffsets, RefuseLengthsThatAreNone) {
  const std::vector<PlaneLine> line = {{{0.0, 0.0}, {100.0, 0.0}}};
  EXPECT_THROW(chord_offsets(line, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(chord_offsets(line, 10.0, 0.0), std::invalid_argument);
  EXPECT_THROW(chord_offsets(line, 10.0, 0.001), std::invalid_argument);
  EXPECT_THROW(chord_offsets(line, std::nan(""), 1.0), std::invalid_argument);
  EXPECT_TRUE(std::isnan(chord_offsets(line, 80.0, 1.0).middle_rms));  // one chord
}

}  // namespace
}  // namespace skerry::echo
