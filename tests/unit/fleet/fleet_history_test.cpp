// The rule of ExerciseLog over random histories of fleets.
#include "tests/unit/fleet/fleet_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <utility>

namespace skerry::fleet {
namespace {

using testing::IsEmpty;

// Histories that broke one of the rules.
int broken(Sabotage sabotage, std::uint64_t seeds) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    HistoryPlan plan{seed};
    plan.sabotage = sabotage;
    count += !run_history(plan).violations.empty();
  }
  return count;
}

// For the sanitizers, under which the many of the next test take minutes.
TEST(FleetHistory, HoldsInAFew) {
  for (std::uint64_t seed = 200; seed < 206; ++seed)
    EXPECT_THAT(run_history(HistoryPlan{seed}).violations, IsEmpty());
}

TEST(FleetHistory, AllHostsApplyTheSameOrdersAtTheSameTicks) {
  History sum;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    HistoryPlan plan{seed};
    plan.hosts = 2 + seed % 4;
    const History history = run_history(plan);
    ASSERT_THAT(history.violations, IsEmpty());
    sum.acknowledged += history.acknowledged;
    sum.refused += history.refused;
    sum.overtaken += history.overtaken;
    sum.deposed += history.deposed;
    sum.free_runs += history.free_runs;
    sum.conflicts += history.conflicts;
    sum.came_back += history.came_back;
    sum.reborn += history.reborn;
    sum.leaders += history.leaders;
    sum.late_replies += history.late_replies;
    sum.ticks_followed += history.ticks_followed;
    sum.ticks_free += history.ticks_free;
  }
  std::printf(
      "%llu orders acknowledged, %llu refusals, %llu overtaken, %llu deposed, %llu leaders, "
      "%llu free runs, %llu conflicts, %llu came back, %llu reborn; %llu ticks followed, %llu "
      "free\n",
      static_cast<unsigned long long>(sum.acknowledged),
      static_cast<unsigned long long>(sum.refused), static_cast<unsigned long long>(sum.overtaken),
      static_cast<unsigned long long>(sum.deposed), static_cast<unsigned long long>(sum.leaders),
      static_cast<unsigned long long>(sum.free_runs),
      static_cast<unsigned long long>(sum.conflicts),
      static_cast<unsigned long long>(sum.came_back), static_cast<unsigned long long>(sum.reborn),
      static_cast<unsigned long long>(sum.ticks_followed),
      static_cast<unsigned long long>(sum.ticks_free));
  // The histories hold what they are to show.
  EXPECT_GT(sum.acknowledged, 10000u);
  EXPECT_GT(sum.overtaken, 100u);
  EXPECT_GT(sum.deposed, 20u);
  EXPECT_GT(sum.free_runs, 500u);
  EXPECT_GT(sum.conflicts, 100u);
  EXPECT_EQ(sum.conflicts, sum.came_back);
  EXPECT_GT(sum.leaders, 300u);
  EXPECT_GT(sum.late_replies, 1000u);
  EXPECT_GT(sum.reborn, 100u);
}

TEST(FleetHistory, ShowsWhatEachPartOfTheRuleIsFor) {
  for (const auto& [sabotage, name] : {std::pair{Sabotage::no_fence, "no fence"},
                                       {Sabotage::any_grant, "any grant"},
                                       {Sabotage::loose_grants, "loose grants"},
                                       {Sabotage::trusted_reply, "trusted reply"},
                                       {Sabotage::runs_ahead, "runs ahead"},
                                       {Sabotage::silent, "silent"},
                                       {Sabotage::twice, "twice"}}) {
    const int seen = broken(sabotage, 20);
    std::printf("%s: seen in %d of 20 histories\n", name, seen);
    EXPECT_GT(seen, 5) << name;
  }
}

}  // namespace
}  // namespace skerry::fleet
