#include "echo/kernel/sweep_codes.hpp"

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

std::vector<float> powers(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> octaves(-30.0f, 60.0f);
  std::vector<float> row(n);
  for (float& v : row) v = random() % 5 == 0 ? 0.0f : std::exp2(octaves(random));
  return row;
}

std::vector<std::uint16_t> any_codes(std::size_t n, std::uint32_t seed, std::uint32_t top) {
  std::mt19937 random(seed);
  std::vector<std::uint16_t> codes(n);
  for (auto& c : codes) c = static_cast<std::uint16_t>(random() % (top + 1));
  return codes;
}

// How far a code lies from where an exact value would put it: 0 within its step.
double steps_off(double exact, double code, double top) {
  const double value = std::clamp(exact, 0.0, top);
  return std::max({0.0, code - value, value - (code + 1.0)});
}

TEST(SweepCodes, BlendsRowsAtEveryLengthAndShare) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      const auto a = powers(n, 1), b = powers(n, 2);
      for (const float share : {0.0f, 0.25f, 0.7f, 1.0f}) {
        std::vector<float> out(n);
        blend_rows(a, b, share, out);
        for (std::size_t i = 0; i < n; ++i) {
          const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
          const double exact = x + static_cast<double>(share) * (y - x);
          worst = std::max(
              worst, std::fabs(static_cast<double>(out[i]) - exact) / std::max({x, y, 1e-30}));
          ASSERT_GE(out[i], 0.0f);
        }
        if (share == 0.0f) {
          EXPECT_EQ(out, a);
        }
      }
    }
  });
  std::printf("worst error %.3g of the larger\n", worst);
  EXPECT_LE(worst, 2e-7);
}

TEST(SweepCodes, SamplesARowOnStraightLines) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n : {1u, 2u, 7u, 8u, 33u, 1024u}) {
      for (const float step : {0.0f, 0.37f, 1.0f, 2.7641f}) {
        for (const float first : {0.0f, 0.5f, 0.999f}) {
          const double last =
              static_cast<double>(first) + static_cast<double>(step) * static_cast<double>(n);
          const auto cells = powers(static_cast<std::size_t>(last) + 3, 5);
          std::vector<float> out(n);
          sample_row(cells, first, step, out);
          for (std::size_t i = 0; i < n; ++i) {
            const double place =
                static_cast<double>(first) + static_cast<double>(i) * static_cast<double>(step);
            // At a place as wrong as it may be, either way; a line bends at whole places.
            const double off = 1.2e-7 * place, from = std::max(0.0, place - off);
            std::vector<double> places = {from, place, place + off};
            if (std::floor(place + off) > from) places.push_back(std::floor(place + off));
            double low = 1e300, high = 0.0, size = 1e-30;
            for (const double at : places) {
              const double value = sample_row_reference(cells, at);
              low = std::min(low, value);
              high = std::max(high, value);
              size = std::max({size, static_cast<double>(cells[static_cast<std::size_t>(at)]),
                               static_cast<double>(cells[static_cast<std::size_t>(at) + 1])});
            }
            const double got = static_cast<double>(out[i]);
            const double beyond = std::max({0.0, got - high, low - got});
            worst = std::max(worst, beyond / size);
            ASSERT_GE(out[i], 0.0f);
          }
        }
      }
    }
  });
  std::printf("worst error %.3g of the larger neighbour\n", worst);
  EXPECT_LE(worst, 2e-7);
}

TEST(SweepCodes, LogAndLinearMatchTheirReferencesAtEveryLengthOffsetAndSize) {
  double worst_log = 0.0, worst_linear = 0.0;  // over what is allowed
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      for (const double bits : {8.0, 10.0, 12.0, 14.0}) {
        const double top = std::exp2(bits) - 1.0;
        const auto power = powers(n + 3, static_cast<std::uint32_t>(n));
        const auto from = std::span(power).subspan(n % 3, n);
        const double per_octave = std::exp2(bits) / 45.0 * 3.0103;
        std::vector<float> offset(n), factor(n);
        for (std::size_t i = 0; i < n; ++i) {
          offset[i] = static_cast<float>(top * 0.01 * (static_cast<double>(i) - 30.0));
          factor[i] = static_cast<float>(top * 1e-3 * (1.0 + static_cast<double>(i)));
        }
        std::vector<std::uint16_t> logs(n), lines(n), turned(n);
        const ConverterScale scale{static_cast<float>(top), 0};
        const ConverterScale flipped{static_cast<float>(top), static_cast<std::uint32_t>(top)};
        convert_log(from, static_cast<float>(per_octave), offset, scale, logs);
        convert_linear(from, factor, 3.5f, scale, lines);
        convert_linear(from, factor, 3.5f, flipped, turned);
        for (std::size_t i = 0; i < n; ++i) {
          const double p = static_cast<double>(from[i]), o = static_cast<double>(offset[i]);
          const double f = static_cast<double>(factor[i]);
          ASSERT_EQ(turned[i], static_cast<std::uint16_t>(top) - lines[i]);
          const double straight = convert_linear_reference(p, f, 3.5);
          worst_linear = std::max(worst_linear,
                                  steps_off(straight, lines[i], top) / (2e-7 * (straight + 3.5)));
          if (p == 0.0) {
            ASSERT_EQ(logs[i], 0);
            continue;
          }
          const double exact = convert_log_reference(p, per_octave, o);
          const double allowed = static_cast<double>(kFastLog2Error) * per_octave +
                                 2e-7 * (per_octave * std::fabs(std::log2(p)) + std::fabs(o));
          worst_log = std::max(worst_log, steps_off(exact, logs[i], top) / allowed);
        }
      }
    }
  });
  std::printf("worst of what is allowed: log %.3f, linear %.3f\n", worst_log, worst_linear);
  EXPECT_LE(worst_log, 1.0);
  EXPECT_LE(worst_linear, 1.0);
}

TEST(SweepCodes, DecimationIsExactForEveryGroup) {
  on_every_isa([&] {
    for (std::uint32_t group = 1; group <= 40; ++group) {
      for (const std::size_t n : {0u, 1u, 5u, 31u, 64u, 67u}) {
        const auto codes = any_codes(n * group, group, 16383);
        std::vector<std::uint16_t> peak(n), mean(n), sum(n);
        decimate_by_peak(codes, group, peak);
        decimate_by_mean(codes, group, mean);
        decimate_by_sum(codes, group, sum);
        for (std::size_t g = 0; g < n; ++g) {
          std::uint64_t largest = 0, all = 0;
          for (std::size_t k = 0; k < group; ++k) {
            const std::uint64_t code = codes[g * group + k];
            largest = std::max(largest, code);
            all += code;
          }
          ASSERT_EQ(peak[g], largest) << group;
          ASSERT_EQ(mean[g], (2 * all + group) / (2 * group)) << group;  // halves go up
          ASSERT_EQ(sum[g], std::min<std::uint64_t>(all, 65535)) << group;
        }
      }
    }
  });
}

TEST(SweepCodes, TheLargestGroupOfTheLargestCodesFits) {
  const std::vector<std::uint16_t> codes(65536, 65535);
  std::vector<std::uint16_t> out(1);
  decimate_by_mean(codes, 65536, out);
  EXPECT_EQ(out[0], 65535);
  decimate_by_sum(codes, 65536, out);
  EXPECT_EQ(out[0], 65535);
}

}  // namespace
}  // namespace skerry::echo
