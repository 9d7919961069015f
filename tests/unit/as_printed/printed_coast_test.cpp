#include "echo/fractal/as_printed/printed_coast.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "echo/kernel/hash.hpp"

namespace skerry::echo::as_printed {
namespace {

using testing::HasSubstr;
using Line = std::vector<PixelPoint>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Edges of 12 to 62 pixels in all directions.
Line wandering_line(int edges, std::uint64_t seed) {
  Line line{{500.0, 500.0}};
  for (int i = 0; i < edges; ++i) {
    const auto k = static_cast<std::uint64_t>(i);
    const double angle = 6.28 * as_unit(mixed(seed, k, 0));
    const double length = 12.0 + 50.0 * as_unit(mixed(seed, k, 1));
    line.push_back(
        {line.back().x_px + length * std::cos(angle), line.back().y_px + length * std::sin(angle)});
  }
  return line;
}

double length_of(const Line& line) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    sum += std::hypot(line[i + 1].x_px - line[i].x_px, line[i + 1].y_px - line[i].y_px);
  }
  return sum;
}

std::string refusal_of(const Line& line, const Parameters& parameters) {
  try {
    refine(line, parameters);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(PrintedCoast, MakesAsManyPointsAsThePaperCounts) {
  const int n = 37;
  const Line line = wandering_line(n, 1);
  for (int i = 1; i <= 8; ++i) {
    const std::size_t four = std::size_t{1} << (2 * i), two = std::size_t{1} << i;
    const auto count = [&](CoastMethod method) {
      return refine(line, {.method = method, .iterations = i, .control_value_px = 0.0}).size();
    };
    EXPECT_EQ(count(CoastMethod::random_koch), four * n + 1);
    EXPECT_EQ(count(CoastMethod::regular_koch), four * n + 1);
    EXPECT_EQ(count(CoastMethod::midpoint), two * n + 1);
    EXPECT_EQ(count(CoastMethod::weierstrass), two * n + 1);
    EXPECT_EQ(refine(line, {.method = CoastMethod::straight, .iterations = i}), line);
  }
}

TEST(PrintedCoast, ControlValueCutsLongKochEdgesFirst) {
  const Line line = {{0, 0}, {100, 0}, {114, 0}};  // 7 pieces of 14.3 pixels, and 1
  const Line koch = refine(line, {.iterations = 1});
  ASSERT_EQ(koch.size(), 4u * 8 + 1);
  for (int k = 0; k <= 7; ++k) EXPECT_NEAR(koch[4 * k].x_px, 100.0 * k / 7, 1e-12);
  EXPECT_EQ(refine(line, {.method = CoastMethod::midpoint, .iterations = 1}).size(), 5u);
}

TEST(PrintedCoast, KochLengthGrowsByAThirdEachIteration) {
  const Line line = wandering_line(20, 2);
  const double before = length_of(line);
  for (const CoastMethod method : {CoastMethod::regular_koch, CoastMethod::random_koch}) {
    for (const double c : {0.0, 15.0}) {
      for (int i = 1; i <= 6; ++i) {
        const Line koch = refine(line, {.method = method, .iterations = i, .control_value_px = c});
        const double expected = std::pow(4.0 / 3.0, i);
        // The rounding of 4^6 n sums and differences of doubles.
        EXPECT_NEAR(length_of(koch) / before / expected, 1.0, 1e-11);
      }
    }
  }
}

TEST(PrintedCoast, KochApexStandsOnEitherSideByChanceAndOnTheLeftInTheRegularCurve) {
  const Line line = {{0, 0}, {30, 0}};
  const double height = 30.0 * std::numbers::sqrt3 / 6.0;
  int left = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const Line koch = refine(line, {.iterations = 1, .seed = seed, .control_value_px = 0.0});
    EXPECT_NEAR(std::fabs(koch[2].y_px), height, 1e-12);
    left += koch[2].y_px < 0.0;
  }
  EXPECT_NEAR(left, 2000, 160);  // 5 sigma of a fair coin
  const Line low = refine(line, {.method = CoastMethod::regular_koch,
                                 .iterations = 1,
                                 .control_value_px = 0.0,
                                 .apex_factor = 0.5});
  EXPECT_NEAR(low[2].y_px, -0.5 * height, 1e-12);
}

TEST(PrintedCoast, AFinerIterationKeepsTheVerticesOfACoarserOne) {
  const Line line = wandering_line(9, 3);
  for (const CoastMethod method : {CoastMethod::regular_koch, CoastMethod::random_koch,
                                   CoastMethod::midpoint, CoastMethod::weierstrass}) {
    const Line coarse = refine(line, {.method = method, .iterations = 2, .seed = 5});
    const Line fine = refine(line, {.method = method, .iterations = 4, .seed = 5});
    const std::size_t step = (fine.size() - 1) / (coarse.size() - 1);
    for (std::size_t i = 0; i < coarse.size(); ++i) ASSERT_EQ(coarse[i], fine[i * step]);
    EXPECT_NE(fine, refine(line, {.method = CoastMethod::straight}));
  }
}

// A chart edge of unit length at `degrees` (from x toward y), refined with unit sigma 3 times; how
// far its 9 points lie from where the straight edge would have put them.
struct Deviation {
  double across = 0.0, along = 0.0;  // RMS
};
Deviation midpoint_deviation(double degrees, int runs) {
  const double a = degrees * std::numbers::pi / 180.0;
  const double ex = std::cos(a), ey = std::sin(a);
  const Line edge = {{0, 0}, {ex, ey}};
  Deviation sum;
  for (int run = 0; run < runs; ++run) {
    const Line fbm = refine(edge, {.method = CoastMethod::midpoint,
                                   .iterations = 3,
                                   .seed = static_cast<std::uint64_t>(run),
                                   .sigma_px = 1.0});
    for (std::size_t k = 0; k < 9; ++k) {
      const double dx = fbm[k].x_px - ex * static_cast<double>(k) / 8.0;
      const double dy = fbm[k].y_px - ey * static_cast<double>(k) / 8.0;
      sum.along += (dx * ex + dy * ey) * (dx * ex + dy * ey);
      sum.across += (dy * ex - dx * ey) * (dy * ex - dx * ey);
    }
  }
  return {std::sqrt(sum.across / (9.0 * runs)), std::sqrt(sum.along / (9.0 * runs))};
}

// The variance of h over the 9 points, summed by hand from eqs 3 to 5: point 1/2 has s1^2, 1/4 and
// 3/4 have s1^2/4 + s2^2, an odd eighth at the border a quarter of that + s3^2, one inside
// (s2/2)^2 + (3 s1/4)^2 + s3^2.
double expected_rms_of_h() {
  const auto s2 = [](int i) {
    return std::pow(2.0, -1.2 * i) * (1.0 - std::pow(2.0, 2.0 * 0.6 - 2.0));
  };
  const double quarter = s2(1) / 4.0 + s2(2);
  const double outer = quarter / 4.0 + s2(3);
  const double inner = s2(2) / 4.0 + 9.0 / 16.0 * s2(1) + s2(3);
  return std::sqrt((s2(1) + 2.0 * quarter + 2.0 * outer + 2.0 * inner) / 9.0);
}

TEST(PrintedCoast, MidpointsMoveAlongOneDiagonalOnly) {
  // SOURCES.md "Corrections 1": RMS across and along an edge by its direction.
  const struct {
    double degrees, across, along;
  } table[] = {
      {0, .318, .318}, {22.5, .171, .412}, {45, 0, .443}, {90, .317, .317}, {135, .450, 0}};
  const double rms = expected_rms_of_h();
  for (const auto& row : table) {
    const Deviation found = midpoint_deviation(row.degrees, 20000);
    std::printf("%5.1f deg: across %.4f along %.4f (C1: %.3f %.3f)\n", row.degrees, found.across,
                found.along, row.across, row.along);
    // The offset is h to x and to y: sqrt(2) h along 45 degrees.  20,000 runs with at least two
    // independent values each: relative sd of an RMS 1/sqrt(2 * 40,000) = 0.4 %; 4 sd.
    const double turned = (row.degrees - 45.0) * std::numbers::pi / 180.0;
    const double across = std::numbers::sqrt2 * rms * std::fabs(std::sin(turned));
    const double along = std::numbers::sqrt2 * rms * std::fabs(std::cos(turned));
    EXPECT_NEAR(found.across, across, 0.014 * across + 1e-12);
    EXPECT_NEAR(found.along, along, 0.014 * along + 1e-12);
    // The table itself was drawn by chance: 2 %.
    EXPECT_NEAR(found.across, row.across, 0.02 * row.across + 1e-12);
    EXPECT_NEAR(found.along, row.along, 0.02 * row.along + 1e-12);
  }
}

TEST(PrintedCoast, MidpointsFoldEdgesOfFortyFiveDegreesBackOnThemselves) {
  // SOURCES.md "Corrections 1": sigma/L 0.05, 0.1, 0.3, 1.0: 0, 0.4, 76, 100 % of the edges fold.
  const struct {
    double sigma, folded;
  } table[] = {{0.05, 0.0}, {0.1, 0.004}, {0.3, 0.76}, {1.0, 1.0}};
  const double root_half = std::sqrt(0.5);
  const Line edge = {{0, 0}, {root_half, root_half}};
  constexpr int kRuns = 4000;
  for (const auto& row : table) {
    int folded = 0;
    for (int run = 0; run < kRuns; ++run) {
      const Line fbm = refine(edge, {.method = CoastMethod::midpoint,
                                     .iterations = 3,
                                     .seed = static_cast<std::uint64_t>(run),
                                     .sigma_px = row.sigma});
      bool folds = false;
      for (std::size_t k = 0; k + 1 < fbm.size(); ++k) folds |= fbm[k + 1].x_px < fbm[k].x_px;
      folded += folds;
    }
    const double part = static_cast<double>(folded) / kRuns;
    std::printf("sigma/L %.2f: %.2f %% fold\n", row.sigma, 100.0 * part);
    EXPECT_NEAR(part, row.folded, 0.025);  // 3 sd of 4,000 trials, and of the table's
  }
}

TEST(PrintedCoast, SigmaIsTheDeviationOfTheHeightsOfThePoints) {
  const Line line = {{0, 10}, {5, 20}, {9, 30}, {2, 40}};
  EXPECT_NEAR(deviation_of_heights(line), std::sqrt(125.0), 1e-12);
  const Parameters by_heights{.method = CoastMethod::midpoint, .iterations = 2};
  Parameters given = by_heights;
  given.sigma_px = deviation_of_heights(line);
  EXPECT_EQ(refine(line, by_heights), refine(line, given));
  given.sigma_px = 1.0;
  EXPECT_NE(refine(line, by_heights), refine(line, given));
  EXPECT_EQ(deviation_of_heights({}), 0.0);
}

TEST(PrintedCoast, SeriesHasTheValuesComputedIndependently) {
  // n up to 60: to all digits of SOURCES.md "Fractals", and of the same sum in 50 decimal digits,
  // which the phases of doubles (1.5^60 * 2^-53 = 4e-6, weight 5e-6) keep to 1e-8.
  const Series w(Parameters{.terms_below = 60, .terms_above = 60});
  EXPECT_EQ(w.at(0.0), 0.0);
  EXPECT_NEAR(w.at(1.0), 5.75957, 5e-6);
  EXPECT_NEAR(w.at(1.5), 7.05402, 1e-5);
  EXPECT_NEAR(w.at(1.0), 5.75957286748241, 1e-8);
  EXPECT_NEAR(w.at(1.5), 7.05401504148145, 1e-8);
  // Up to the last that a double holds: within 2e-7 of W(1.5) = 1.5^0.5 W(1).
  const Series longest(Parameters{.terms_below = 60, .terms_above = 90});
  EXPECT_NEAR(longest.at(1.5) / longest.at(1.0), std::sqrt(1.5), 1e-7);
}

// Both functions are the limit over all n, which one with 2 g^(-h N)/(1 - g^-h) of its terms left
// out is near; multiplying t by gamma moves every term by one.
TEST(PrintedCoast, SeriesScalesByGammaToTheTwoMinusD) {
  for (const double gamma : {1.2, 1.5, 2.0, 3.0}) {
    for (const double dimension : {1.1, 1.3, 1.5, 1.7}) {
      const double h = 2.0 - dimension;
      const int above = static_cast<int>(38.0 / std::log2(gamma));  // phases below 2^40
      const Parameters p{
          .dimension = dimension, .gamma = gamma, .terms_below = 150, .terms_above = above};
      Parameters sines = p;
      sines.phases = SeriesPhases::alternating;
      const Series cosine(p), sine(sines);
      const double ratio = std::pow(gamma, h);
      const double tail =
          2.0 * std::pow(gamma, -h * above) / (1.0 - std::pow(gamma, -h)) * (1.0 + ratio);
      // Sines fall off below as g^(-(D-1) n) only.
      const double low = 4.0 * std::pow(gamma, -(dimension - 1.0) * 149) /
                         (1.0 - std::pow(gamma, -(dimension - 1.0)));
      for (double t = 0.1; t < 4.0; t *= 1.37) {
        EXPECT_NEAR(cosine.at(gamma * t), ratio * cosine.at(t), tail + 1e-6);
        EXPECT_NEAR(sine.at(gamma * t), -ratio * sine.at(t), tail + ratio * low * t + 1e-6);
        EXPECT_GE(cosine.at(t), 0.0);
        EXPECT_NEAR(sine.at(-t), -sine.at(t), 1e-9);
      }
    }
  }
}

TEST(PrintedCoast, TermsWhosePhaseADoubleCannotHoldCountNothing) {
  // 1.5^90 = 7e15 < 2^53 < 1.5^91.
  const auto w = [](int above) { return Series(Parameters{.terms_above = above}).at(1.0); };
  EXPECT_NE(w(89), w(90));
  for (const int above : {91, 100, 200, 300}) EXPECT_EQ(w(above), w(90));
  EXPECT_NEAR(w(300), w(60), 2.0 * std::pow(1.5, -30.5) / (1.0 - std::pow(1.5, -0.5)));
  for (const double t : {1e-300, 1e-9, 1e9, 1e15, 1e300, -1e300}) {
    EXPECT_TRUE(std::isfinite(Series(Parameters{.terms_above = 300}).at(t))) << t;
  }
}

TEST(PrintedCoast, SeriesBulgesEveryEdgeTheSameWayAndDoesNotJoin) {
  // Edges of one length in two directions; to the left of each (SOURCES.md "Corrections 9").
  const Line line = {{0, 0}, {100, 0}, {100, 100}};
  const Line w = refine(line, {.method = CoastMethod::weierstrass, .iterations = 8});
  const Series series(Parameters{});
  for (std::size_t k = 1; k < 256; ++k) {
    const double height = 5.0 * series.at(static_cast<double>(k) / 256.0);
    EXPECT_NEAR(-w[k].y_px, height, 1e-9);
    EXPECT_NEAR(w[256 + k].x_px - 100.0, height, 1e-9);
    EXPECT_GT(height, 0.0);
  }
  EXPECT_EQ(w[256], line[1]);
  EXPECT_GT(-w[255].y_px, 0.2 * 100.0);  // the step at the end: W(1) = 5.76, times 0.05
}

TEST(PrintedCoast, ThresholdLeavesShortEdgesAsTheyAre) {
  const Line line = wandering_line(60, 7);
  for (const CoastMethod method :
       {CoastMethod::random_koch, CoastMethod::midpoint, CoastMethod::weierstrass}) {
    Parameters p{.method = method, .iterations = 6, .control_value_px = 0.0, .sigma_px = 5.0};
    const std::size_t all = refine(line, p).size();
    p.threshold_px = 10.0;
    const Line improved = refine(line, p);
    EXPECT_LT(improved.size(), all / 4);
    EXPECT_GT(improved.size(), line.size());
    p.threshold_px = 70.0;  // the longest edge has 62 pixels
    EXPECT_EQ(refine(line, p), line);
  }
  // 30 -> 4 x 10, which is not longer than 10.
  const Parameters koch{.iterations = 8, .threshold_px = 10.000001, .control_value_px = 0.0};
  EXPECT_EQ(refine(Line{{0, 0}, {30, 0}}, koch).size(), 5u);
}

TEST(PrintedCoast, RefusesParametersOutOfRange) {
  const Line line = wandering_line(3, 8);
  const auto refused = [&](auto change, const char* name, const char* range) {
    Parameters p;
    change(p);
    EXPECT_THROW(require_valid(p), std::invalid_argument) << name;
    EXPECT_THAT(refusal_of(line, p), HasSubstr(name));
    EXPECT_THAT(refusal_of(line, p), HasSubstr(range));
  };
  for (const int i : {-1, 0, 9, 60}) {
    refused([&](Parameters& p) { p.iterations = i; }, "iterations", "1.000000 to 8.000000");
  }
  for (const double bad : {kNan, kInfinity, -kInfinity, -1.0}) {
    refused([&](Parameters& p) { p.threshold_px = bad; }, "L in pixels", "0.000000 to 1000000");
    refused([&](Parameters& p) { p.control_value_px = bad; }, "c in pixels", "1.000000 to 1000000");
    refused([&](Parameters& p) { p.apex_factor = bad; }, "apex factor", "0.000000 to 2.000000");
    refused([&](Parameters& p) { p.hurst = bad; }, "H is", "0.000000 to 1.000000");
    refused([&](Parameters& p) { p.sigma_px = bad; }, "sigma in pixels", "0.000000 to 1000000");
    refused([&](Parameters& p) { p.dimension = bad; }, "dimension", "1.000000 to 1.990000");
    refused([&](Parameters& p) { p.gamma = bad; }, "gamma", "1.010000 to 8.000000");
    refused([&](Parameters& p) { p.amplitude = bad; }, "amplitude", "0.000000 to 10.000000");
  }
  refused([](Parameters& p) { p.control_value_px = 0.5; }, "c in pixels", "1.000000 to 1000000");
  refused([](Parameters& p) { p.gamma = 1.0; }, "gamma", "1.010000 to 8.000000");
  refused([](Parameters& p) { p.dimension = 2.0; }, "dimension", "1.000000 to 1.990000");
  refused([](Parameters& p) { p.terms_above = 301; }, "terms above", "0.000000 to 300");
  refused([](Parameters& p) { p.terms_below = -1; }, "terms below", "0.000000 to 300");
  refused([](Parameters& p) { p.most_points = 100'000'001; }, "number of points", "100000000");
  refused([](Parameters& p) { p.phases = SeriesPhases::random; }, "phases", "alternating");
}

TEST(PrintedCoast, RefusesPointsThatAreNoPlaces) {
  for (const double bad : {kNan, kInfinity, -1.1e9}) {
    EXPECT_THAT(refusal_of({{0, 0}, {1, bad}}, {}), HasSubstr("point 1"));
    EXPECT_THAT(refusal_of({{bad, 0}, {1, 1}}, {}), HasSubstr("point 0"));
  }
}

TEST(PrintedCoast, NeverMakesMorePointsThanAllowed) {
  const Line line = wandering_line(100, 9);
  // 100 * 4^8 = 6.6 million: too many, and said before any is made.
  EXPECT_THAT(
      refusal_of(line, {.iterations = 8, .control_value_px = 0.0, .most_points = 6'553'600}),
      HasSubstr("6553601"));
  EXPECT_EQ(
      refine(line, {.iterations = 8, .control_value_px = 0.0, .most_points = 6'553'601}).size(),
      6'553'601u);
  // 10^9 pixels cut into pieces of 1 pixel, whatever the threshold.
  EXPECT_THROW(refine(Line{{0, 0}, {1e9, 0}}, {.threshold_px = 10.0, .control_value_px = 1.0}),
               std::length_error);
  // With a threshold the count is not known before.
  const Parameters improved{
      .iterations = 8, .threshold_px = 0.001, .control_value_px = 0.0, .most_points = 50'000};
  EXPECT_THAT(refusal_of(line, improved), HasSubstr("allowed: 50000"));
}

TEST(PrintedCoast, TakesEdgesOfAnyLength) {
  const Line hard = {{0, 0},      {0, 0},      {1e-6, 0}, {1e-6, 1e-9}, {1e9, -1e9},
                     {1e9, -1e9}, {-1e9, 1e9}, {0, 0},    {1e-300, 0}};
  for (const CoastMethod method :
       {CoastMethod::straight, CoastMethod::regular_koch, CoastMethod::random_koch,
        CoastMethod::midpoint, CoastMethod::weierstrass}) {
    for (const double threshold : {0.0, 1e6}) {
      for (const double hurst : {0.0, 1e-9, 0.6, 1.0}) {
        for (const double gamma : {1.01, 8.0}) {
          for (const double dimension : {1.0, 1.99}) {
            const Line out = refine(hard, {.method = method,
                                           .iterations = 4,
                                           .threshold_px = threshold,
                                           .control_value_px = 0.0,
                                           .hurst = hurst,
                                           .dimension = dimension,
                                           .gamma = gamma,
                                           .terms_above = 300});
            EXPECT_EQ(out.front(), hard.front());
            EXPECT_EQ(out.back(), hard.back());
            for (const PixelPoint& p : out) {
              ASSERT_TRUE(std::isfinite(p.x_px) && std::isfinite(p.y_px)) << name_of(method);
            }
          }
        }
      }
    }
    EXPECT_TRUE(refine({}, {.method = method}).empty());
    EXPECT_EQ(refine(Line{{3, 4}}, {.method = method}).size(), 1u);
  }
}

TEST(PrintedDisplay, MapsTheRangeOntoItsPixelsAndBack) {
  const Display display{{100.0, -50.0}, 463.0, 1000.0};
  EXPECT_EQ(display.to_pixel({100.0, -50.0}), (PixelPoint{500.0, 500.0}));
  const PixelPoint north = display.to_pixel({100.0, 413.0});
  EXPECT_NEAR(north.x_px, 500.0, 1e-9);
  EXPECT_NEAR(north.y_px, 0.0, 1e-9);
  const PlanePoint back = display.to_plane(display.to_pixel({321.5, 77.25}));
  EXPECT_NEAR(back.east_m, 321.5, 1e-9);
  EXPECT_NEAR(back.north_m, 77.25, 1e-9);
}

}  // namespace
}  // namespace skerry::echo::as_printed
