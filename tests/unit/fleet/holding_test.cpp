#include "server/fleet/holding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/fleet/fleet_kit.hpp"

namespace skerry::fleet {
namespace {

using testing::Optional;

struct TwoHosts {
  MemoryCluster cluster;
  HostTime time = kBegin;
  Host a{cluster, time, "host-a", 1};
  Host b{cluster, time, "host-b", 2};
  Holding::Status step(Host& host) { return host.leader.step(time + milliseconds(500)); }
};

TEST(Holding, IsOfOneHostAtATime) {
  TwoHosts two;
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::holds);
  const auto other = two.step(two.b);
  EXPECT_EQ(other.standing, Holding::Standing::other_holds);
  EXPECT_EQ(other.holder, "host-a");
  EXPECT_TRUE(two.a.leader.held(two.time).has_value());
  EXPECT_FALSE(two.b.leader.held(two.time).has_value());
  two.a.leader.release(two.time + seconds(1));
  EXPECT_FALSE(two.a.leader.held(two.time).has_value());
  EXPECT_EQ(two.step(two.b).standing, Holding::Standing::holds);
}

TEST(Holding, KeepsItsEpochWhileItIsKept) {
  TwoHosts two;
  two.step(two.a);
  const auto epoch = two.a.leader.held(two.time);
  for (int i = 0; i < 100; ++i) {
    two.time += milliseconds(500);
    EXPECT_EQ(two.step(two.a).standing, Holding::Standing::holds);
    EXPECT_EQ(two.a.leader.held(two.time), epoch);
    EXPECT_EQ(two.step(two.b).standing, Holding::Standing::other_holds);
  }
}

TEST(Holding, EndsByTheHoldersClockBeforeAnotherHasIt) {
  TwoHosts two;
  two.step(two.a);
  const Epoch first = two.a.leader.held(two.time).value();
  two.a.keys.is_cut = true;
  for (int i = 0; i < 300 && !two.b.leader.held(two.time); ++i) {
    two.time += milliseconds(10);
    two.step(two.b);
    EXPECT_FALSE(two.a.leader.held(two.time) && two.b.leader.held(two.time));
  }
  ASSERT_TRUE(two.b.leader.held(two.time).has_value());
  EXPECT_GT(*two.b.leader.held(two.time), first);
  two.a.keys.is_cut = false;
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::other_holds);
}

// The store's leader died with nobody to take the name: the same holding goes on.
TEST(Holding, GoesOnWithItsEpochIfNobodyTookIt) {
  TwoHosts two;
  two.step(two.a);
  const auto epoch = two.a.leader.held(two.time);
  two.cluster.has_majority = false;
  two.time += seconds(4);
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::unknown);
  EXPECT_FALSE(two.a.leader.held(two.time).has_value());
  two.cluster.lead_anew(two.time);
  two.cluster.has_majority = true;
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::holds);
  EXPECT_EQ(two.a.leader.held(two.time), epoch);
}

TEST(Holding, IsTakenAnewUnderAnotherEpochAfterItRanOut) {
  TwoHosts two;
  two.step(two.a);
  const Epoch epoch = two.a.leader.held(two.time).value();
  two.time += seconds(3);
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::holds);
  EXPECT_GT(two.a.leader.held(two.time).value(), epoch);
}

TEST(Holding, IsNotOfWhoseKeyWasDeleted) {
  TwoHosts two;
  two.step(two.a);
  const auto epoch = two.a.leader.held(two.time).value();
  // By hand, and given to another.
  Transaction t;
  t.puts = {{two.a.orders.keys().name(kLeader), "by-hand", 0}};
  (void)two.cluster.transact(t, two.time);
  EXPECT_EQ(two.step(two.a).standing, Holding::Standing::other_holds);
  EXPECT_FALSE(two.a.leader.held(two.time).has_value()) << epoch;
}

// Three hosts, lost requests and replies, cuts, elections of the store, pauses of hosts.
TEST(Holding, IsNeverOfTwoAtOnce) {
  std::uint64_t changes = 0, ended_by_clock = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    MemoryCluster cluster;
    HostTime time = kBegin;
    std::vector<std::unique_ptr<Host>> hosts;
    for (std::uint64_t i = 0; i < 3; ++i) {
      hosts.push_back(
          std::make_unique<Host>(cluster, time, "host-" + std::to_string(i), 10 * seed + i));
      hosts.back()->keys.faults = {0.05, 0.1, 0.05, 0.0};
    }
    std::mt19937_64 random(seed);
    std::map<Epoch, std::size_t> holder;
    Epoch newest = 0;
    const auto look = [&] {
      int held = 0;
      for (std::size_t i = 0; i < hosts.size(); ++i) {
        const auto epoch = hosts[i]->leader.held(time);
        if (!epoch) continue;
        ++held;
        const auto [known, is_new] = holder.emplace(*epoch, i);
        EXPECT_EQ(known->second, i) << "seed " << seed << ": two holders of epoch " << *epoch;
        EXPECT_GE(*epoch, newest);
        newest = std::max(newest, *epoch);
        changes += is_new;
      }
      ASSERT_LE(held, 1) << "seed " << seed;
    };
    std::array<HostTime, 3> paused{};
    for (int i = 0; i < 600; ++i) {
      const std::size_t h = random() % 3;
      if (random() % 60 == 0) hosts[h]->keys.is_cut = !hosts[h]->keys.is_cut;
      if (random() % 80 == 0) {
        cluster.has_majority = !cluster.has_majority;
        if (cluster.has_majority) cluster.lead_anew(time);
      }
      if (random() % 60 == 0) paused[h] = time + milliseconds(random() % 5000);
      if (time >= paused[h]) {
        const bool had = hosts[h]->leader.held(time).has_value();
        const auto status = hosts[h]->leader.step(time + milliseconds(300));
        ended_by_clock +=
            had && status.standing == Holding::Standing::unknown && !hosts[h]->leader.held(time);
      }
      time += milliseconds(random() % 200);
      cluster.run_to(time);
      look();
    }
  }
  EXPECT_GT(changes, 300u);
  EXPECT_GT(ended_by_clock, 10u);
}

}  // namespace
}  // namespace skerry::fleet
