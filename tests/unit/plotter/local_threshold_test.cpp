// The threshold over blocks: against its plain form, against one over cells, and what each of its
// statistics does beside land.
#include "server/plotter/plots/local_threshold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

using Levels = std::vector<std::uint8_t>;

Levels noise(std::size_t cells, double mean, double sigma, std::uint64_t seed) {
  std::uint64_t state = noise_of(seed);
  Levels levels(cells);
  for (auto& level : levels)
    level =
        static_cast<std::uint8_t>(std::clamp(mean + sigma * next_draw(state) + 0.5, 0.0, 255.0));
  return levels;
}

std::vector<Run> runs_of(LocalThreshold& threshold, const Levels& levels) {
  std::vector<Run> runs;
  threshold.find(levels, runs);
  return runs;
}

// As the header says it, cell by cell and block by block.
std::vector<std::uint8_t> plain_thresholds(const Levels& levels, const LocalThreshold::Rule& rule) {
  constexpr int kBlock = LocalThreshold::kBlock;
  const int cells = static_cast<int>(levels.size()), blocks = (cells + kBlock - 1) / kBlock;
  std::vector<int> means, deviations;
  for (int b = 0; b < blocks; ++b) {
    const int first = b * kBlock, count = std::min(kBlock, cells - first);
    int sum = 0, off = 0;
    for (int i = 0; i < count; ++i) sum += levels[first + i];
    for (int i = 0; i < count; ++i) off += std::abs(levels[first + i] * count - sum);
    means.push_back(sum * 16 / count);
    deviations.push_back(off * 16 / (count * count));
  }
  const auto one_number = [&](const std::vector<int>& values, int b, double rank) {
    std::vector<int> before, after;
    for (int i = 0; i < blocks; ++i) {
      const int away = i - b;
      if (std::abs(away) <= static_cast<int>(rule.guard)) continue;
      if (std::abs(away) > static_cast<int>(rule.around)) continue;
      (away < 0 ? before : after).push_back(values[i]);
    }
    std::vector<int> all = before;
    all.insert(all.end(), after.begin(), after.end());
    if (all.empty()) return 0;
    const auto mean = [](const std::vector<int>& of) {
      int sum = 0;
      for (const int each : of) sum += each;
      return sum / static_cast<int>(of.size());
    };
    if (rule.statistic == Statistic::ordered) {
      std::sort(all.begin(), all.end());
      return all[static_cast<std::size_t>(rank * static_cast<double>(all.size() - 1) + 0.5)];
    }
    if (before.empty() || after.empty() || rule.statistic == Statistic::cell_mean) return mean(all);
    return rule.statistic == Statistic::greatest_of ? std::max(mean(before), mean(after))
                                                    : std::min(mean(before), mean(after));
  };
  std::vector<std::uint8_t> thresholds;
  for (int b = 0; b < blocks; ++b) {
    const int mean = one_number(means, b, rule.rank);
    const int background = std::min(mean, rule.most_background * 16);
    int deviation = one_number(deviations, b, rule.rank);
    if (rule.statistic == Statistic::ordered) {
      const int share = static_cast<int>(rule.spreads / rule.roughnesses * 256.0 + 0.5);
      const int upper = one_number(means, b, LocalThreshold::kUpperRank);
      const int spread = std::clamp(upper - mean - deviation * 5 / 8, 0, 2 * deviation);
      deviation += spread * share >> 8;
    }
    const int steps = static_cast<int>(rule.roughnesses * 256.0 + 0.5);
    const int over = std::max(rule.least_step * 16, (deviation * steps) >> 8);
    thresholds.push_back(static_cast<std::uint8_t>(std::min((background + over) / 16, 255)));
  }
  return thresholds;
}

TEST(LocalThreshold, IsThePlainOneOnEveryInstructionSetAndLength) {
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    echo::force_isa(isa);
    std::uint64_t seed = 0;
    for (const Statistic statistic : {Statistic::ordered, Statistic::cell_mean,
                                      Statistic::greatest_of, Statistic::smallest_of}) {
      for (const std::uint32_t around : {1u, 3u, 5u, 8u}) {
        for (const double rank : {0.0, 0.4, 0.75, 1.0}) {
          LocalThreshold::Rule rule;
          rule.statistic = statistic;
          rule.around = around;
          rule.guard = around / 3;
          rule.rank = rank;
          LocalThreshold threshold(rule);
          for (const std::size_t cells : {0, 1, 15, 16, 17, 100, 177, 250, 512, 705, 1024, 4096}) {
            Levels levels = noise(cells, 60.0, 25.0, ++seed);
            for (std::size_t i = cells / 3; i < cells / 2; ++i) levels[i] = 230;
            (void)runs_of(threshold, levels);
            const auto plain = plain_thresholds(levels, rule);
            ASSERT_TRUE(std::equal(plain.begin(), plain.end(), threshold.thresholds().begin(),
                                   threshold.thresholds().end()))
                << cells << " cells, around " << around << ", rank " << rank;
          }
        }
      }
    }
  }
  echo::force_isa(echo::best_isa());
}

TEST(LocalThreshold, RunsAreTheCellsAboveIt) {
  LocalThreshold threshold;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Levels levels = noise(500 + seed, 20.0, 10.0, seed);
    for (std::size_t i = 0; i < levels.size(); i += 37) levels[i] = 200;
    for (std::size_t i = 90; i < 130; ++i) levels[i] = 150;
    const auto runs = runs_of(threshold, levels);
    std::vector<bool> in(levels.size());
    std::uint32_t last = 0;
    for (const server::Run& run : runs) {
      ASSERT_LT(run.first, run.end);
      ASSERT_TRUE(last == 0 || run.first > last) << "runs that touch are one";
      last = run.end;
      for (std::uint32_t i = run.first; i < run.end; ++i) in[i] = true;
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
      ASSERT_EQ(in[i], levels[i] > threshold.thresholds()[i / LocalThreshold::kBlock]) << i;
  }
}

// Ordered statistics over cells: the background of a block is the cell of that rank among all cells
// of its neighbours, its roughness the way from the cell of rank 0.1 to that of rank 0.4, as mean
// deviations of Gaussian cells (1.03 sigma to 0.77).  Over noise, sea that falls with the range,
// and echoes on up to a quarter of the neighbours.
TEST(LocalThreshold, IsNearTheOneOverCells) {
  LocalThreshold::Rule rule;
  rule.spreads = 0.0;
  LocalThreshold threshold(rule);
  double worst = 0.0, sum = 0.0;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const double sigma = 4.0 + static_cast<double>(seed % 5) * 3.0;
    Levels levels = noise(1024, 40.0, sigma, seed);
    for (std::size_t i = 0; i < levels.size(); ++i)  // the sea
      levels[i] = static_cast<std::uint8_t>(
          std::min(255.0, levels[i] + 40.0 * std::exp(-static_cast<double>(i) / 300.0)));
    for (std::size_t echo = 100 + seed; echo < 1000; echo += 160)
      for (std::size_t i = echo; i < echo + 20; ++i) levels[i] = 220;
    (void)runs_of(threshold, levels);
    for (std::size_t b = rule.around; b + rule.around < threshold.thresholds().size(); ++b) {
      std::vector<double> cells;
      for (std::size_t i = 0; i < threshold.thresholds().size(); ++i) {
        const std::size_t away = i > b ? i - b : b - i;
        if (away <= rule.guard || away > rule.around) continue;
        for (std::size_t k = 0; k < 16; ++k) cells.push_back(levels[i * 16 + k]);
      }
      std::sort(cells.begin(), cells.end());
      const auto of_rank = [&](double rank) {
        return cells[static_cast<std::size_t>(rank * static_cast<double>(cells.size() - 1) + 0.5)];
      };
      const double background = of_rank(rule.rank);
      const double roughness = (background - of_rank(0.1)) * 0.7725 / 1.0283;
      const double over = std::max<double>(rule.least_step, rule.roughnesses * roughness);
      const double difference = threshold.thresholds()[b] - (background + over);
      worst = std::max(worst, std::fabs(difference) / sigma);
      sum += difference / sigma;
      ++count;
    }
  }
  std::printf("over cells: mean difference %.2f sigma, worst %.2f\n",
              sum / static_cast<double>(count), worst);
  EXPECT_LT(std::fabs(sum / static_cast<double>(count)), 0.5);
  EXPECT_LT(worst, 3.0);
}

// Cells that are alike over a pulse, as those of the sea are, need more than noise of the same
// deviation in a block; noise needs hardly more, and land on one side takes no more than clutter.
TEST(LocalThreshold, TheSpreadOfBlocksRaisesItOverTheSeaAlone) {
  const auto mean_raise = [](const Levels& levels, std::size_t from, std::size_t to) {
    LocalThreshold::Rule rule;
    LocalThreshold with(rule);
    rule.spreads = 0.0;
    LocalThreshold without(rule);
    (void)runs_of(with, levels);
    (void)runs_of(without, levels);
    double sum = 0.0;
    for (std::size_t b = from; b < to; ++b) sum += with.thresholds()[b] - without.thresholds()[b];
    return sum / static_cast<double>(to - from);
  };
  const Levels even = noise(4096, 60.0, 10.0, 3);
  EXPECT_LT(mean_raise(even, 8, 248), 2.0);
  // Eight cells alike: half a block.
  Levels sea(4096);
  const Levels draws = noise(512, 60.0, 20.0, 5);
  for (std::size_t i = 0; i < sea.size(); ++i)
    sea[i] = static_cast<std::uint8_t>((draws[i / 8] + even[i]) / 2);
  EXPECT_GT(mean_raise(sea, 8, 248), 4.0);
  Levels land = even;
  for (std::size_t i = 2048; i < land.size(); ++i) land[i] = 190;
  EXPECT_LT(mean_raise(land, 123, 127), 6.0 * 2.0 * 10.0);
}

// Land from 600 cells on, an echo just before it, and noise.
TEST(LocalThreshold, EachStatisticDoesItsOwnBesideLand) {
  Levels levels = noise(1024, 30.0, 6.0, 7);
  for (std::size_t i = 600; i < 1024; ++i) levels[i] = 190;
  const auto threshold_of = [&](Statistic statistic, std::size_t cell) {
    LocalThreshold::Rule rule;
    rule.statistic = statistic;
    rule.most_background = 255;
    LocalThreshold threshold(rule);
    (void)runs_of(threshold, levels);
    return int{threshold.thresholds()[cell / LocalThreshold::kBlock]};
  };
  // The block next to land but one: all of one side is land, all of the other is noise.
  const std::size_t beside = 560;
  EXPECT_GT(threshold_of(Statistic::greatest_of, beside), 190);
  EXPECT_LT(threshold_of(Statistic::smallest_of, beside), 70);
  EXPECT_LT(threshold_of(Statistic::ordered, beside), 70);
  const int mean = threshold_of(Statistic::cell_mean, beside);
  EXPECT_GT(mean, 90);
  EXPECT_LT(mean, threshold_of(Statistic::greatest_of, beside));
  // In the open all are alike.
  for (const Statistic statistic :
       {Statistic::cell_mean, Statistic::greatest_of, Statistic::smallest_of})
    EXPECT_NEAR(threshold_of(statistic, 300), threshold_of(Statistic::ordered, 300), 8);
}

TEST(LocalThreshold, RefusesRulesOutOfTheirRange) {
  const auto refused = [](auto&& change) {
    LocalThreshold::Rule rule;
    change(rule);
    EXPECT_THROW(LocalThreshold{rule}, std::invalid_argument);
  };
  refused([](auto& rule) { rule.statistic = static_cast<Statistic>(9); });
  refused([](auto& rule) { rule.around = 0; });
  refused([](auto& rule) { rule.guard = rule.around; });
  refused([](auto& rule) { rule.rank = std::nan(""); });
  refused([](auto& rule) { rule.roughnesses = -1.0; });
  refused([](auto& rule) { rule.least_step = 0; });
}

}  // namespace
}  // namespace skerry::server
