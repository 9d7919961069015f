#include "echo/sweeps/sweep_receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "echo/receiver/log_video.hpp"
#include "tests/unit/kernel/every_isa.hpp"
#include "tests/unit/sweeps/sweep_setup.hpp"

namespace skerry::echo {
namespace {

// Power at a range between two rows, as the header has it; in double, on its own.
double power_at(double range_m, const std::vector<float>& before, const std::vector<float>& after,
                double share) {
  const double place = range_m / 20.0 - 0.5;
  const auto cell = [&](double i) {
    const auto k = static_cast<std::size_t>(std::clamp(i, 0.0, kCells - 1.0));
    return (1.0 - share) * static_cast<double>(before[k]) + share * static_cast<double>(after[k]);
  };
  if (range_m >= kCells * 20.0) return 0.0;
  const double low = std::floor(place);
  return (1.0 - (place - low)) * cell(low) + (place - low) * cell(low + 1.0);
}

double level(const SweepChannel& c, double power, double range_m) {
  const double full = std::exp2(c.bits);
  const double gain = c.gain_db - stc_db(c.stc, range_m);
  if (c.detector == VideoDetector::log)
    return full / kLogVideoDb * (10.0 * std::log10(power) + kLogVideoDb * 2.0 / 9.0 + gain) +
           c.offset;
  return full * std::sqrt(power) * std::pow(10.0, (gain - kLogVideoDb * 7.0 / 9.0) / 20.0) +
         c.offset;
}

// Rows so strong, 95 to 115 dB over noise, that noise moves a sample by less than 2e-4 dB.
std::vector<float> strong(double phase) {
  return row_of([=](std::size_t i) {
    return 1e9 * std::pow(10.0, 1.0 + std::sin(0.37 * static_cast<double>(i) + phase));
  });
}

TEST(SweepReceiver, MatchesAReferenceInRangeAzimuthAndDetector) {
  const auto before = strong(0.0), after = strong(1.0);
  double worst = 0.0;
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    for (const unsigned bits : {8u, 10u, 12u, 14u}) {
      for (const double clock : {20e6, 33.3e6, 125e6, 4e6}) {
        for (const double share : {0.0, 0.37, 1.0}) {
          for (const std::uint32_t delay : {0u, 5u, 333u}) {
            SweepChannel c;
            c.sample_clock_hz = clock;
            c.delay_ticks = delay;
            c.samples = 1537;
            c.detector = detector;
            c.bits = bits;
            c.gain_db = -80.0;
            c.offset = 2.25;
            SweepReceiver receiver(c, grid_of());
            const auto codes = sweep_of(receiver, before, after, static_cast<float>(share), 1);
            const double top = std::exp2(bits) - 1.0;
            for (std::uint32_t i = 0; i < c.samples; ++i) {
              const double range = (delay + i + 0.5) * metres_per_tick_of(c);
              if (range > 10'239.0) break;
              const double power = power_at(range, before, after, share);
              const double exact = std::clamp(level(c, power, range), 0.0, top);
              // Noise: |n| < 4.5 against an amplitude of 3e4 or more, 1.5e-4; place in
              // range: 1.3e-4 of a tick, slope at most 0.85 of the power a cell; the logarithm's
              // own error.
              const double relative =
                  3e-4 + 0.85 * (1.3e-4 * metres_per_tick_of(c) / 20.0 + 1.2e-7 * 400.0);
              const double allowed = detector == VideoDetector::log
                                         ? std::exp2(bits) / kLogVideoDb *
                                               (4.343 * relative + 1.2e-4 * kDecibelsPerOctave)
                                         : 0.5 * relative * exact;
              const double off = std::max({0.0, codes[i] - exact, exact - (codes[i] + 1.0)});
              worst = std::max(worst, off / (allowed + 1e-3));
              ASSERT_LE(off, allowed + 1e-3)
                  << bits << " bits, clock " << clock << ", share " << share << ", sample " << i;
            }
          }
        }
      }
    }
  }
  std::printf("worst: %.2f of what is allowed\n", worst);
}

// A view of 8 bits has 45 dB in 256 steps too.
TEST(SweepReceiver, PutsNoiseAboveZeroAndFullScaleAt35DecibelsOverIt) {
  SweepChannel c;
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    c.detector = detector;
    SweepReceiver receiver(c, grid_of());
    EXPECT_NEAR(receiver.level_of(std::pow(10.0, 3.5), 100), 4096.0, 0.01);
    const auto codes = noise_sweep(receiver, 1);
    const auto zeros = std::count(codes.begin(), codes.end(), 0);
    // 1 - exp(-0.1) of 2048 lie below 10 dB under the mean; 5 deviations.
    const double share = detector == VideoDetector::log ? 1.0 - std::exp(-0.1) : 0.0;
    EXPECT_NEAR(static_cast<double>(zeros), 2048.0 * share,
                5.0 * std::sqrt(2048.0 * share * (1.0 - share)) + 3.0);
  }
  c.detector = VideoDetector::log;
  c.bits = 8;
  SweepReceiver receiver(c, grid_of());
  EXPECT_NEAR(receiver.level_of(10.0, 0) - receiver.level_of(1.0, 0), 10.0 * 256.0 / 45.0, 1e-9);
}

TEST(SweepReceiver, ASteadyEchoIsRicianAndAStrongOneFillsTheScale) {
  const auto echo = row_of([](std::size_t) { return 10.0; });
  SweepChannel c = noise_channel();
  c.gain_db = 0.0;
  SweepReceiver receiver(c, grid_of());
  double sum = 0.0, squares = 0.0, n = 0.0;
  for (std::uint64_t t = 0; t < 100; ++t) {
    const auto codes = sweep_of(receiver, echo, echo, 0.5f, t);
    for (std::size_t i = 0; i < 1300; ++i) {
      const double p = power_of(c, kLogVideoDb, codes[i]);
      sum += p, squares += p * p, n += 1.0;
    }
  }
  EXPECT_NEAR(sum / n, 11.0, 5.0 * std::sqrt(21.0 / n));
  EXPECT_NEAR(squares / n - sum * sum / n / n, 21.0, 21.0 * 5.0 * std::sqrt(3.0 / n));
  const auto strongest = row_of([](std::size_t) { return 9e29; });
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    c.detector = detector;
    SweepReceiver full(c, grid_of());
    const auto codes = sweep_of(full, strongest, strongest, 0.5f, 1);
    EXPECT_EQ(std::count(codes.begin(), codes.begin() + 1300, 16383), 1300);
  }
}

TEST(SweepReceiver, LogNoiseHasTheSpreadOfItsLawAndGainLiftsItByDecibels) {
  auto grid = grid_of();
  grid.video_range_db = 90.0;  // from -40 dB on at this gain: 1e-4 of noise is cut off
  for (const double gain : {20.0, 30.0}) {
    SweepChannel c;
    c.bits = 14;
    c.gain_db = gain;
    SweepReceiver receiver(c, grid);
    double sum = 0.0, squares = 0.0, n = 0.0;
    for (std::uint64_t t = 0; t < 200; ++t) {
      for (const double code : noise_sweep(receiver, t)) {
        const double db = (code + 0.5) * 90.0 / 16384.0 - 20.0 - gain;
        sum += db, squares += db * db, n += 1.0;
      }
    }
    EXPECT_NEAR(sum / n, -2.5068, 0.04) << gain;
    EXPECT_NEAR(std::sqrt(squares / n - sum * sum / n / n), 5.57, 0.05) << gain;
  }
}

TEST(SweepReceiver, StcActsByRangeOnEchoAndNoise) {
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    SweepChannel c;
    c.detector = detector;
    c.delay_ticks = 3;
    c.samples = 5000;
    c.stc = 60.0;
    SweepReceiver with(c, grid_of());
    c.stc = 0.0;
    SweepReceiver without(c, grid_of());
    for (const std::uint32_t tick : {0u, 10u, 700u, 1185u, 1200u, 4999u}) {
      const double loss = stc_db(60.0, (3 + tick + 0.5) * metres_per_tick_of(c));
      const double before = without.level_of(1e5, tick);
      const double expected = detector == VideoDetector::log
                                  ? before - loss * 4096.0 / 45.0
                                  : before * std::pow(10.0, -loss / 20.0);
      EXPECT_NEAR(with.level_of(1e5, tick), expected, 1e-3 + 2e-7 * std::fabs(before));
    }
    const auto a = noise_sweep(with, 1), b = noise_sweep(without, 1);
    EXPECT_TRUE(std::all_of(a.begin(), a.begin() + 20, [](auto code) { return code == 0; }));
    EXPECT_TRUE(std::equal(a.begin() + 1190, a.end(), b.begin() + 1190));
  }
}

TEST(SweepReceiver, InvertsOffsetsAndClampsAsAConverterDoes) {
  const auto echo = row_of([](std::size_t i) { return i < 256 ? 1e6 : 0.0; });
  SweepChannel c;
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    c = {};
    c.detector = detector;
    SweepReceiver plain(c, grid_of());
    c.inverted = true;
    SweepReceiver inverted(c, grid_of());
    c.inverted = false;
    c.offset = 100.0;
    SweepReceiver raised(c, grid_of());
    c.offset = -300.0;
    SweepReceiver lowered(c, grid_of());
    const auto p = sweep_of(plain, echo, echo, 0.0f, 9),
               i = sweep_of(inverted, echo, echo, 0.0f, 9);
    const auto r = sweep_of(raised, echo, echo, 0.0f, 9),
               l = sweep_of(lowered, echo, echo, 0.0f, 9);
    EXPECT_EQ(*std::max_element(p.begin(), p.end()), 4095);
    for (std::size_t k = 0; k < p.size(); ++k) {
      ASSERT_EQ(i[k], 4095 - p[k]);
      if (p[k] > 0) {
        ASSERT_NEAR(r[k], std::min(4095, p[k] + 100), p[k] == 4095 ? 0.0 : 1.0);
      }
      if (p[k] < 4095) {
        ASSERT_NEAR(l[k], std::max(0, p[k] - 300), 1.0);
      }
    }
  }
}

TEST(SweepReceiver, IsBlindBeforeItsMinimumRangeAndSeesOnlyNoiseBeyondItsGrid) {
  const auto echo = row_of([](std::size_t) { return 1e8; });
  auto grid = grid_of();
  grid.blind_m = 60.0;
  for (const bool inverted : {false, true}) {
    SweepChannel c;
    c.samples = 4000;
    c.offset = 17.9;
    c.inverted = inverted;
    SweepReceiver receiver(c, grid);
    auto codes = sweep_of(receiver, echo, echo, 0.5f, 2);
    auto noise = noise_sweep(receiver, 2);
    if (inverted) {
      for (auto* all : {&codes, &noise})
        for (auto& code : *all) code = static_cast<std::uint16_t>(4095 - code);
    }
    const double tick_m = metres_per_tick_of(c);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const double range = (static_cast<double>(i) + 0.5) * tick_m;
      if (range < 60.0) {
        ASSERT_EQ(codes[i], 17) << i;
      } else if (range < 10'240.0) {
        ASSERT_EQ(codes[i], 4095) << i;
      } else {
        ASSERT_EQ(codes[i], noise[i]) << i;
      }
    }
  }
}

TEST(SweepReceiver, TakesOneMissingRowAsSilenceAndTwoAsNoiseAlone) {
  const auto echo = row_of([](std::size_t) { return 1e8; });
  const auto silence = row_of([](std::size_t) { return 0.0; });
  SweepReceiver receiver(SweepChannel{}, grid_of());
  EXPECT_EQ(sweep_of(receiver, echo, {}, 0.75f, 1), sweep_of(receiver, echo, silence, 0.75f, 1));
  EXPECT_EQ(sweep_of(receiver, {}, {}, 0.75f, 1), sweep_of(receiver, silence, silence, 0.75f, 1));
  const std::vector<float> other_size(100, 1e8f);
  EXPECT_EQ(sweep_of(receiver, other_size, other_size, 0.5f, 1), noise_sweep(receiver, 1));
}

TEST(SweepReceiver, DecimatesTheCodesOfEveryTick) {
  const auto before = row_of([](std::size_t i) { return i % 50 == 7 ? 300.0 : 0.5; });
  const auto after = row_of([](std::size_t i) { return i % 50 == 9 ? 300.0 : 2.0; });
  for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
    for (const std::uint32_t group : {2u, 3u, 4u, 5u, 8u, 11u, 16u, 700u}) {
      SweepChannel c;
      c.sample_clock_hz = 60e6;
      c.delay_ticks = 29;
      c.detector = detector;
      c.bits = 10;
      c.inverted = group % 2 == 1;
      c.samples = 9001 / group * group;
      SweepReceiver every_tick(c, grid_of());
      const auto raw = sweep_of(every_tick, before, after, 0.4f, 77);
      c.samples /= group;
      c.decimation = group;
      for (const CodeDecimation mode :
           {CodeDecimation::peak, CodeDecimation::mean, CodeDecimation::sum}) {
        c.mode = mode;
        SweepReceiver decimating(c, grid_of());
        const auto codes = sweep_of(decimating, before, after, 0.4f, 77);
        for (std::size_t g = 0; g < codes.size(); ++g) {
          std::uint32_t peak = 0, sum = 0;
          for (std::size_t k = g * group; k < (g + 1) * group; ++k) {
            peak = std::max<std::uint32_t>(peak, raw[k]);
            sum += raw[k];
          }
          const std::uint32_t expected = mode == CodeDecimation::peak   ? peak
                                         : mode == CodeDecimation::mean ? (sum + group / 2) / group
                                                                        : std::min(sum, 65535u);
          ASSERT_EQ(codes[g], expected) << "group " << group << " sample " << g;
        }
      }
    }
  }
}

TEST(SweepReceiver, TakesGridsAndSweepsOfAnySize) {
  for (const std::uint32_t cells : {1u, 2u, 3u, 100u, 5000u}) {
    for (const double cell_m : {0.5, 7.5, 3000.0}) {
      for (const std::uint32_t samples : {0u, 1u, 2u, 1023u, 1025u, 40000u}) {
        SweepEchoes::Grid grid = grid_of();
        grid.cells = cells;
        grid.cell_m = cell_m;
        SweepChannel c;
        c.samples = samples;
        SweepReceiver receiver(c, grid);
        const std::vector<float> echo(cells, 1e8f);
        const auto codes = sweep_of(receiver, echo, echo, 1.0f, 3);
        const double lit = std::ceil(cells * cell_m / metres_per_tick_of(c) - 0.5);
        const auto ticks = static_cast<std::size_t>(std::clamp(lit, 0.0, 1.0 * samples));
        EXPECT_TRUE(std::all_of(codes.begin(), codes.begin() + static_cast<std::ptrdiff_t>(ticks),
                                [](auto code) { return code == 4095; }))
            << cells << " cells of " << cell_m << " m, " << samples << " samples";
        EXPECT_TRUE(std::all_of(codes.begin() + static_cast<std::ptrdiff_t>(ticks), codes.end(),
                                [](auto code) { return code < 4095; }));
      }
    }
  }
}

TEST(SweepReceiver, GivesTheSameCodesOnEveryInstructionSet) {
  const auto before = strong(0.3), after = row_of([](std::size_t i) { return i % 3 ? 5.0 : 0.0; });
  std::vector<std::vector<std::uint16_t>> first;
  on_every_isa([&] {
    std::vector<std::vector<std::uint16_t>> all;
    for (const VideoDetector detector : {VideoDetector::log, VideoDetector::linear}) {
      for (const std::uint32_t group : {1u, 4u, 7u}) {
        SweepChannel c;
        c.sample_clock_hz = 31.7e6;
        c.detector = detector;
        c.bits = 14;
        c.stc = 30.0;
        c.decimation = group;
        c.mode = CodeDecimation::mean;
        SweepReceiver receiver(c, grid_of(3e6));
        all.push_back(sweep_of(receiver, before, after, 0.0f, 5));
        all.push_back(sweep_of(receiver, before, after, 1.0f, 6));
        all.push_back(sweep_of(receiver, after, before, 1e-7f, 7));
      }
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  });
}

TEST(SweepCells, AreWholeTicksThatReachAsFarAsIsWished) {
  SweepEchoes::Wish wish;
  wish.reach_m = 15'348.0;
  EXPECT_DOUBLE_EQ(sweep_cell_m(wish, 4096), 15'348.0 / 4096);
  wish.tick_m = 0.5 * kLightSpeed / 20e6;
  wish.reach_m = 2048 * wish.tick_m;
  EXPECT_DOUBLE_EQ(sweep_cell_m(wish, 4096), wish.tick_m);
  wish.reach_m = 4096 * wish.tick_m;
  EXPECT_DOUBLE_EQ(sweep_cell_m(wish, 4096), wish.tick_m);
  wish.reach_m = 4097 * wish.tick_m;
  EXPECT_DOUBLE_EQ(sweep_cell_m(wish, 4096), 2.0 * wish.tick_m);
  wish.reach_m = 41'664 * wish.tick_m;
  EXPECT_DOUBLE_EQ(sweep_cell_m(wish, 4096), 11.0 * wish.tick_m);
}

}  // namespace
}  // namespace skerry::echo
