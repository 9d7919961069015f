// The noise of a sweep: its law, and its relation from tick to tick and from trigger to trigger.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/unit/sweeps/sweep_setup.hpp"

namespace skerry::echo {
namespace {

std::vector<double> noise_powers(SweepReceiver& receiver, std::uint64_t trigger) {
  return powers_of(receiver.channel(), kLogVideoDb, noise_sweep(receiver, trigger));
}

// 200 triggers of 2048 independent ticks: Kolmogorov and Smirnov's 1e-6 point is 2.7 / sqrt(N) =
// 0.0042; a code is 1/1000 of the amplitude, 0.0009 of probability at most.
TEST(SweepNoise, IsExponentialInPower) {
  SweepReceiver receiver(noise_channel(), grid_of());
  std::vector<double> all;
  for (std::uint64_t t = 0; t < 200; ++t) {
    const auto powers = noise_powers(receiver, t);
    all.insert(all.end(), powers.begin(), powers.end());
  }
  std::sort(all.begin(), all.end());
  double distance = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double law = 1.0 - std::exp(-all[i]), n = static_cast<double>(all.size());
    distance = std::max({distance, std::fabs(law - static_cast<double>(i) / n),
                         std::fabs(law - static_cast<double>(i + 1) / n)});
    sum += all[i];
  }
  const double mean = sum / static_cast<double>(all.size());
  std::printf("KS %.5f, mean %.4f\n", distance, mean);
  EXPECT_LT(distance, 0.0042 + 0.0009);
  // 5 deviations, and 0.1 % for codes cut at full scale and rounded.
  EXPECT_NEAR(mean, 1.0, 5.0 / std::sqrt(409600.0) + 0.001);
}

// Pairs of triggers share a stretch of the torus at the same place with probability 3 / 2048 and
// then a ninth of their power: 1.6e-4 of correlation in the mean.  400 000 pairs scatter by 0.0016.
TEST(SweepNoise, IsUnrelatedFromTriggerToTrigger) {
  SweepReceiver receiver(noise_channel(), grid_of());
  for (const std::uint64_t apart : {1ull, 2ull, 7ull, 1ull << 32}) {
    for (const std::size_t lag : {0u, 1u, 16u}) {
      Correlation sum;
      for (std::uint64_t t = 0; t < 200; ++t) {
        const auto a = noise_powers(receiver, 5000 + t);
        const auto b = noise_powers(receiver, 5000 + t + apart);
        for (std::size_t i = 0; i + lag < a.size(); ++i) sum.add(a[i], b[i + lag]);
      }
      EXPECT_LT(std::fabs(sum.value()), 4.5 / std::sqrt(sum.pairs()) + 1.6e-4)
          << apart << " triggers apart, " << lag << " ticks";
    }
  }
}

// Integration rests on this: the mean of k triggers scatters by 1 / sqrt(k).
TEST(SweepNoise, OfManyTriggersAveragesAsIndependentNoise) {
  SweepReceiver receiver(noise_channel(), grid_of());
  for (const std::uint32_t k : {2u, 5u, 20u}) {
    double sum = 0.0, squares = 0.0, n = 0.0;
    for (std::uint64_t group = 0; group < 50; ++group) {
      std::vector<double> mean(2048, 0.0);
      for (std::uint64_t t = 0; t < k; ++t) {
        const auto powers = noise_powers(receiver, 9000 + group * k + t);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += powers[i] / k;
      }
      for (const double m : mean) sum += m, squares += m * m, n += 1.0;
    }
    const double variance = squares / n - sum * sum / n / n;
    // Deviation of a variance of N means of k exponentials: sqrt((2 + 6 / k) / N).
    EXPECT_NEAR(variance * k, 1.0, 4.5 * std::sqrt((2.0 + 6.0 / k) / n) + 0.004) << k;
  }
}

TEST(SweepNoise, TellsRadarsAndScenariosApart) {
  auto grid = grid_of();
  SweepReceiver own(noise_channel(), grid);
  grid.radar = 1;
  SweepReceiver other_radar(noise_channel(), grid);
  grid = grid_of();
  grid.seed = 8;
  SweepReceiver other_seed(noise_channel(), grid);
  SweepReceiver twin(noise_channel(), grid_of());
  EXPECT_EQ(noise_sweep(own, 3), noise_sweep(twin, 3));
  for (SweepReceiver* other : {&other_radar, &other_seed}) {
    Correlation sum;
    for (std::uint64_t t = 0; t < 20; ++t) {
      const auto a = noise_powers(own, t), b = noise_powers(*other, t);
      for (std::size_t i = 0; i < a.size(); ++i) sum.add(a[i], b[i]);
    }
    EXPECT_LT(std::fabs(sum.value()), 4.5 / std::sqrt(sum.pairs()));
  }
}

// (sin x / x)^2, x = pi k B / fs: 0.405 and 0 at half the clock.
double law(double ticks, double share) {
  const double x = std::numbers::pi * ticks * share;
  return std::pow(std::sin(x) / x, 2.0);
}

TEST(SweepNoise, NeighbouringTicksAreCorrelatedAsBehindTheFilter) {
  for (const double share : {1.0, 0.5, 0.25, 0.0625}) {
    SweepReceiver receiver(noise_channel(), grid_of(share * 20e6));
    for (const std::size_t lag : {1u, 2u, 5u}) {
      Correlation sum;
      for (std::uint64_t t = 0; t < 200; ++t) {
        const auto p = noise_powers(receiver, t);
        for (std::size_t i = 0; i + lag < p.size(); ++i) sum.add(p[i], p[i + lag]);
      }
      // The torus itself has share * 32768 independent values, three times over.
      const double bound = 4.5 / std::sqrt(3.0 * share * 32768.0) + 0.002;
      EXPECT_NEAR(sum.value(), law(static_cast<double>(lag), share), bound)
          << "share " << share << " lag " << lag;
    }
  }
}

// A clock slower than the bandwidth takes single samples of white noise, no means of them.
TEST(SweepNoise, OfAClockSlowerThanTheFilterIsWhiteAndNoWeaker) {
  SweepReceiver slow(noise_channel(), grid_of(60e6));
  SweepReceiver equal(noise_channel(), grid_of(20e6));
  EXPECT_EQ(noise_sweep(slow, 11), noise_sweep(equal, 11));
}

// Noise belongs to the tick after the trigger, whatever the channel.
TEST(SweepNoise, IsSharedByChannelsOfOtherDelayAndDetector) {
  auto channel = noise_channel(3000);
  SweepReceiver whole(channel, grid_of(7e6));
  channel.delay_ticks = 777;
  channel.samples = 1500;
  SweepReceiver late(channel, grid_of(7e6));
  const auto a = noise_sweep(whole, 4), b = noise_sweep(late, 4);
  EXPECT_TRUE(std::equal(b.begin(), b.end(), a.begin() + 777));

  channel.detector = VideoDetector::log;
  channel.gain_db = 0.0;
  SweepReceiver log(channel, grid_of(7e6));
  const auto c = noise_sweep(log, 4);
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (b[i] < 50 || c[i] == 0) continue;
    const double power = power_of(late.channel(), kLogVideoDb, b[i]);
    EXPECT_NEAR(log.level_of(power, 0), c[i] + 0.5, 0.5 + 16384.0 / 45.0 * 8.7 * 0.6 / b[i]) << i;
  }
}

// Pairs of ticks on the two sides of every joint, over many triggers.
double correlation_across(std::uint32_t tick, double share) {
  auto channel = noise_channel(2);
  channel.delay_ticks = tick - 1;
  SweepReceiver receiver(channel, grid_of(share * 20e6));
  Correlation sum;
  for (std::uint64_t t = 0; t < 20000; ++t) {
    const auto p = noise_powers(receiver, t);
    sum.add(p[0], p[1]);
  }
  return sum.value();
}

TEST(SweepNoise, JoinsItsPiecesWithoutASeamOver32768Ticks) {
  // The scatter of 20 000 pairs, and of the torus.
  const double bound = 4.5 * (1.0 / std::sqrt(20000.0) + 1.0 / std::sqrt(3.0 * 16384.0));
  for (const std::uint32_t joint : {1024u, 4096u, 12288u, 32000u}) {
    EXPECT_NEAR(correlation_across(joint, 0.5), law(1.0, 0.5), bound) << joint;
  }
  EXPECT_NEAR(correlation_across(32768, 0.5), 0.0, bound);  // drawn anew
}

// In one sweep: no stretch of a long sweep comes again.
TEST(SweepNoise, OfALongSweepDoesNotRepeat) {
  SweepReceiver receiver(noise_channel(65536), grid_of());
  const auto p = noise_powers(receiver, 1);
  for (const std::size_t lag : {1024u, 4096u, 16384u, 32768u}) {
    Correlation sum;
    for (std::size_t i = 0; i + lag < p.size(); ++i) sum.add(p[i], p[i + lag]);
    // Three stretches of one torus in one sweep: two begin `lag` apart in one of 1024 sweeps.
    EXPECT_LT(std::fabs(sum.value()), 4.5 / std::sqrt(sum.pairs())) << lag;
  }
}

}  // namespace
}  // namespace skerry::echo
