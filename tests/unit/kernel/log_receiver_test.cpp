#include "echo/kernel/log_receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "echo/kernel/fast_math.hpp"
#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

TEST(LogReceiver, FastLogStaysInItsBound) {
  double worst = 0.0;
  float before = fast_log2(1.0f);
  for (std::uint32_t bits = 0x3F800000; bits < 0x40800000; bits += 7) {  // [1, 4)
    const float x = std::bit_cast<float>(bits);
    const float y = fast_log2(x);
    worst = std::max(worst, std::fabs(static_cast<double>(y) - std::log2(static_cast<double>(x))));
    ASSERT_GE(y, before - 3e-7f) << x;
    before = y;
  }
  std::printf("worst error of fast_log2: %.3g (bound %.3g)\n", worst,
              static_cast<double>(kFastLog2Error));
  EXPECT_LE(worst, static_cast<double>(kFastLog2Error));
  for (int e = -100; e <= 100; ++e) EXPECT_EQ(fast_log2(std::exp2f(static_cast<float>(e))), e);
}

// Every length and offset, so that each tail of the vector loops is met.
TEST(LogReceiver, MatchesItsReferenceAtEveryLengthAndOffset) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-20.0f, 90.0f), offset(-300.0f, 50.0f);
  const QuantiserScale scale{12.8f, 255.0f};
  const NoiseKey key = noise_key(1, 2, 3, 4);
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      for (std::size_t shift = 0; shift < 4; ++shift) {
        std::vector<float> power(n + shift), offsets(n + shift);
        for (float& p : power) p = std::exp2(exponent(random));
        for (float& o : offsets) o = offset(random);
        const auto p = std::span(power).subspan(shift);
        const auto o = std::span(offsets).subspan(shift);
        std::vector<std::uint8_t> video(n, 77);
        std::vector<double> exact(n);
        detect_and_quantise(p, o, key, scale, video);
        detect_and_quantise_reference(p, o, key, scale, exact);
        for (std::size_t i = 0; i < n; ++i) {
          // video is the floor of a value that may be off by the log's error and a float rounding.
          const double low = exact[i] - video[i], high = video[i] + 1.0 - exact[i];
          const double error = std::max({0.0, -low, exact[i] < 255.0 ? -high : 0.0});
          worst = std::max(worst, error);
        }
      }
    }
  });
  std::printf("worst error before rounding: %.3g video steps\n", worst);
  EXPECT_LE(worst, 12.8 * static_cast<double>(kFastLog2Error) * 2 + 1e-4);
}

TEST(LogReceiver, DetectThenQuantiseIsDetectAndQuantise) {
  std::vector<float> power(1000), offsets(1000, -40.0f), octaves(1000);
  std::mt19937 random(6);
  for (float& p : power) p = static_cast<float>(random() % 100000);
  std::vector<std::uint8_t> one(1000), two(1000);
  const NoiseKey key = noise_key(9, 0, 0, 17);
  detect_and_quantise(power, offsets, key, {12.8f, 255.0f}, one);
  detect(power, key, octaves);
  quantise(octaves, offsets, {12.8f, 255.0f}, two);
  EXPECT_EQ(one, two);
}

TEST(LogReceiver, GivesTheSameBitsOnEveryInstructionSet) {
  std::vector<float> power(4096), offsets(4096);
  std::mt19937 random(7);
  for (float& p : power) p = std::exp2(static_cast<float>(random() % 1000) * 0.05f - 10.0f);
  for (float& o : offsets) o = -static_cast<float>(random() % 100);
  std::vector<std::uint8_t> first;
  on_every_isa([&] {
    std::vector<std::uint8_t> video(4096);
    detect_and_quantise(power, offsets, noise_key(1, 1, 1, 1), {12.8f, 255.0f}, video);
    if (first.empty()) first = video;
    EXPECT_EQ(video, first);
  });
}

// Exponential noise of unit mean: mean and spread of its decibels are known (SOURCES.md "Vectors"),
// and its distribution function passes Kolmogorov and Smirnov's test at n = 2^20: D <= 1.95/sqrt(n)
// with probability 0.999.
TEST(LogReceiver, NoiseIsExponentialWithUnitMean) {
  std::vector<double> e;
  for (std::uint32_t spoke = 0; spoke < 256; ++spoke) {
    const NoiseKey key = noise_key(42, 0, 7, spoke);
    for (std::uint32_t cell = 0; cell < 4096; ++cell) e.push_back(unit_noise_reference(key, cell));
  }
  const auto n = static_cast<double>(e.size());
  double sum = 0.0, sum_db = 0.0, sum_db2 = 0.0;
  for (double x : e) {
    const double db = 10.0 * std::log10(x);
    sum += x;
    sum_db += db;
    sum_db2 += db * db;
  }
  const double mean_db = sum_db / n, sd_db = std::sqrt(sum_db2 / n - mean_db * mean_db);
  std::sort(e.begin(), e.end());
  double d = 0.0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double f = -std::expm1(-e[i]);
    d = std::max({d, std::fabs(f - static_cast<double>(i) / n),
                  std::fabs(f - static_cast<double>(i + 1) / n)});
  }
  std::printf("mean %.5f, %.4f dB, sd %.4f dB, KS distance %.2g\n", sum / n, mean_db, sd_db, d);
  EXPECT_NEAR(sum / n, 1.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(mean_db, -2.5068, 0.03);
  EXPECT_NEAR(sd_db, 5.5700, 0.03);
  EXPECT_LE(d, 1.95 / std::sqrt(n));
}

TEST(LogReceiver, NoiseOfNeighboursIsUnrelated) {
  const auto correlation = [](auto&& a, auto&& b) {
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, n = 0;
    for (std::uint32_t spoke = 0; spoke < 64; ++spoke) {
      for (std::uint32_t cell = 0; cell < 4000; ++cell) {
        const double x = a(spoke, cell), y = b(spoke, cell);
        sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y, n += 1;
      }
    }
    return (sab / n - sa / n * sb / n) /
           std::sqrt((saa / n - sa / n * sa / n) * (sbb / n - sb / n * sb / n));
  };
  const auto at = [](std::uint32_t scan, std::uint32_t spoke, std::uint32_t cell) {
    return unit_noise_reference(noise_key(3, 0, scan, spoke), cell);
  };
  const auto here = [&](auto s, auto c) { return at(5, s, c); };
  const double bound = 4.0 / std::sqrt(64.0 * 4000.0);
  EXPECT_NEAR(correlation(here, [&](auto s, auto c) { return at(5, s, c + 1); }), 0.0, bound);
  EXPECT_NEAR(correlation(here, [&](auto s, auto c) { return at(5, s + 1, c); }), 0.0, bound);
  EXPECT_NEAR(correlation(here, [&](auto s, auto c) { return at(6, s, c); }), 0.0, bound);
}

}  // namespace
}  // namespace skerry::echo
