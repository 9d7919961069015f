#include "echo/receiver/receiver_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

std::vector<float> powers(const ReceiverNoise& noise, std::uint32_t spoke, std::uint32_t scan = 0,
                          float echo = 0.0f) {
  const std::vector<float> row(kCells, echo);
  std::vector<float> total(kCells);
  receive_power(row, noise.gain(), noise.row(noise_key(1, 0, scan, spoke)), total);
  return total;
}

// Correlation of power between cells `lag` apart, spokes and scans so far apart.
double correlation(const ReceiverNoise& noise, std::uint32_t lag, std::uint32_t spokes_apart = 0,
                   std::uint32_t scans_apart = 0) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, n = 0;
  for (std::uint32_t spoke = 0; spoke < 1000; ++spoke) {
    const auto a = powers(noise, spoke), b = powers(noise, spoke + spokes_apart, scans_apart);
    for (std::uint32_t i = 0; i + lag < kCells; ++i) {
      const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i + lag]);
      sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y, n += 1.0;
    }
  }
  return (sab / n - sa / n * sb / n) /
         std::sqrt((saa / n - sa / n * sa / n) * (sbb / n - sb / n * sb / n));
}

double filter_correlation(double samples) {
  const double x = std::numbers::pi * samples;
  return std::sin(x) * std::sin(x) / (x * x);
}

// A torus holds kPeriod * samples independent values; a correlation estimated from n of them has
// a standard deviation of about 1 / sqrt(n), and 4 of those are never seen.
TEST(ReceiverNoise, NeighbouringCellsAreCorrelatedAsBehindAFilter) {
  for (double samples : {0.1, 0.3, 0.62, 0.9}) {
    const ReceiverNoise noise(samples, Decimation::peak);
    const double bound = 4.0 / std::sqrt(ReceiverNoise::kPeriod * samples);
    for (std::uint32_t lag : {1u, 2u, 3u, 5u}) {
      const double found = correlation(noise, lag), theory = filter_correlation(lag * samples);
      std::printf("%.2f samples in a cell, lag %u: %.3f (theory %.3f)\n", samples, lag, found,
                  theory);
      EXPECT_NEAR(found, theory, bound);
    }
  }
}

// SOURCES.md "Pictures (h)", Quantum 2 at gain 95: .23 at lag 1, .04 at lag 2.
TEST(ReceiverNoise, LooksLikeTheRecordedOne) {
  const ReceiverNoise noise(0.62, Decimation::peak);
  EXPECT_NEAR(correlation(noise, 1), 0.23, 0.02);
  EXPECT_NEAR(correlation(noise, 2), 0.04, 0.02);
}

TEST(ReceiverNoise, SpokesAndTurnsAreUnrelated) {
  for (double samples : {0.3, 1.0, 3.0}) {
    const ReceiverNoise noise(samples, Decimation::peak);
    const double bound = 4.0 / std::sqrt(1000.0 * kCells * std::min(1.0, samples)) + 1e-3;
    EXPECT_NEAR(correlation(noise, 0, 1), 0.0, bound);
    EXPECT_NEAR(correlation(noise, 0, 2), 0.0, bound);
    EXPECT_NEAR(correlation(noise, 0, 0, 1), 0.0, bound);
    if (samples >= 1.0) {
      EXPECT_NEAR(correlation(noise, 1), 0.0, bound);
    }
  }
}

// Mean and deviation of the decibels of unit exponential noise: SOURCES.md "Vectors".
TEST(ReceiverNoise, HasTheMeanAndSpreadOfItsLaw) {
  for (double samples : {0.3, 0.62, 1.0}) {
    const ReceiverNoise noise(samples, Decimation::peak);
    double sum = 0, db = 0, db2 = 0, n = 0;
    for (std::uint32_t spoke = 0; spoke < 2000; ++spoke) {
      for (float p : powers(noise, spoke)) {
        const double x = 10.0 * std::log10(static_cast<double>(p));
        sum += static_cast<double>(p), db += x, db2 += x * x, n += 1;
      }
    }
    const double mean = db / n, deviation = std::sqrt(db2 / n - mean * mean);
    std::printf("%.2f samples: mean %.4f, %.4f dB, deviation %.4f dB\n", samples, sum / n, mean,
                deviation);
    EXPECT_NEAR(sum / n, 1.0, 0.01);
    EXPECT_NEAR(mean, -2.5068, 0.03);
    EXPECT_NEAR(deviation, 5.5700, 0.03);
    EXPECT_NEAR(noise.mean_octaves() * 3.0103, -2.5068, 0.03);
  }
}

double ks_distance(std::vector<double> values, const auto& law) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double d = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = law(values[i]);
    d = std::max({d, std::fabs(f - static_cast<double>(i) / n),
                  std::fabs(f - static_cast<double>(i + 1) / n)});
  }
  return d;
}

std::vector<double> sampled(const ReceiverNoise& noise, float echo, double scale) {
  std::vector<double> values;
  for (std::uint32_t spoke = 0; spoke < 1000; ++spoke) {
    for (float p : powers(noise, spoke, 0, echo)) values.push_back(static_cast<double>(p) * scale);
  }
  return values;
}

// Kolmogorov and Smirnov: 1.95 / sqrt(n) = 0.0019 for a million independent values is passed with
// probability 0.999; 0.003 is the bound the header states.
TEST(ReceiverNoise, IsExponentialWhereACellHoldsOneSample) {
  const double d = ks_distance(sampled(ReceiverNoise(1.0, Decimation::peak), 0.0f, 1.0),
                               [](double x) { return -std::expm1(-x); });
  std::printf("KS distance %.4f\n", d);
  EXPECT_LE(d, 0.003);
}

TEST(ReceiverNoise, PeaksAreTheLargestOfTheSamples) {
  for (double q : {1.2, 2.0, 3.5, 14.0}) {
    const double d = ks_distance(sampled(ReceiverNoise(q, Decimation::peak), 0.0f, 1.0),
                                 [q](double x) { return std::pow(-std::expm1(-x), q); });
    std::printf("peak of %.1f samples: KS distance %.4f\n", q, d);
    EXPECT_LE(d, 0.003);
  }
}

// The mean of q exponentials has mean 1 and variance 1/q; with a steady echo of power P beneath, as
// every sample has it, mean P + 1 and variance (2 P + 1) / q.
TEST(ReceiverNoise, MeansAreMeansOfTheSamplesWithAndWithoutAnEcho) {
  for (double q : {1.5, 4.0, 9.7}) {
    const ReceiverNoise noise(q, Decimation::mean);
    for (double echo : {0.0, 3.0, 100.0}) {
      const auto values =
          sampled(noise, static_cast<float>(echo), std::exp2(-noise.scale_octaves()));
      const auto n = static_cast<double>(values.size());
      double sum = 0, square = 0;
      for (double v : values) sum += v, square += v * v;
      const double mean = sum / n, variance = square / n - mean * mean;
      std::printf("mean of %.1f samples, echo %.0f: mean %.4f, variance %.4f (%.4f)\n", q, echo,
                  mean, variance, (2.0 * echo + 1.0) / q);
      EXPECT_NEAR(mean, echo + 1.0, 5.0 * std::sqrt((2.0 * echo + 1.0) / q / n) + 2e-3);
      EXPECT_NEAR(variance * q / (2.0 * echo + 1.0), 1.0, 0.02);
    }
  }
}

// Automatic STC takes noise for noise by this.
TEST(ReceiverNoise, KnowsTheMeanOfItsLogarithm) {
  for (double samples : {1.0, 3.0}) {
    for (Decimation decimation : {Decimation::peak, Decimation::mean}) {
      const ReceiverNoise noise(samples, decimation);
      double sum = 0.0;
      for (std::uint32_t spoke = 0; spoke < 300; ++spoke) {
        for (float p : powers(noise, spoke)) sum += std::log2(static_cast<double>(p));
      }
      EXPECT_NEAR(sum / (300.0 * kCells), noise.mean_octaves(), 0.02);
    }
  }
}

// Counts beyond powers that one cell in 1e3 .. 1e6 reaches.
TEST(ReceiverNoise, TheTailIsExponentialToOneInAMillion) {
  const ReceiverNoise noise(1.0, Decimation::peak);
  const std::vector<float> silence(kCells, 0.0f);
  std::vector<float> total(kCells);
  std::vector<double> over(7, 0.0);
  constexpr std::uint32_t kSpokes = 1u << 17;
  for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
    receive_power(silence, 1.0f, noise.row(noise_key(5, 0, spoke >> 12, spoke & 4095)), total);
    for (float p : total) {
      if (p < 6.9f) continue;
      for (int e = 3; e <= 6; ++e)
        over[static_cast<std::size_t>(e)] += static_cast<double>(p) > e * std::numbers::ln10;
    }
  }
  for (int e = 3; e <= 6; ++e) {
    const double expected = static_cast<double>(kSpokes) * kCells * std::pow(10.0, -e);
    const double ratio = over[static_cast<std::size_t>(e)] / expected;
    std::printf("1e-%d: %.3f of the law\n", e, ratio);
    EXPECT_NEAR(ratio, 1.0, (e < 6 ? 0.1 : 0.2) + 4.0 / std::sqrt(expected));
  }
}

// A point's echo lies in one of the samples of a cell: the truth is the larger of its sample and
// the others.  A steady echo in all: the largest.
TEST(ReceiverNoise, PeakWithAnEchoIsBetweenAPointAndASteadyOne) {
  constexpr int kSamples = 4;
  const ReceiverNoise one(1.0, Decimation::peak), peak(kSamples, Decimation::peak);
  for (double snr_db : {0.0, 10.0, 20.0}) {
    const auto echo = static_cast<float>(std::pow(10.0, snr_db / 10.0));
    double point = 0, steady = 0, made = 0;
    for (std::uint32_t spoke = 0; spoke < 2000; ++spoke) {
      const auto with = powers(peak, spoke, 0, echo);
      std::vector<std::vector<float>> echoed, silent;
      for (std::uint32_t k = 0; k < kSamples; ++k) {
        echoed.push_back(powers(one, spoke, 1 + k, echo));
        silent.push_back(powers(one, spoke, 1 + k));
      }
      for (std::uint32_t i = 0; i < kCells; ++i) {
        float p = echoed[0][i], s = echoed[0][i];
        for (std::uint32_t k = 1; k < kSamples; ++k) {
          p = std::max(p, silent[k][i]);
          s = std::max(s, echoed[k][i]);
        }
        point += static_cast<double>(p), steady += static_cast<double>(s);
        made += static_cast<double>(with[i]);
      }
    }
    const double over_point = 10.0 * std::log10(made / point);
    const double under_steady = 10.0 * std::log10(steady / made);
    std::printf("%.0f dB: %.2f dB over a point's peak, %.2f dB under a steady one's\n", snr_db,
                over_point, under_steady);
    EXPECT_GE(over_point, -0.05);
    EXPECT_LE(over_point, 0.6);
    EXPECT_GE(under_steady, -0.05);
    EXPECT_LE(under_steady, 1.3);
  }
}

TEST(ReceiverNoise, IsSharedByThoseWhoAskForTheSame) {
  const auto a = receiver_noise_for(0.5, Decimation::peak);
  EXPECT_EQ(a, receiver_noise_for(0.505, Decimation::mean));
  EXPECT_NE(a, receiver_noise_for(0.6, Decimation::peak));
  EXPECT_NE(receiver_noise_for(4.0, Decimation::peak), receiver_noise_for(4.0, Decimation::mean));
  EXPECT_NEAR(samples_in_cell(10.0, 5e6), 0.33356, 1e-5);
}

}  // namespace
}  // namespace skerry::echo
