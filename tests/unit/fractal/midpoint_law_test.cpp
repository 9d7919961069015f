// Midpoint displacement against the law of fractional Brownian motion.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "tests/unit/fractal/davies_harte.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

constexpr double kHursts[] = {0.5, 0.6, 0.75, 0.85, 0.9, 0.98};

// A mean over many curves, and its standard error from their scatter.
class Mean {
 public:
  void add(double x) {
    ++n_;
    sum_ += x;
    squares_ += x * x;
  }
  double value() const { return sum_ / n_; }
  double error() const { return std::sqrt((squares_ / n_ - value() * value()) / (n_ - 1.0)); }

 private:
  double n_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

// No chance in it: the covariances of all vertices of five levels, carried from level to level.
TEST(MidpointLaw, EveryIncrementHasTheVarianceOfFractionalBrownianMotion) {
  double worst = 0.0;
  for (const double hurst : kHursts) {
    const FractionalBridge bridge(hurst);
    const MidpointTables tables(bridge);
    std::vector<double> at;
    for (int i = -5; i <= 6; ++i) at.push_back(i);
    std::vector<std::vector<double>> covariance(at.size(), std::vector<double>(at.size()));
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = 0; j < at.size(); ++j)
        covariance[i][j] = bridge.covariance(at[i], at[j]);
    }
    double step = 1.0;
    for (int level = 0; level < 5; ++level, step *= 0.5) {
      // Old vertices with two neighbours on either side, and the middles between them.
      const std::size_t old = at.size(), count = 2 * (old - 3) - 1;
      std::vector<std::vector<double>> rows(count, std::vector<double>(old));
      std::vector<double> places(count);
      for (std::size_t r = 0; r < count; ++r) {
        const std::size_t i = r / 2 + 1;
        places[r] = r % 2 ? 0.5 * (at[i] + at[i + 1]) : at[i];
        if (r % 2) {
          rows[r][i - 1] = rows[r][i + 2] = tables.far;
          rows[r][i] = rows[r][i + 1] = tables.near;
        } else {
          rows[r][i] = 1.0;
        }
      }
      std::vector<std::vector<double>> half(count, std::vector<double>(old));
      for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t j = 0; j < old; ++j) {
          for (std::size_t i = 0; i < old; ++i) half[r][j] += rows[r][i] * covariance[i][j];
        }
      }
      std::vector<std::vector<double>> next(count, std::vector<double>(count));
      const double scale = std::pow(step, 2.0 * hurst);
      const double own = tables.own, beside = tables.next;
      for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t c = 0; c < count; ++c) {
          for (std::size_t j = 0; j < old; ++j) next[r][c] += half[r][j] * rows[c][j];
          if (r % 2 == 0 || c % 2 == 0) continue;
          const std::size_t apart = (r > c ? r - c : c - r) / 2;
          if (apart == 0) next[r][c] += scale * (own * own + 2.0 * beside * beside);
          if (apart == 1) next[r][c] += scale * 2.0 * own * beside;
          if (apart == 2) next[r][c] += scale * beside * beside;
        }
      }
      covariance = std::move(next);
      at = std::move(places);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = i + 1; j < at.size() && j <= i + 32; ++j) {
        if (at[i] < 0.0 || at[j] > 1.0) continue;
        // The variance of the motion's increment: the bridge's and what its lost trend adds, both
        // over the v of FractionalBridge::increment().
        const double lag = at[j] - at[i];
        const double got = covariance[i][i] + covariance[j][j] - 2.0 * covariance[i][j];
        const double want = bridge.covariance(at[i], at[i]) + bridge.covariance(at[j], at[j]) -
                            2.0 * bridge.covariance(at[i], at[j]);
        const double v = 1.0 / (std::pow(0.5, 2.0 * hurst) - 0.25);
        worst = std::max(worst, std::fabs(got - want) / (v * std::pow(lag, 2.0 * hurst)));
      }
    }
  }
  std::printf("worst error of an increment's variance: %.2f %%\n", 100.0 * worst);
  EXPECT_LT(worst, 0.005);
}

// 600 curves against 600 exact ones.  Tolerance: four standard errors of the difference, taken from
// the curves' own scatter, and the 0.5 % of the test above.
TEST(MidpointLaw, VarianceAndDimensionAreThoseOfDaviesHarte) {
  constexpr int kDepth = 10, kOctaves = 6, kCurves = 600;
  for (const double hurst : kHursts) {
    const samples::Bridges bridges({.method = CoastMethod::midpoint, .dimension = 2.0 - hurst});
    samples::DaviesHarte exact(1u << kDepth, hurst, 11);
    const double middle = 1.0 / std::sqrt(std::pow(0.5, 2.0 * hurst) - 0.25);
    Mean made_variogram[kOctaves], exact_variogram[kOctaves], made_dimension, exact_dimension;
    Mean made_profile[4], exact_profile[4];
    for (std::uint64_t seed = 0; seed < kCurves; ++seed) {
      const auto take = [&](const std::vector<double>& b, Mean(&variogram)[kOctaves],
                            Mean& dimension, Mean(&profile)[4]) {
        std::vector<double> v;
        for (int k = 0; k < kOctaves; ++k) {
          v.push_back(samples::bend_variogram(b, k));
          variogram[k].add(v.back());
        }
        dimension.add(samples::dimension_of(v));
        for (std::size_t k = 0; k < 4; ++k) profile[k].add(std::pow(b[b.size() >> (k + 1)], 2.0));
      };
      take(bridges.bridge(mixed(seed, 77), kDepth, 0), made_variogram, made_dimension,
           made_profile);
      std::vector<double> path = exact.path();
      const double end = path.back();
      for (std::size_t i = 0; i < path.size(); ++i) {
        path[i] = middle * (path[i] - end * static_cast<double>(i) * half_to_the(kDepth));
      }
      take(path, exact_variogram, exact_dimension, exact_profile);
    }
    std::printf("H %.2f: D %.4f (exact %.4f +- %.4f); bends made/exact", hurst,
                made_dimension.value(), exact_dimension.value(), exact_dimension.error());
    const auto close = [&](const Mean& made, const Mean& reference, double bias) {
      EXPECT_NEAR(made.value(), reference.value(),
                  bias + 4.0 * std::hypot(made.error(), reference.error()))
          << "H " << hurst;
    };
    for (int k = 0; k < kOctaves; ++k) {
      std::printf(" %.3f", made_variogram[k].value() / exact_variogram[k].value());
      close(made_variogram[k], exact_variogram[k], 0.02 * exact_variogram[k].value());
    }
    std::printf("; variance at 1/2, 1/4, 1/8, 1/16");
    for (int k = 0; k < 4; ++k) {
      std::printf(" %.3f", made_profile[k].value() / exact_profile[k].value());
      close(made_profile[k], exact_profile[k], 0.005 * exact_profile[k].value());
    }
    std::printf("\n");
    close(made_dimension, exact_dimension, 0.001);
    EXPECT_NEAR(exact_dimension.value(), 2.0 - hurst, 0.01);  // the estimator itself
  }
}

// Plain midpoint displacement has 8 to 15 % more variance across its newest vertices than across
// older ones (SOURCES.md "Fractals"), which shows as creases.
TEST(MidpointLaw, HasNoCreases) {
  for (const double hurst : {0.6, 0.75, 0.9}) {
    const samples::Bridges bridges({.method = CoastMethod::midpoint, .dimension = 2.0 - hurst});
    Mean ratio;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      const std::vector<double> b = bridges.bridge(mixed(seed, 5), 11, 0);
      double across[2] = {0.0, 0.0};
      for (std::size_t i = 512; i < 1536; ++i) {
        across[i % 2] += std::pow(b[i + 1] - b[i - 1], 2.0);
      }
      ratio.add(across[1] / across[0]);
    }
    std::printf("H %.2f: variance across new over across old vertices %.4f +- %.4f\n", hurst,
                ratio.value(), ratio.error());
    EXPECT_NEAR(ratio.value(), 1.0, 0.008 + 4.0 * ratio.error());
  }
}

// Made by the definition, vertex by vertex from the coarser level, without windows.
TEST(MidpointLaw, IsTheSameByTheDefinition) {
  const samples::Bridges bridges({.method = CoastMethod::midpoint, .dimension = 1.3});
  const MidpointTables& tables = bridges.midpoint();
  constexpr std::uint64_t kSeed = 31;
  const MidpointFunction function(tables, bridges.graph().scale, kSeed);
  const std::uint64_t key = mixed(kSeed, 0xF8A2);
  const auto gaussian = [&](int level, std::int64_t piece) {
    return gaussian_of(mixed(
        key ^ (static_cast<std::uint64_t>(piece) + (static_cast<std::uint64_t>(level) << 48))));
  };
  // Vertex i of a level, at i 2^-level.
  const std::function<double(int, std::int64_t)> vertex = [&](int level, std::int64_t i) -> double {
    if (level == 0) return function.start()[i + 2];
    const std::int64_t piece = i >> 1;
    if (i % 2 == 0) return vertex(level - 1, piece);
    const double mean = tables.far * (vertex(level - 1, piece - 1) + vertex(level - 1, piece + 2)) +
                        tables.near * (vertex(level - 1, piece) + vertex(level - 1, piece + 1));
    return mean +
           bridges.graph().scale[static_cast<std::size_t>(level) - 1] *
               (tables.own * gaussian(level - 1, piece) +
                tables.next * (gaussian(level - 1, piece - 1) + gaussian(level - 1, piece + 1)));
  };
  const std::vector<double> values = bridges.bridge(kSeed, 7, 0);
  for (std::int64_t i = 1; i < 128; ++i) {
    EXPECT_EQ(values[static_cast<std::size_t>(i)], vertex(7, i)) << i;
  }
}

TEST(GaussianHash, HasTheMomentsOfAGaussian) {
  constexpr int kCount = 2000000;
  double m1 = 0.0, m2 = 0.0, m4 = 0.0, most = 0.0;
  int beyond2 = 0, beyond3 = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double x = gaussian_of(mixed(i, 1));
    m1 += x;
    m2 += x * x;
    m4 += x * x * x * x;
    most = std::max(most, std::fabs(x));
    beyond2 += std::fabs(x) > 2.0;
    beyond3 += std::fabs(x) > 3.0;
  }
  std::printf("mean %.5f variance %.5f fourth %.4f; beyond 2: %.5f (0.04550), 3: %.5f (0.00270)\n",
              m1 / kCount, m2 / kCount, m4 / kCount, 1.0 * beyond2 / kCount,
              1.0 * beyond3 / kCount);
  // Four standard errors: sd of x 1, of x^2 sqrt 2, of x^4 about 9.8.
  EXPECT_NEAR(m1 / kCount, 0.0, 4.0 / std::sqrt(kCount));
  EXPECT_NEAR(m2 / kCount, 1.0, 4.0 * 1.4142 / std::sqrt(kCount));
  EXPECT_NEAR(m4 / kCount, 3.0, 4.0 * 9.8 / std::sqrt(kCount));
  EXPECT_NEAR(1.0 * beyond3 / kCount, 0.0027, 0.0004);
  EXPECT_LE(most, kGaussianBound);
  EXPECT_LE(gaussian_of(~std::uint64_t{0}), kGaussianBound);
  EXPECT_GE(gaussian_of(0), -kGaussianBound);
}

TEST(BridgeProfile, IsCloseToTheDeviation) {
  double worst = 0.0;
  for (const double hurst : {0.5, 0.6, 0.75, 0.9, 0.98, 0.999999999}) {
    const FractionalBridge bridge(hurst);
    const BridgeProfile profile(bridge);
    EXPECT_NEAR(bridge.deviation(0.5), 1.0, 1e-12);
    EXPECT_NEAR(bridge.deviation(0.1), std::sqrt(bridge.covariance(0.1, 0.1)), 1e-7);
    for (double t = 0x1p-31; t < 1.0; t = t < 0.25 ? t * 1.1 : t + 0.01) {
      const double error = profile.reciprocal(t) * bridge.deviation(t) - 1.0;
      ASSERT_TRUE(std::isfinite(error));
      worst = std::max(worst, std::fabs(error));
    }
  }
  std::printf("worst error of the profile: %.1f %%\n", 100.0 * worst);
  EXPECT_LT(worst, 0.07);
}

}  // namespace
}  // namespace skerry::echo
