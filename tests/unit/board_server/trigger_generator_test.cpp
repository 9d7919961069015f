#include "server/board/trigger_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "protocol/board/contradiction.hpp"

namespace skerry::server {
namespace {

std::vector<Tick> ticks_of(TriggerGenerator& triggers, std::size_t count) {
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < count; ++i, triggers.pop()) ticks.push_back(triggers.next());
  return ticks;
}

// 20 MHz at 2000 Hz: 10,000 ticks.
TriggerSettings even() { return {.prf_millihertz = 2'000'000, .seed = 7}; }

TEST(TriggerGenerator, JitterIsUniformToEitherSide) {
  TriggerSettings settings = even();
  settings.jitter_ppm = 100'000;
  TriggerGenerator triggers(settings);
  const auto ticks = ticks_of(triggers, 200'000);
  std::vector<int> counts(10);
  double sum = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < ticks.size(); ++n) {
    // All come 1000 ticks later, so that none comes early.
    const double off = static_cast<double>(ticks[n]) - static_cast<double>(n) * 10'000.0 - 1000.0;
    ASSERT_LE(std::fabs(off), 1000.0);
    sum += off;
    squares += off * off;
    ++counts[static_cast<std::size_t>(std::min(9.0, (off + 1000.0) / 200.1))];
  }
  const double n = static_cast<double>(ticks.size());
  // Four standard errors of a uniform deviation of +-1000 ticks: 577 of one, 1.3 of the mean.
  EXPECT_NEAR(sum / n, 0.0, 5.2);
  EXPECT_NEAR(std::sqrt(squares / n), 577.6, 3.0);
  // Binomial: standard deviation 134.
  for (const int count : counts) EXPECT_NEAR(count, 20'000, 600);
}

TEST(TriggerGenerator, StaggerIsLongerAndShorterByTurns) {
  TriggerSettings settings = even();
  settings.stagger_ppm = 50'000;
  TriggerGenerator triggers(settings);
  const auto ticks = ticks_of(triggers, 1001);
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    EXPECT_EQ(ticks[n] - ticks[n - 1], n % 2 == 1 ? 9000u : 11'000u);
  }
}

TEST(TriggerGenerator, TriggersNeverChangePlacesAndKeepTheShortestPeriod) {
  TriggerSettings settings = even();
  settings.jitter_ppm = settings.stagger_ppm = 200'000;
  const Tick shortest = board::shortest_trigger_period(settings.clock_hz, settings.prf_millihertz,
                                                       settings.jitter_ppm, settings.stagger_ppm);
  EXPECT_EQ(shortest, 2000u);
  TriggerGenerator triggers(settings);
  const auto ticks = ticks_of(triggers, 100'000);
  Tick least = 1'000'000;
  for (std::size_t n = 1; n < ticks.size(); ++n) {
    ASSERT_GT(ticks[n], ticks[n - 1]);
    least = std::min(least, ticks[n] - ticks[n - 1]);
  }
  EXPECT_GE(least, shortest);
  EXPECT_LT(least, shortest + 50);
}

TEST(TriggerGenerator, SkippingAndCountingAgreeWithGoingOneByOne) {
  for (const std::uint32_t jitter : {0u, 200'000u}) {
    TriggerSettings settings{.clock_hz = 99'999'989, .prf_millihertz = 2'345'678, .seed = 3};
    settings.jitter_ppm = jitter;
    settings.stagger_ppm = jitter;
    TriggerGenerator one(settings), far(settings);
    Tick from = 0;
    for (int i = 0; i < 300; ++i) {
      const Tick to = from + static_cast<Tick>(i) * 1771;
      std::uint64_t count = 0;
      for (; one.next() < to; one.pop()) ++count;
      EXPECT_EQ(far.count(from, to), count);
      EXPECT_EQ(far.skip_to(to), count);
      EXPECT_EQ(far.next(), one.next());
      from = to;
    }
  }
}

TEST(TriggerGenerator, AnotherPrfTakesOverOnePeriodAfterTheLastTrigger) {
  TriggerGenerator triggers(even());
  ticks_of(triggers, 3);  // the last at 20,000
  TriggerSettings slower = even();
  slower.prf_millihertz = 1'000'000;
  triggers.set(slower, 25'000);
  EXPECT_EQ(triggers.next(), 40'000u);
  triggers.set(even(), 45'000);
  EXPECT_EQ(triggers.next(), 45'000u) << "long due";
  triggers.set(even(), 46'000);
  EXPECT_EQ(triggers.next(), 45'000u) << "nothing has changed";
}

}  // namespace
}  // namespace skerry::server
