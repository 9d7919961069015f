#include "echo/coast_tool/coast_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "echo/chart/gshhg_reader.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "tests/unit/measure/exact_fbm.hpp"

namespace skerry::echo {
namespace {

using testing::HasSubstr;

const Telling kSilent = [](const std::string&) {};

CoastLines coast_of(PlaneLine line) {
  CoastLines coast;
  coast.length_m = length_of(line);
  coast.edges = line.size() - 1;
  coast.mean_spacing_m = coast.median_spacing_m = coast.p90_spacing_m =
      coast.length_m / static_cast<double>(coast.edges);
  coast.lines.push_back(std::move(line));
  return coast;
}

TEST(CoastFit, FindsKochsDimensionAndAmplitude) {
  // 729 km, pieces of 111 m.
  const CoastLines coast = coast_of(test::koch_curve(8, 729000.0));
  const CoastMeasurement m = measure_coast(coast, 200.0, 6400.0, kSilent);
  const double koch = std::log(4.0) / std::log(3.0);
  EXPECT_NEAR(m.box.dimension, koch, 0.03);
  EXPECT_NEAR(m.divider.dimension, koch, 0.045);
  for (const ScaleDimension& octave : m.octaves) EXPECT_NEAR(octave.dimension, koch, 0.12);
  // Much the same at all scales, a little by how a chord falls on the pieces.
  ASSERT_GE(m.chords.size(), 5u);
  for (const ChordOffsets& c : m.chords) EXPECT_NEAR(c.middle_rms, 0.29, 0.1) << c.chord_m;
  const Range95 below = dimension_at(m, 50.0);
  EXPECT_LT(below.low, koch);
  EXPECT_GT(below.high, koch);
  EXPECT_LT(below.high - below.low, 0.5);
}

TEST(CoastFit, IsLessSureTheFartherBelowTheChart) {
  PlaneLine line;
  const auto h = test::exact_fbm(8192, 0.8, 5);
  for (std::size_t i = 0; i < h.size(); ++i)
    line.push_back({50.0 * static_cast<double>(i), 40.0 * h[i]});
  const CoastMeasurement m = measure_coast(coast_of(line), 100.0, 3200.0, kSilent);
  double last_d = 0.0, last_o = 0.0;
  for (double scale : {400.0, 100.0, 25.0, 6.0}) {
    const Range95 d = dimension_at(m, scale), o = offset_at(m, scale);
    EXPECT_GE(d.low, 1.0);
    EXPECT_LE(d.low, d.value);
    EXPECT_LE(d.value, d.high);
    EXPECT_GE(d.high - d.low, last_d);
    EXPECT_GT(std::log(o.high / o.low), last_o);
    last_d = d.high - d.low;
    last_o = std::log(o.high / o.low);
  }
}

// A chart that knows a coast to 2 km: what it says of 1 km and 500 m holds for the finer one.
TEST(CoastFit, ExtrapolatesOffsetsAsTheFinerCoastHasThem) {
  int within = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    PlaneLine fine, coarse;
    const auto h = test::exact_fbm(16384, 0.85, seed);
    for (std::size_t i = 0; i < h.size(); ++i) {
      fine.push_back({50.0 * static_cast<double>(i), 20.0 * h[i]});
      if (i % 16 == 0) coarse.push_back(fine.back());
    }
    const CoastMeasurement known = measure_coast(coast_of(coarse), 800.0, 12800.0, kSilent);
    const CoastMeasurement truth = measure_coast(coast_of(fine), 200.0, 3200.0, kSilent);
    for (const ChordOffsets& c : truth.chords) {
      if (c.chord_m > 800.0) break;
      const Range95 said = offset_at(known, c.chord_m);
      within += said.low < c.middle_rms && c.middle_rms < said.high;
      ++all;
    }
  }
  EXPECT_EQ(all, 24);
  EXPECT_GE(within, 20);  // 95 % of 24 is 22.8; 4 or more outside: below 3 %
}

TEST(CoastFit, BeginsWhereTheChartDoes) {
  const auto finest = [](double spacing) {
    CoastLines coast;
    coast.median_spacing_m = spacing;
    return finest_scale_m(coast);
  };
  EXPECT_EQ(finest(96.0), 100.0);
  EXPECT_EQ(finest(150.0), 100.0);
  EXPECT_EQ(finest(584.0), 400.0);
  EXPECT_EQ(finest(9.0), 6.25);
  EXPECT_EQ(finest(9000.0), 6400.0);
}

TEST(CoastFit, RefusesTooLittleCoastAndBoxesFinerThanTheChart) {
  const CoastLines coast = coast_of({{0.0, 0.0}, {1000.0, 0.0}, {2000.0, 500.0}});
  try {
    measure_coast(coast, 100.0, 3200.0, kSilent);
    FAIL();
  } catch (const TooLittleCoast& error) {
    EXPECT_THAT(error.what(), HasSubstr("fewer than 8 boxes of 400 m"));
    EXPECT_THAT(error.what(), HasSubstr("--from"));
  }
  try {
    measure_coast(coast, 1.0, 32.0, kSilent);
    FAIL();
  } catch (const TooLittleCoast& error) {
    EXPECT_THAT(error.what(), HasSubstr("finer than the chart's own edges"));
  }
  EXPECT_THROW(measure_coast({}, 100.0, 3200.0, kSilent), TooLittleCoast);
}

TEST(StyleChoice, TakesTheMethodThatReachesTheDimension) {
  EXPECT_EQ(choose_style(1.004, 0.1, {}).style.method, CoastMethod::straight);
  EXPECT_EQ(choose_style(1.1, 0.1, {}).style.method, CoastMethod::random_koch);
  EXPECT_EQ(choose_style(1.33, 0.1, {}).style.method, CoastMethod::midpoint);
  for (double dimension : {0.9, 1.0, 1.01, 1.1, 1.1749, 1.1751, 1.33, 1.6}) {
    for (int method = -1; method < static_cast<int>(coast_methods().size()); ++method) {
      const auto wanted = method < 0 ? std::nullopt : std::optional(CoastMethod(method));
      const ChosenStyle chosen = choose_style(dimension, 0.1, wanted, 4);
      EXPECT_NO_THROW(require_valid(chosen.style));
      EXPECT_FALSE(chosen.words.empty());
      EXPECT_EQ(chosen.style.method, wanted.value_or(chosen.style.method));
    }
  }
}

TEST(StyleChoice, ClampsWithAWord) {
  const ChosenStyle rough = choose_style(1.62, 0.1, {});
  EXPECT_EQ(rough.style.dimension, 1.5);
  EXPECT_THAT(rough.words, testing::Contains(HasSubstr("1.62 is beyond the 1.5 of midpoint")));
  const ChosenStyle koch = choose_style(1.33, 0.1, CoastMethod::random_koch);
  EXPECT_EQ(koch.style.dimension, greatest_dimension(CoastMethod::random_koch));
  EXPECT_THAT(koch.words, testing::Contains(HasSubstr("is beyond")));
  EXPECT_THAT(choose_style(0.95, 0.1, CoastMethod::midpoint).words,
              testing::Contains(HasSubstr("below that of a line")));
}

TEST(StyleChoice, EdgesStandOutAsMeasured) {
  constexpr int kEdges = 64;
  for (CoastMethod method : {CoastMethod::random_koch, CoastMethod::midpoint}) {
    for (double offset : {0.03, 0.06, 0.09}) {
      const ChosenStyle chosen = choose_style(1.15, offset, method, kEdges);
      // Amplitude in hundredths, of at least 0.1.
      EXPECT_NEAR(chosen.offset_made / offset, 1.0, 0.06);
      EXPECT_NEAR(offset_of(chosen.style, kEdges), chosen.offset_made, 1e-12);
    }
    const ChosenStyle most = choose_style(1.15, 2.0, method, kEdges);
    EXPECT_LT(most.offset_made, 0.35);
    EXPECT_THAT(most.words, testing::Contains(HasSubstr("more has no room")));
  }
  EXPECT_THAT(choose_style(1.2, std::nan(""), {}).words,
              testing::Contains(HasSubstr("too few chords")));
}

// SOURCES.md "Shorelines", GSHHG full.  It counted boxes at points a quarter of a box apart, which
// misses corners: 0.01 less in D than the exact count here.  Bound: the standard errors of both.
TEST(CoastFit, FindsThePublishedDimensionsOfRealCoasts) {
  const std::filesystem::path file = "/usr/share/gmt-gshhg/binned_GSHHS_f.nc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file << " (gmt-gshhg-full)";
  const GshhgReader reader = GshhgReader::open(file);
  struct Case {
    const char* place;
    double dimension, error, median_m, length_km;
  };
  // The limits of the last two are not stated there: their lengths differ.
  for (const Case& c :
       {Case{"bergen", 1.329, 0.038, 96.0, 1937.0}, Case{"plymouth", 1.129, 0.020, 149.0, 238.0},
        Case{"dalian", 1.066, 0.011, 118.0, 483.0}, Case{"solent", 1.142, 0.020, 149.0, 0.0},
        Case{"vaettern", 1.017, 0.013, 584.0, 0.0}}) {
    const CoastArea area = named_place(c.place);
    const CoastLines coast =
        coast_lines(reader.load(area.centre(), area.radius()), LocalPlane(area.centre()), area);
    const CoastMeasurement m = measure_coast(coast, 100.0, 3200.0, kSilent);
    std::printf("%-8s D %.3f +- %.3f (%.3f +- %.3f), %.0f km\n", c.place, m.box.dimension,
                m.box.standard_error, c.dimension, c.error, coast.length_m / 1000.0);
    EXPECT_NEAR(m.box.dimension, c.dimension, c.error + m.box.standard_error) << c.place;
    EXPECT_NEAR(coast.median_spacing_m, c.median_m, 4.0) << c.place;
    if (c.length_km > 0.0) {
      EXPECT_NEAR(coast.length_m / 1000.0, c.length_km, 0.01 * c.length_km) << c.place;
    }
  }
}

}  // namespace
}  // namespace skerry::echo
