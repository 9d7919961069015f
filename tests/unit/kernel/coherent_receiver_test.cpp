#include "echo/kernel/coherent_receiver.hpp"

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

constexpr QuantiserScale kScale{17.1f, 255.0f};

// A row of everything the kernels read and write.
struct Rows {
  std::vector<float> power, re_a, im_a, re_b, im_b, re_c, im_c, beside, offset, before, before_that,
      later, so_far, total, kept;
  Rows(std::size_t n, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> gauss(0.0f, 0.5f);
    std::uniform_real_distribution<float> octaves(-20.0f, 60.0f), steps(-300.0f, 50.0f);
    for (auto* row : {&re_a, &im_a, &re_b, &im_b, &re_c, &im_c}) {
      row->resize(n);
      for (float& v : *row) v = gauss(random);
    }
    for (auto* row : {&power, &beside, &before, &before_that, &later, &so_far}) {
      row->resize(n);
      for (float& v : *row) v = random() % 4 == 0 ? 0.0f : std::exp2(octaves(random));
    }
    offset.resize(n);
    for (float& v : offset) v = steps(random);
    total.resize(n);
    kept.resize(n);
  }
  NoiseRow noise() const {
    return {re_a.data(), im_a.data(), re_b.data(),  im_b.data(),
            re_c.data(), im_c.data(), beside.data()};
  }
  RejectionRows rejection() {
    return {before.data(), before_that.data(), total.data(), 10.0f, 1.0f};
  }
  IntegrationRows integration() { return {later.data(), so_far.data(), kept.data(), -3.0f}; }
  IntegrationRows few() {
    return {nullptr, nullptr, kept.data(), -2.0f, {later.data(), before.data(), so_far.data()}};
  }
};

// How far video, the floor of a value, lies from an exact value: 0 within its step.
double steps_off(double exact, std::uint8_t video) {
  const double above = static_cast<double>(video) - exact;
  const double below = exact < 255.0 ? exact - (video + 1.0) : 0.0;
  return std::max({0.0, above, below});
}

TEST(CoherentReceiver, MatchesItsReferenceAtEveryLengthAndOffset) {
  double worst = 0.0, worst_power = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      for (std::size_t shift = 0; shift < 4; ++shift) {
        const Rows rows(n + shift, static_cast<std::uint32_t>(n * 4 + shift));
        const NoiseRow noise = from_cell(rows.noise(), shift);
        std::vector<std::uint8_t> video(n, 77);
        std::vector<float> total(n);
        receive_video(std::span(rows.power).subspan(shift), 1.5f, noise,
                      std::span(rows.offset).subspan(shift), kScale, video);
        receive_power(std::span(rows.power).subspan(shift), 1.5f, noise, total);
        for (std::size_t i = 0; i < n; ++i) {
          const double p = 1.5 * static_cast<double>(rows.power[i + shift]);
          const double exact = total_power_reference(p, 1.0, noise, i);
          // Echo and noise may cancel: the error is one of what went in.
          const double size = p + exact + 1.0;
          worst_power =
              std::max(worst_power, std::fabs(static_cast<double>(total[i]) - exact) / size);
          if (exact < 1e-3 * size) continue;
          worst = std::max(
              worst,
              steps_off(video_reference(exact, static_cast<double>(rows.offset[i + shift]), kScale),
                        video[i]));
        }
      }
    }
  });
  std::printf("worst error: %.3g relative before the log, %.3g video steps behind it\n",
              worst_power, worst);
  EXPECT_LE(worst_power, 3e-7);
  EXPECT_LE(worst, 17.1 * static_cast<double>(kFastLog2Error) + 2e-3);
}

TEST(CoherentReceiver, RejectionAndIntegrationMatchTheirReferences) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n : {1u, 15u, 64u, 67u, 300u}) {
      for (int what = 0; what < 5; ++what) {
        const bool rejects = what != 1 && what != 3, integrates = what != 0, few = what > 2;
        Rows rows(n, static_cast<std::uint32_t>(n) + 7);
        const std::vector<float> so_far = rows.so_far;
        const RejectionRows rejection = rows.rejection();
        const IntegrationRows integration = few ? rows.few() : rows.integration();
        std::vector<std::uint8_t> video(n);
        if (!integrates) {
          receive_rejected(rows.power, 1.0f, rows.noise(), rejection, rows.offset, kScale, video);
        } else if (!rejects) {
          receive_integrated(rows.power, 1.0f, rows.noise(), integration, rows.offset, kScale,
                             video);
        } else {
          receive_rejected_and_integrated(rows.power, 1.0f, rows.noise(), rejection, integration,
                                          rows.offset, kScale, video);
        }
        std::vector<float> raw(n);
        receive_power(rows.power, 1.0f, rows.noise(), raw);
        for (std::size_t i = 0; i < n; ++i) {
          double x = static_cast<double>(raw[i]);
          if (rejects) {
            EXPECT_EQ(rows.total[i], raw[i]);
            x = rejected_reference(x, static_cast<double>(rows.before[i]),
                                   static_cast<double>(rows.before_that[i]), 10.0, 1.0);
          }
          if (integrates) {
            EXPECT_FLOAT_EQ(rows.kept[i], static_cast<float>(x));
          }
          const double past = static_cast<double>(so_far[i]);
          if (integrates && few) {
            x += static_cast<double>(rows.later[i]) + static_cast<double>(rows.before[i]) + past;
            x *= 0.25;
          } else if (integrates) {
            EXPECT_FLOAT_EQ(rows.so_far[i], static_cast<float>(past + x));
            x = (past + x + static_cast<double>(rows.later[i])) * 0.125;
          }
          worst = std::max(
              worst,
              steps_off(video_reference(x, static_cast<double>(rows.offset[i]), kScale), video[i]));
        }
      }
    }
  });
  std::printf("worst error: %.3g video steps\n", worst);
  EXPECT_LE(worst, 17.1 * static_cast<double>(kFastLog2Error) + 2e-3);
}

TEST(CoherentReceiver, GivesTheSameBitsOnEveryInstructionSet) {
  std::vector<std::uint8_t> first;
  std::vector<float> first_sum;
  std::vector<std::int32_t> first_levels;
  on_every_isa([&] {
    Rows rows(4093, 3);
    std::vector<std::uint8_t> video(4093);
    receive_rejected_and_integrated(rows.power, 1.0f, rows.noise(), rows.rejection(),
                                    rows.integration(), rows.offset, kScale, video);
    std::vector<std::uint8_t> few(4093);
    receive_rejected_and_integrated(rows.power, 1.0f, rows.noise(), rows.rejection(), rows.few(),
                                    rows.offset, kScale, few);
    video.insert(video.end(), few.begin(), few.end());
    std::vector<std::int32_t> levels(4093 / kLevelCells);
    sum_levels(rows.power, 1.0f, rows.noise(), levels);
    add_row(rows.so_far, rows.kept);
    if (first.empty()) {
      first = video;
      first_sum = rows.so_far;
      first_levels = levels;
    }
    EXPECT_EQ(video, first);
    EXPECT_EQ(rows.so_far, first_sum);
    EXPECT_EQ(levels, first_levels);
  });
}

TEST(CoherentReceiver, LevelsAreSumsOfLogarithms) {
  const Rows rows(4096, 5);
  std::vector<std::int32_t> levels(4096 / kLevelCells);
  sum_levels(rows.power, 2.0f, rows.noise(), levels);
  for (std::size_t b = 0; b < levels.size(); ++b) {
    double exact = 0.0;
    for (std::size_t i = b * kLevelCells; i < (b + 1) * kLevelCells; ++i)
      exact += std::log2(
          total_power_reference(2.0 * static_cast<double>(rows.power[i]), 1.0, rows.noise(), i));
    // Each of 16 is rounded down by up to a step; the log's own error is 1/30 of one.
    EXPECT_LE(levels[b], exact * 256.0 + 1.0);
    EXPECT_GE(levels[b], exact * 256.0 - 17.0);
  }
}

TEST(CoherentReceiver, WithNothingBesideIsWithZerosBeside) {
  on_every_isa([&] {
    Rows one(67, 5), other(67, 5);
    std::fill(one.beside.begin(), one.beside.end(), 0.0f);
    NoiseRow none = other.noise();
    none.beside = nullptr;
    EXPECT_EQ(from_cell(none, 16).beside, nullptr);
    std::vector<std::uint8_t> a(67), b(67);
    receive_rejected_and_integrated(one.power, 0.7f, one.noise(), one.rejection(),
                                    one.integration(), one.offset, kScale, a);
    receive_rejected_and_integrated(other.power, 0.7f, none, other.rejection(), other.integration(),
                                    other.offset, kScale, b);
    EXPECT_EQ(a, b);
    receive_power(one.power, 0.7f, one.noise(), one.total);
    receive_power(other.power, 0.7f, none, other.total);
    EXPECT_EQ(one.total, other.total);
    std::vector<std::int32_t> levels(4), others(4);
    sum_levels(one.power, 0.7f, one.noise(), levels);
    sum_levels(other.power, 0.7f, none, others);
    EXPECT_EQ(levels, others);
  });
}

}  // namespace
}  // namespace skerry::echo
