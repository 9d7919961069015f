#include "server/fleet/order_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/fleet/fleet_kit.hpp"

namespace skerry::fleet {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

// Orders are appended while the watch is cut, delayed and has its history compacted.
TEST(OrderWatch, GivesEachOrderOnceInOrderWhateverHappens) {
  std::uint64_t cuts = 0, compacted = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Led led;
    Host reader(led.cluster, led.time, "host-b", seed);
    reader.keys.faults = {0.1, 0.1, 0.0, 0.2};
    OrderWatch watch(reader.keys, reader.mark, kExercise, 1);
    std::mt19937_64 random(seed);
    std::vector<OrderSeen> seen;
    std::vector<Revision> revisions;
    const auto look = [&] {
      const auto events = watch.next(led.in(milliseconds(100)));
      if (!events) {
        ++cuts;
        compacted += events.error().trouble == Trouble::compacted;
        EXPECT_FALSE(events.error().text.empty());
        return false;
      }
      for (const LogEvent& event : *events) {
        revisions.push_back(revision_of(event));
        if (const auto* order = std::get_if<OrderSeen>(&event)) seen.push_back(*order);
      }
      return events->empty();
    };
    for (int i = 0; i < 150; ++i) {
      led.cluster.lead_anew(led.time);
      ASSERT_TRUE(led.host.orders.append(
          order_wish("o" + std::to_string(i), led.epoch, led.grant, 4), led.in(seconds(1))));
      if (random() % 8 == 0) {
        const auto grant =
            led.host.orders.grant({led.epoch, led.grant, 4, Duration(i)}, led.in(seconds(1)));
        ASSERT_TRUE(grant);
        led.grant = grant->revision;
      }
      if (random() % 20 == 0) led.cluster.compact(led.cluster.revision() - random() % 5);
      if (random() % 3 == 0) look();
    }
    reader.keys.faults = {};
    while (!look()) {
    }
    ASSERT_THAT(seen, SizeIs(150)) << "seed " << seed;
    for (int i = 0; i < 150; ++i) ASSERT_EQ(seen[i].id, "o" + std::to_string(i)) << "seed " << seed;
    EXPECT_TRUE(std::is_sorted(revisions.begin(), revisions.end()));
  }
  EXPECT_GT(cuts, 500u);
  EXPECT_GT(compacted, 20u);
}

TEST(OrderWatch, GoesOnBehindWhatWasRead) {
  Led led;
  ASSERT_TRUE(led.host.orders.append(order_wish("a", led.epoch, led.grant, 4), led.in(seconds(1))));
  const auto text = led.host.orders.read(1, led.in(seconds(1)));
  ASSERT_TRUE(text);
  ASSERT_TRUE(led.host.orders.append(order_wish("b", led.epoch, led.grant, 4), led.in(seconds(1))));
  OrderWatch watch(led.host.keys, led.host.mark, kExercise, text->at + 1);
  const auto events = watch.next(led.in(seconds(1)));
  ASSERT_TRUE(events);
  ASSERT_THAT(*events, SizeIs(1));
  EXPECT_EQ(std::get<OrderSeen>(events->front()).id, "b");
}

TEST(OrderWatch, GivesWhatHostsTellOfThemselves) {
  Led led;
  OrderWatch watch(led.host.keys, led.host.mark, kExercise, led.cluster.revision() + 1);
  Transaction note;
  note.puts = {{led.host.orders.keys().note("host-a"), "well", 0},
               {led.host.orders.keys().note("host b"), "no name", 0},
               {led.host.orders.keys().note("host-c"), std::string(kMostNote + 1, 'x'), 0}};
  ASSERT_TRUE(led.host.keys.transact(note, led.in(seconds(1))));
  const auto events = watch.next(led.in(seconds(1)));
  ASSERT_TRUE(events);
  ASSERT_THAT(*events, SizeIs(1));
  EXPECT_EQ(std::get<NoteSeen>(events->front()).host, "host-a");
  EXPECT_EQ(std::get<NoteSeen>(events->front()).note, "well");
}

TEST(OrderWatch, TellsAfterCompactionWhoHoldsNothingAnyMore) {
  Led led;
  Host other(led.cluster, led.time, "host-b");
  OrderWatch watch(other.keys, other.mark, kExercise, 1);
  while (watch.from() <= led.cluster.revision()) ASSERT_TRUE(watch.next(led.in(seconds(1))));
  led.time += seconds(3);
  led.cluster.run_to(led.time);
  led.cluster.compact(led.cluster.revision());
  const auto error = watch.next(led.in(seconds(1)));
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().trouble, Trouble::compacted);
  const auto events = watch.next(led.in(seconds(1)));
  ASSERT_TRUE(events);
  ASSERT_THAT(*events, SizeIs(1));
  EXPECT_EQ(std::get<HolderSeen>(events->front()).name, kLeader);
  EXPECT_EQ(std::get<HolderSeen>(events->front()).host, "");
}

// A watch on an older store would wait in silence for the revisions that it has had.
TEST(OrderWatch, SaysThatTheStoreWentBack) {
  Led led;
  const MemoryCluster backup = led.cluster;
  OrderWatch watch(led.host.keys, led.host.mark, kExercise, 1);
  ASSERT_TRUE(led.host.orders.append(order_wish("a", led.epoch, led.grant, 4), led.in(seconds(1))));
  while (watch.from() <= led.cluster.revision()) ASSERT_TRUE(watch.next(led.in(seconds(1))));
  led.cluster = backup;
  led.cluster.has_majority = false;  // as while it is restored
  EXPECT_FALSE(watch.next(led.in(milliseconds(100))));
  led.cluster.has_majority = true;
  for (int i = 0; i < 2; ++i) {
    const auto events = watch.next(led.in(milliseconds(100)));
    ASSERT_FALSE(events);
    EXPECT_EQ(events.error().trouble, Trouble::went_back);
  }
}

// A member that is stopped keeps the connection and says nothing.
TEST(OrderWatch, AsksAnotherMemberAfterASilence) {
  Led led;
  OrderWatch watch(led.host.keys, led.host.mark, kExercise, led.cluster.revision() + 1);
  const auto turns = led.host.keys.turns;
  for (int i = 0; i < 30; ++i) {
    led.cluster.lead_anew(led.time);
    const auto events = watch.next(led.in(milliseconds(100)));
    ASSERT_TRUE(events);
    EXPECT_THAT(*events, IsEmpty());
  }
  EXPECT_GE(led.host.keys.turns - turns, 1u);
}

}  // namespace
}  // namespace skerry::fleet
