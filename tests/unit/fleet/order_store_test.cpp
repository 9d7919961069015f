#include "server/fleet/order_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/unit/fleet/fleet_kit.hpp"

namespace skerry::fleet {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(OrderStore, AppendsInTheOrderOfRevisions) {
  Led led;
  for (const char* id : {"c", "a", "b"}) {
    const auto appended =
        led.host.orders.append(order_wish(id, led.epoch, led.grant, 4), led.in(seconds(1)));
    ASSERT_TRUE(appended) << appended.error().text;
    EXPECT_EQ(appended->tick, 4u);
    EXPECT_FALSE(appended->was_there);
  }
  const auto text = led.host.orders.read(1, led.in(seconds(1)));
  ASSERT_TRUE(text) << text.error().text;
  ASSERT_THAT(text->orders, SizeIs(3));
  EXPECT_EQ(text->orders[0].id, "c");
  EXPECT_EQ(text->orders[1].id, "a");
  EXPECT_EQ(text->orders[2].id, "b");
  EXPECT_LT(text->orders[1].revision, text->orders[2].revision);
  EXPECT_EQ(text->grant->to, 3u);
  ASSERT_THAT(text->holders, SizeIs(1));
  EXPECT_EQ(text->holders[0].host, "host-a");
  EXPECT_EQ(text->holders[0].epoch, led.epoch);

  const auto later = led.host.orders.read(text->orders[1].revision, led.in(seconds(1)));
  ASSERT_TRUE(later);
  EXPECT_THAT(later->orders, SizeIs(2));
  EXPECT_FALSE(later->grant.has_value());
}

// 4,000 appends over a store that loses and delays: each is repeated until it is answered.
TEST(OrderStore, PutsEachOrderOnceWhateverIsLost) {
  std::uint64_t there = 0, unknown = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Led led;
    led.host.keys.faults = {0.1, 0.1, 0.1, 0.0};
    std::map<std::string, Revision> told;
    std::mt19937_64 random(seed);
    MemoryStore other(led.cluster, led.time, seed);
    for (int i = 0; i < 100; ++i) {
      const std::string id = "o" + std::to_string(random() % 60);
      for (;;) {
        const auto appended = led.host.orders.append(order_wish(id, led.epoch, led.grant, 4),
                                                     led.in(milliseconds(random() % 900)));
        if (!appended) {
          ASSERT_TRUE(appended.error().maybe_done) << appended.error().text;
          ++unknown;
          continue;
        }
        there += appended->was_there;
        const auto [former, is_new] = told.emplace(id, appended->revision);
        EXPECT_EQ(former->second, appended->revision) << "seed " << seed << " " << id;
        break;
      }
      // The lease is not kept here: what is under way may come when nobody leads.
      (void)led.host.leader.step(led.in(seconds(1)));
      if (led.host.leader.held(led.time) != led.epoch) break;
    }
    led.host.keys.faults = {};
    led.cluster.run_to(led.time + seconds(3));
    std::map<std::string, int> puts;
    for (const KeyEvent& event : led.cluster.history()) ++puts[event.key.key];
    for (const auto& [id, revision] : told) {
      const std::string key = led.host.orders.keys().order(id);
      EXPECT_EQ(puts[key], 1) << "seed " << seed;
      EXPECT_EQ(led.cluster.keys().at(key).created, revision) << "seed " << seed;
    }
  }
  EXPECT_GT(there, 100u) << "no reply was lost: the test shows nothing";
  EXPECT_GT(unknown, 10u);
}

TEST(OrderStore, SaysNeverDoneOnlyOfWhatNeverComes) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Led led;
    Host other(led.cluster, led.time, "host-b", seed);
    ASSERT_TRUE(other.orders.open("born-2", led.in(seconds(1))));
    other.keys.faults = {0.2, 0.2, 0.4, 0.0};
    std::mt19937_64 random(seed);
    // While attempts may be under way, a newer grant comes.
    const auto first = other.orders.append(order_wish("o", led.epoch, led.grant, 4),
                                           led.in(milliseconds(random() % 300)));
    if (random() % 2) {
      ASSERT_TRUE(
          led.host.orders.grant({led.epoch, led.grant, 5, Duration{1}}, led.in(seconds(1))));
    }
    const auto second =
        other.orders.append(order_wish("o", led.epoch, led.grant, 4), led.in(milliseconds(600)));
    led.cluster.run_to(led.time + seconds(10));
    const bool is_there = led.cluster.keys().contains(led.host.orders.keys().order("o"));
    if (first || second) {
      EXPECT_TRUE(is_there);
    }
    if (!second && !second.error().maybe_done) {
      EXPECT_FALSE(is_there) << "seed " << seed << ": " << second.error().text;
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
}

TEST(OrderStore, ADeposedLeaderAppendsNothingHoweverLate) {
  Led led;
  Host other(led.cluster, led.time, "host-b");
  ASSERT_TRUE(other.orders.open("born-2", led.in(seconds(1))));
  // An append of the old leader is under way when its lease ends.
  led.cluster.transact_late(
      transaction_of(led.host.orders.keys(), order_wish("late", led.epoch, led.grant, 4)),
      led.in(seconds(5)));
  led.cluster.transact_late(
      transaction_of(led.host.orders.keys(), GrantWish{led.epoch, led.grant, 9, Duration{0}}),
      led.in(seconds(5)));
  led.time += seconds(3);
  ASSERT_EQ(other.leader.step(led.in(seconds(1))).standing, Holding::Standing::holds);
  const Epoch next = other.leader.held(led.time).value();
  EXPECT_GT(next, led.epoch);
  led.time += seconds(1);
  ASSERT_EQ(other.leader.step(led.in(seconds(1))).standing, Holding::Standing::holds);
  led.time += seconds(1);
  led.cluster.run_to(led.time);
  const auto text = other.orders.read(1, led.in(seconds(1)));
  ASSERT_TRUE(text);
  EXPECT_THAT(text->orders, IsEmpty());
  EXPECT_EQ(text->grant->to, 3u);

  const auto refused =
      led.host.orders.append(order_wish("o", led.epoch, led.grant, 4), led.in(seconds(1)));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().trouble, Trouble::deposed);
  EXPECT_FALSE(refused.error().maybe_done);
  EXPECT_THAT(refused.error().text, HasSubstr("host-b"));
  const auto no_grant = led.host.orders.grant({led.epoch, led.grant, 9, {}}, led.in(seconds(1)));
  ASSERT_FALSE(no_grant);
  EXPECT_EQ(no_grant.error().trouble, Trouble::deposed);
}

TEST(OrderStore, IsNotPutUnderAnotherGrant) {
  Led led;
  const auto next = led.host.orders.grant({led.epoch, led.grant, 6, {}}, led.in(seconds(1)));
  ASSERT_TRUE(next);
  const auto late =
      led.host.orders.append(order_wish("o", led.epoch, led.grant, 4), led.in(seconds(1)));
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().trouble, Trouble::overtaken);
  const auto again =
      led.host.orders.append(order_wish("o", led.epoch, next->revision, 7), led.in(seconds(1)));
  ASSERT_TRUE(again);
  // Once there, whoever asks again is told where, under whatever grant.
  const auto once_more =
      led.host.orders.append(order_wish("o", led.epoch, led.grant, 4), led.in(seconds(1)));
  ASSERT_TRUE(once_more);
  EXPECT_TRUE(once_more->was_there);
  EXPECT_EQ(once_more->tick, 7u);
  EXPECT_EQ(once_more->revision, again->revision);
  // A grant follows the one it names, too.
  const auto back = led.host.orders.grant({led.epoch, led.grant, 8, {}}, led.in(seconds(1)));
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().trouble, Trouble::overtaken);
}

TEST(OrderStore, RefusesWhatIsNoOrder) {
  Led led;
  const auto append = [&](OrderWish wish) {
    const auto outcome = led.host.orders.append(wish, led.in(seconds(1)));
    return outcome ? std::string() : std::string(name_of(outcome.error().trouble));
  };
  OrderWish wish = order_wish("o", led.epoch, led.grant, 4);
  EXPECT_EQ(append(wish), "");
  wish.order = "another";
  EXPECT_EQ(append(wish), "id taken");
  for (const char* id : {"", "a/b", "a b", "\xC3\xA5"}) {
    wish.id = id;
    EXPECT_EQ(append(wish), "broken") << id;
  }
  wish.id = std::string(kMostName + 1, 'a');
  EXPECT_EQ(append(wish), "broken");
  wish.id = "large";
  wish.order = std::string(kMostOrder + 1, 'a');
  EXPECT_EQ(append(wish), "broken");
  wish.order.pop_back();
  EXPECT_EQ(append(wish), "");
  EXPECT_THROW(OrderStore(led.host.keys, led.host.mark, "a/b"), std::invalid_argument);
}

TEST(OrderStore, TellsEachTroubleByItsDeadline) {
  Led led;
  const auto trouble = [&] {
    const HostTime deadline = led.in(seconds(1));
    const auto outcome = led.host.orders.append(order_wish("o", led.epoch, led.grant, 4), deadline);
    EXPECT_LE(led.time, deadline + milliseconds(10));
    return outcome ? std::string("done") : std::string(name_of(outcome.error().trouble));
  };
  led.host.keys.is_cut = true;
  EXPECT_EQ(trouble(), "unreachable");
  led.host.keys.is_cut = false;
  led.cluster.has_majority = false;
  EXPECT_EQ(trouble(), "no majority");
  EXPECT_GT(led.host.keys.turns, 0u) << "only one member was asked";
  led.cluster.has_majority = true;
  led.host.keys.faults.lose_request = 1.0;
  EXPECT_EQ(trouble(), "slow");
  led.host.keys.faults = {};
  led.cluster.is_full = true;
  EXPECT_EQ(trouble(), "full");
  led.cluster.is_full = false;
  (void)led.host.leader.step(led.in(seconds(1)));
}

TEST(OrderStore, ReadsAllPagesAsOfOneRevision) {
  Led led;
  for (int i = 0; i < 1203; ++i) {
    ASSERT_TRUE(led.host.orders.append(order_wish("o" + std::to_string(i), led.epoch, led.grant, 4),
                                       led.in(seconds(1))));
    led.cluster.lead_anew(led.time);
  }
  led.cluster.compact(led.cluster.revision());
  const auto text = led.host.orders.read(1, led.in(seconds(1)));
  ASSERT_TRUE(text) << text.error().text;
  ASSERT_THAT(text->orders, SizeIs(1203));
  for (int i = 0; i < 1203; ++i) EXPECT_EQ(text->orders[i].id, "o" + std::to_string(i));
}

TEST(OrderStore, SaysThatTheStoreWentBack) {
  const auto said = [](auto change) {
    Led led;
    EXPECT_TRUE(
        led.host.orders.append(order_wish("o1", led.epoch, led.grant, 4), led.in(seconds(1))));
    const MemoryCluster backup = led.cluster;
    EXPECT_TRUE(
        led.host.orders.append(order_wish("o2", led.epoch, led.grant, 4), led.in(seconds(1))));
    change(led, backup);
    const auto text = led.host.orders.read(1, led.in(seconds(1)));
    if (text) return std::string();
    EXPECT_EQ(text.error().trouble, Trouble::went_back);
    // It stays: nothing is appended to a store that lost orders.
    const auto after =
        led.host.orders.append(order_wish("o3", led.epoch, led.grant, 4), led.in(seconds(1)));
    EXPECT_FALSE(after);
    EXPECT_EQ(led.host.leader.step(led.in(seconds(1))).standing, Holding::Standing::unknown);
    EXPECT_FALSE(led.host.leader.held(led.time).has_value());
    return text.error().text;
  };
  EXPECT_EQ(said([](Led&, const MemoryCluster&) {}), "");
  EXPECT_THAT(said([](Led& led, const MemoryCluster& backup) { led.cluster = backup; }),
              HasSubstr("restored from an old backup"));
  EXPECT_THAT(said([](Led& led, const MemoryCluster&) { led.cluster.rename(0xC2); }),
              HasSubstr("the store is cluster c2, and was c1"));
  // Others have gone on in it since: its revision alone tells nothing.
  EXPECT_THAT(said([](Led& led, const MemoryCluster& backup) {
                led.cluster = backup;
                for (int i = 0; i < 20; ++i) {
                  Transaction t;
                  t.puts = {{"/elsewhere", "x", 0}};
                  (void)led.cluster.transact(t, led.time);
                }
              }),
              HasSubstr("order o2"));
  EXPECT_THAT(said([](Led& led, const MemoryCluster&) {
                led.cluster = MemoryCluster();
                for (int i = 0; i < 30; ++i) {
                  Transaction t;
                  t.puts = {{led.host.orders.keys().born(), "born-9", 0}};
                  (void)led.cluster.transact(t, led.time);
                }
              }),
              HasSubstr("born-9"));
}

TEST(OrderStore, SaysWhatElseWroteToTheLog) {
  const auto said = [](const std::string& key, const std::string& value) {
    Led led;
    EXPECT_TRUE(
        led.host.orders.append(order_wish("o", led.epoch, led.grant, 4), led.in(seconds(1))));
    Transaction t;
    t.puts = {{led.host.orders.keys().all() + key, value, 0}};
    (void)led.cluster.transact(t, led.time);
    const auto text = led.host.orders.read(1, led.in(seconds(1)));
    return text ? std::string() : text.error().text;
  };
  EXPECT_EQ(said("other", "x"), "");
  EXPECT_THAT(said("order/o", "x"), HasSubstr("order/o was changed"));
  EXPECT_THAT(said("order/p", "\xFF\xFF"), HasSubstr("order/p is no order"));
  EXPECT_THAT(said("order/p", ""), HasSubstr("order/p is no order"));
  EXPECT_THAT(said("order/a b", ""), HasSubstr("key (of 28 bytes) is no order's id"));
  EXPECT_THAT(said("name/ship", "host 1"), HasSubstr("name/ship names no host"));
  EXPECT_THAT(said("name/\n", "host-1"), HasSubstr("is no name to hold"));
  EXPECT_THAT(said("grant", "\xFF\xFF"), HasSubstr("grant is no grant"));
}

}  // namespace
}  // namespace skerry::fleet
