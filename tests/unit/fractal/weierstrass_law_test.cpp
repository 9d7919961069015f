// The Weierstrass-Mandelbrot function: its scaling law, and the edge's series against the plain
// sum.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "echo/fractal/weierstrass_series.hpp"
#include "echo/kernel/isa.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

TEST(WeierstrassSeries, HasTheKnownValues) {
  // SOURCES.md "Fractals": gamma = D = 1.5 up to n = 60.
  const WeierstrassSeries sixty{.first = -60, .last = 60};
  EXPECT_NEAR(weierstrass(sixty, 1.0), 5.75957, 5e-6);
  EXPECT_NEAR(weierstrass(sixty, 1.5), 7.05402, 6e-6);
  // All terms, summed in quadruple precision; here the sum ends at n = 90, where phases pass 2^53.
  const WeierstrassSeries all{.first = -80, .last = 150};
  const double tail = high_tail_bound(1.5, 1.5, 89);
  EXPECT_NEAR(weierstrass(all, 1.0), 5.759592896270, tail);
  EXPECT_NEAR(weierstrass(all, 1.5), 7.054031861010, tail);
  EXPECT_LT(tail, 2e-7);
}

// W(gamma t) = gamma^(2-D) W(t) to within what the ends of the sum leave out.
TEST(WeierstrassSeries, ScalesAsItsLawSays) {
  double worst = 0.0, worst_bound = 0.0;
  for (const double gamma : {1.05, 1.2, 1.5, 2.0, 3.7, 8.0}) {
    for (const double dimension : {1.05, 1.15, 1.3, 1.5}) {
      const double octaves = std::log2(gamma);
      const int last = static_cast<int>(30.0 / octaves);
      for (const SeriesPhases phases : {SeriesPhases::cosine, SeriesPhases::alternating}) {
        const bool sine = phases == SeriesPhases::alternating;
        // The sine series' low terms fall off as gamma^((D-1) n) only.
        const int first = -static_cast<int>((sine ? 480.0 : 60.0) / octaves);
        const WeierstrassSeries series{gamma, dimension, phases, 0, first, last};
        for (double t = 0.01; t < 3.0; t *= 1.7) {
          const double scaled = std::pow(gamma, 2.0 - dimension) * weierstrass(series, t);
          const double got = (sine ? -1.0 : 1.0) * weierstrass(series, gamma * t);
          const double low = sine ? gamma * t * std::pow(gamma, (dimension - 1.0) * first) /
                                        (1.0 - std::pow(gamma, 1.0 - dimension))
                                  : low_tail_bound(gamma, dimension, first, gamma * t);
          const double bound = 2.0 * (high_tail_bound(gamma, dimension, last - 1) + low) + 1e-8;
          ASSERT_LE(std::fabs(got - scaled), bound) << gamma << " " << dimension << " " << t;
          worst = std::max(worst, std::fabs(got - scaled));
          worst_bound = std::max(worst_bound, bound);
        }
      }
    }
  }
  std::printf("worst deviation from the law %.2g, largest bound %.2g\n", worst, worst_bound);
  EXPECT_LT(worst_bound, 0.1);
}

TEST(WeierstrassSeries, TailsAreBounded) {
  // SOURCES.md "Fractals", gamma = D = 1.5.
  EXPECT_NEAR(high_tail_bound(1.5, 1.5, 10), 1.172, 0.001);
  EXPECT_NEAR(high_tail_bound(1.5, 1.5, 20), 0.154, 0.001);
  EXPECT_NEAR(high_tail_bound(1.5, 1.5, 30), 0.0203, 0.0001);
  EXPECT_NEAR(low_tail_bound(1.5, 1.5, -5, 1.0), 0.0285, 0.0001);
  EXPECT_NEAR(low_tail_bound(1.5, 1.5, -10, 1.0), 0.00136, 0.00001);
  EXPECT_NEAR(low_tail_bound(1.5, 1.5, -20, 1.0), 3.1e-6, 0.05e-6);
  for (const SeriesPhases phases : {SeriesPhases::cosine, SeriesPhases::random}) {
    for (double t = 0.1; t < 2.0; t += 0.37) {
      const WeierstrassSeries all{1.5, 1.5, phases, 3, -60, 80};
      WeierstrassSeries few = all;
      few.last = 12;
      EXPECT_LE(std::fabs(weierstrass(all, t) - weierstrass(few, t)),
                high_tail_bound(1.5, 1.5, 12));
    }
  }
  const WeierstrassSeries all{1.5, 1.5, SeriesPhases::cosine, 0, -60, 20};
  WeierstrassSeries few = all;
  few.first = -8;
  EXPECT_LE(weierstrass(all, 1.3) - weierstrass(few, 1.3), low_tail_bound(1.5, 1.5, -8, 1.3));
}

TEST(WeierstrassSeries, StandsManyTermsAndHugePhases) {
  for (const double gamma : {1.0000001, 1.05, 1.5, 8.0, 1e6}) {
    for (const SeriesPhases phases :
         {SeriesPhases::cosine, SeriesPhases::alternating, SeriesPhases::random}) {
      const WeierstrassSeries sixty{gamma, 1.5, phases, 9, 0, 59};
      const WeierstrassSeries thousands{gamma, 1.5, phases, 9, -3000, 3000};
      for (const double t : {0.0, 1e-300, 1e-9, 1.0, 1e9, 1e300}) {
        EXPECT_TRUE(std::isfinite(weierstrass(sixty, t)));
        EXPECT_TRUE(std::isfinite(weierstrass(thousands, t))) << gamma << " " << t;
      }
      EXPECT_EQ(weierstrass(sixty, 0.0), 0.0);
    }
  }
}

// The edge's function is the plain sum in turns, less the line between its ends, made by turning
// phasors: no error but rounding, at any level.
TEST(WeierstrassEdge, IsThePlainSumLessTheLineBetweenItsEnds) {
  double worst = 0.0;
  for (const double gamma : {1.05, 1.5, 8.0}) {
    for (const SeriesPhases phases :
         {SeriesPhases::cosine, SeriesPhases::alternating, SeriesPhases::random}) {
      const CoastStyle style{CoastMethod::weierstrass, 1.3, 1.0, gamma, phases};
      const samples::Bridges bridges(style);
      const WeierstrassTables& tables = bridges.weierstrass();
      const int terms = tables.terms(5e5, 1e5);
      constexpr std::uint64_t kSeed = 12;
      const std::vector<double> got = bridges.bridge(kSeed, 12, terms);
      const auto slow = [&](long double t) {
        long double sum = 0.0L;
        for (int k = 0; k < terms; ++k) {
          const int n = tables.first + k;
          long double phase = 0.0L;
          if (phases == SeriesPhases::alternating) {
            phase = std::numbers::pi_v<long double> * (n - 0.5L);
          }
          if (phases == SeriesPhases::random) {
            phase = random_phase(kSeed, n) * (2.0L * std::numbers::pi_v<long double> / 0x1p32L);
          }
          const long double turns =
              static_cast<long double>(tables.waves[static_cast<std::size_t>(k)]) * t;
          sum += static_cast<long double>(tables.amplitude[static_cast<std::size_t>(k)]) *
                 std::cos(2.0L * std::numbers::pi_v<long double> * (turns - std::floor(turns)) +
                          phase);
        }
        return sum;
      };
      const long double at_0 = slow(0.0L), at_1 = slow(1.0L);
      long double side = 0.0L;
      for (std::size_t i = 1; i < 4096; i += 7) {
        const long double t = static_cast<long double>(i) / 4096.0L;
        const long double want = slow(t) - ((1.0L - t) * at_0 + t * at_1);
        if (side == 0.0L)
          side = phases == SeriesPhases::random || want * got[i] > 0.0L ? 1.0L : -1.0L;
        worst = std::max(worst, static_cast<double>(std::fabs(side * want - got[i])));
      }
    }
  }
  std::printf("worst deviation from the plain sum %.2g of the middle's spread\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(WeierstrassEdge, IsTheSameOnEveryInstructionSet) {
  const samples::Bridges bridges({.method = CoastMethod::weierstrass, .dimension = 1.2});
  const Isa before = active_isa();
  force_isa(Isa::baseline);
  const std::vector<double> want = bridges.bridge(3, 10, 37);
  for (const Isa isa : {Isa::avx2, Isa::avx512}) {
    force_isa(isa);
    EXPECT_EQ(bridges.bridge(3, 10, 37), want) << name_of(active_isa());
  }
  force_isa(before);
}

// The terms left out would have moved the coast by less than kFinest_m where that ended the
// series; where their waves are shorter than kFinest_m no more than the bound says.
TEST(WeierstrassEdge, TermsLeftOutStandOutByLessThanTheBound) {
  for (const double dimension : {1.05, 1.15, 1.3, 1.5}) {
    for (const double length : {20.0, 150.0, 3000.0}) {
      const samples::Bridges bridges({.method = CoastMethod::weierstrass, .dimension = dimension});
      const GrowingEdge edge{{0, 0}, {length, 0}, 5, kMaxHalfAngleTan};
      const OffsetGraph graph(bridges.graph(), edge);
      const WeierstrassTables& tables = bridges.weierstrass();
      const int terms = tables.terms(length, graph.most_gain_m());
      const auto last = static_cast<std::size_t>(terms) - 1;
      const bool by_amplitude = tables.waves[last + 1] * WeierstrassTables::kFinest_m < length;
      double worst = 0.0;
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<double> few = bridges.bridge(seed, 9, terms);
        const std::vector<double> many = bridges.bridge(seed, 9, terms + 10);
        for (std::size_t i = 1; i < 512; ++i) {
          const double t = static_cast<double>(i) / 512.0;
          const PlanePoint a = graph.vertex(t, few[i]).at, b = graph.vertex(t, many[i]).at;
          worst = std::max(worst, length_of(a - b));
        }
      }
      const double h = 2.0 - dimension;
      const double bound = 2.0 * graph.most_gain_m() * tables.amplitude[last] * std::pow(1.5, -h) /
                           (1.0 - std::pow(1.5, -h));
      std::printf("D %.2f, %4.0f m: %2d terms leave out at most %.3f m (bound %.3f)\n", dimension,
                  length, terms, worst, bound);
      EXPECT_LE(worst, bound);
      if (by_amplitude) {
        EXPECT_LE(worst, WeierstrassTables::kFinest_m);
      }
    }
  }
}

// Over random phases the middle stands off by 1 rms, and bends grow as lag^2H.
TEST(WeierstrassEdge, HasTheVarianceOfTheBridge) {
  constexpr int kCurves = 2000;
  for (const double gamma : {1.05, 1.5, 3.0, 8.0}) {
    for (const double dimension : {1.02, 1.15, 1.5}) {
      const samples::Bridges bridges(
          {.method = CoastMethod::weierstrass, .dimension = dimension, .gamma = gamma});
      double squares = 0.0;
      for (std::uint64_t seed = 0; seed < kCurves; ++seed) {
        squares += std::pow(
            bridges.bridge(mixed(seed, 8), 1, bridges.weierstrass().terms(1e5, 1e5))[1], 2.0);
      }
      // Standard error of a variance of 2000: 3.2 %; the terms below kLowTail lack.
      std::printf("gamma %.2f D %.2f: variance of the middle %.3f\n", gamma, dimension,
                  squares / kCurves);
      EXPECT_NEAR(squares / kCurves, 1.0, 4.0 * 0.032 + 0.05);
    }
  }
}

}  // namespace
}  // namespace skerry::echo
