#include "server/fleet/exercise_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/fleet/fleet_kit.hpp"

namespace skerry::fleet {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Standing = ExerciseLog::Standing;

// A host that hears its leader's grants 2 ms after they are sent.  Times are from the begin of the
// exercise.
struct Follower {
  ExerciseLog log;
  Revision revision = 10;

  explicit Follower(ExerciseLog::Snapshot from = {}) : log("host-b", {}, from) {
    EXPECT_FALSE(log.hear(HolderSeen{5, kLeader, "host-a", 5}, kBegin));
  }
  static HostTime at(Duration since) { return kBegin + since; }
  std::optional<StoreError> grant(Duration sent, Tick to, Epoch epoch = 5) {
    return log.hear(GrantSeen{++revision, epoch, to, sent}, at(sent + milliseconds(2)));
  }
  std::optional<StoreError> order(const std::string& id, Tick tick, Duration when) {
    return log.hear(OrderSeen{++revision, 5, tick, id, "host-a", "rudder"}, at(when));
  }
  ExerciseLog::Step advance(Duration when) { return log.advance(at(when)); }
};

TEST(ExerciseLog, FollowsTheLeadersClockUpToItsGrants) {
  Follower host;
  EXPECT_EQ(host.advance(seconds(0)).standing, Standing::waiting);
  host.grant(milliseconds(0), 3);
  EXPECT_EQ(host.advance(milliseconds(101)).run_to, 0u) << "2 ms behind the leader";
  EXPECT_EQ(host.advance(milliseconds(102)).run_to, 1u);
  host.grant(milliseconds(100), 4);
  host.order("o1", 5, milliseconds(150));
  host.grant(milliseconds(200), 5);
  host.grant(milliseconds(300), 6);
  const auto before = host.advance(milliseconds(499));
  EXPECT_EQ(before.run_to, 4u);
  EXPECT_THAT(before.orders, IsEmpty());
  const auto step = host.advance(milliseconds(510));
  EXPECT_EQ(step.run_to, 5u);
  ASSERT_THAT(step.orders, SizeIs(1));
  EXPECT_EQ(step.orders[0].tick, 5u);
  EXPECT_EQ(step.orders[0].order.id, "o1");
  EXPECT_EQ(step.standing, Standing::following);
  EXPECT_THAT(host.advance(milliseconds(590)).orders, IsEmpty());
}

TEST(ExerciseLog, WaitsAtTheGrantWhileGrantsCome) {
  Follower host;
  host.grant(milliseconds(0), 3);
  host.advance(milliseconds(300));
  // The leader's next one allows no more; it is heard 280 ms late.
  (void)host.log.hear(GrantSeen{50, 5, 3, milliseconds(20)}, Follower::at(milliseconds(300)));
  const auto step = host.advance(milliseconds(560));
  EXPECT_EQ(step.run_to, 3u);
  EXPECT_EQ(step.standing, Standing::waiting);
  const auto place = host.log.place_of_order(Follower::at(milliseconds(560)));
  ASSERT_TRUE(std::holds_alternative<ExerciseLog::Refusal>(place));
  EXPECT_TRUE(std::get<ExerciseLog::Refusal>(place).soon);
}

TEST(ExerciseLog, RunsFreeWithoutGrantsAndFollowsAgain) {
  Follower host;
  host.grant(milliseconds(0), 3);
  host.order("o1", 4, milliseconds(50));
  EXPECT_EQ(host.advance(milliseconds(290)).standing, Standing::following);
  // The last granted tick first: that world is to be kept.
  const auto last = host.advance(milliseconds(460));
  EXPECT_EQ(last.run_to, 3u);
  EXPECT_TRUE(last.keep);
  EXPECT_EQ(last.standing, Standing::free);
  const auto free = host.advance(milliseconds(660));
  EXPECT_EQ(free.run_to, 6u);
  EXPECT_FALSE(free.keep);
  ASSERT_THAT(free.orders, SizeIs(1)) << "what is known holds";
  EXPECT_EQ(free.orders[0].tick, 4u);

  host.log.store_said(StoreError{Trouble::no_majority, "too few of the members agree", true});
  const auto place = host.log.place_of_order(Follower::at(milliseconds(660)));
  ASSERT_TRUE(std::holds_alternative<ExerciseLog::Refusal>(place));
  const auto& refusal = std::get<ExerciseLog::Refusal>(place);
  EXPECT_FALSE(refusal.soon);
  EXPECT_THAT(refusal.text, HasSubstr("host-b is cut off from the exercise and runs free"));
  EXPECT_THAT(refusal.text, HasSubstr("no grant for 0.7 s; its store: too few of the members"));

  host.grant(milliseconds(700), 10);
  const auto again = host.advance(milliseconds(750));
  EXPECT_EQ(again.standing, Standing::following);
  EXPECT_FALSE(again.conflict);
}

TEST(ExerciseLog, MustComeBackFromBeforeAnOrderThatItRanPast) {
  Follower host;
  host.grant(milliseconds(0), 3);
  host.advance(milliseconds(310));
  EXPECT_TRUE(host.advance(milliseconds(410)).keep);
  const ExerciseLog::Snapshot kept{host.log.tick(), host.log.known()};
  EXPECT_EQ(host.advance(milliseconds(610)).run_to, 6u);
  host.order("o1", 4, milliseconds(650));
  host.order("o2", 4, milliseconds(660));
  host.grant(milliseconds(700), 10);
  const auto step = host.advance(milliseconds(750));
  EXPECT_EQ(step.standing, Standing::must_come_back);
  ASSERT_TRUE(step.conflict);
  EXPECT_EQ(step.conflict->tick, 4u);
  EXPECT_EQ(step.conflict->order.id, "o1");
  EXPECT_THAT(step.orders, IsEmpty());
  EXPECT_EQ(step.run_to, 7u) << "its displays go on";
  const auto place = host.log.place_of_order(Follower::at(milliseconds(750)));
  EXPECT_THAT(std::get<ExerciseLog::Refusal>(place).text, HasSubstr("o1 holds from tick 4"));

  Follower again(kept);
  again.revision = 10;
  again.grant(milliseconds(0), 3);
  again.order("o1", 4, milliseconds(650));
  again.order("o2", 4, milliseconds(660));
  again.grant(milliseconds(700), 10);
  const auto back = again.advance(milliseconds(750));
  EXPECT_EQ(back.standing, Standing::following);
  EXPECT_THAT(back.orders, SizeIs(2));
}

TEST(ExerciseLog, ComesInFromASnapshotWithoutWhatItHolds) {
  Follower host({20, 12});
  host.order("o1", 15, seconds(0));  // revision 11: in the snapshot
  host.order("o2", 21, seconds(0));  // 12: known, but later
  host.grant(seconds(3), 33);
  const auto step = host.advance(milliseconds(3050));
  EXPECT_EQ(step.run_to, 30u);
  ASSERT_THAT(step.orders, SizeIs(1));
  EXPECT_EQ(step.orders[0].order.id, "o2");
  // Behind what its maker knew, and in its past: its maker had run free.
  Follower late({20, 12});
  late.revision = 12;
  late.order("o3", 20, seconds(0));
  EXPECT_TRUE(late.advance(seconds(0)).conflict);
}

TEST(ExerciseLog, GrantsAsLeaderOnlyWhatItHears) {
  Follower host;
  EXPECT_FALSE(host.log.grant_due(kBegin));
  host.log.lead(5, kBegin);
  const auto first = host.log.grant_due(kBegin);
  ASSERT_TRUE(first);
  EXPECT_EQ(*first, (GrantWish{5, 0, 3, Duration{0}}));
  EXPECT_FALSE(host.log.grant_due(Follower::at(milliseconds(99))));
  // Its own grant has not come: it does not run, and the next one follows nothing as well.
  EXPECT_EQ(host.advance(milliseconds(100)).run_to, 0u);
  EXPECT_EQ(host.log.grant_due(Follower::at(milliseconds(100))),
            (GrantWish{5, 0, 4, milliseconds(100)}));
  host.grant(milliseconds(0), 3);
  EXPECT_EQ(host.advance(milliseconds(150)).run_to, 1u);
  EXPECT_EQ(host.log.grant_due(Follower::at(milliseconds(210))),
            (GrantWish{5, host.revision, 5, milliseconds(210)}));
  host.log.lead(std::nullopt, Follower::at(milliseconds(300)));
  EXPECT_FALSE(host.log.grant_due(Follower::at(milliseconds(400))));
}

TEST(ExerciseLog, GrantsFromItsOwnNowWhenItTakesOver) {
  Follower host;
  host.grant(milliseconds(0), 3);
  host.advance(milliseconds(310));
  host.advance(milliseconds(510));
  EXPECT_EQ(host.advance(milliseconds(2010)).run_to, 20u);
  host.log.lead(20, Follower::at(milliseconds(2020)));
  EXPECT_FALSE(host.log.grant_due(Follower::at(milliseconds(2020)))) << "not yet in the log";
  (void)host.log.hear(HolderSeen{20, kLeader, "host-b", 20}, Follower::at(milliseconds(2030)));
  const auto wish = host.log.grant_due(Follower::at(milliseconds(2042)));
  ASSERT_TRUE(wish);
  EXPECT_EQ(wish->to, 23u);
  EXPECT_EQ(wish->sent, milliseconds(2040));
  EXPECT_EQ(wish->previous, host.revision);
}

TEST(ExerciseLog, ALeaderWithoutAWorldGrantsNothing) {
  Follower host;
  host.log.lead(5, kBegin);
  host.grant(milliseconds(0), 3);
  host.advance(milliseconds(310));
  host.advance(milliseconds(410));
  host.advance(milliseconds(710));
  host.order("o1", 4, milliseconds(720));
  EXPECT_TRUE(host.advance(milliseconds(730)).conflict);
  EXPECT_FALSE(host.log.grant_due(Follower::at(seconds(1))));
}

TEST(ExerciseLog, PlacesOrdersBehindTheGrantInForce) {
  Follower host;
  host.grant(milliseconds(0), 3);
  const auto place = host.log.place_of_order(Follower::at(milliseconds(100)));
  ASSERT_TRUE(std::holds_alternative<ExerciseLog::Place>(place));
  EXPECT_EQ(std::get<ExerciseLog::Place>(place).tick, 4u);
  EXPECT_EQ(std::get<ExerciseLog::Place>(place).grant, host.revision);
  EXPECT_EQ(std::get<ExerciseLog::Place>(place).epoch, 5);
  // A new leader that has not granted yet; and nobody.
  (void)host.log.hear(HolderSeen{30, kLeader, "host-c", 30}, Follower::at(milliseconds(110)));
  const auto change = host.log.place_of_order(Follower::at(milliseconds(120)));
  EXPECT_TRUE(std::get<ExerciseLog::Refusal>(change).soon);
  EXPECT_THAT(std::get<ExerciseLog::Refusal>(change).text, HasSubstr("changes its leader"));
}

TEST(ExerciseLog, SaysThatTheLogContradictsItself) {
  const auto text = [](const std::optional<StoreError>& error) {
    return error ? error->text : std::string();
  };
  Follower host;
  EXPECT_EQ(text(host.grant(milliseconds(0), 3)), "");
  EXPECT_EQ(text(host.order("o1", 4, milliseconds(10))), "");
  EXPECT_THAT(text(host.order("o2", 3, milliseconds(10))), HasSubstr("behind one for tick 4"));
  EXPECT_THAT(text(host.grant(milliseconds(100), 2)), HasSubstr("and 3 was granted before"));
  EXPECT_THAT(text(host.grant(milliseconds(100), 1'000'000)), HasSubstr("more than 10 s ahead"));
  EXPECT_THAT(text(host.grant(-milliseconds(1), 4)), HasSubstr("the exercise's time is -0 s"));
  EXPECT_THAT(text(host.grant(Duration::max() / 2, 4)), HasSubstr("the exercise's time is"));
  EXPECT_EQ(text(host.order("o3", 9, milliseconds(10))), "");
  EXPECT_THAT(text(host.grant(milliseconds(100), 4)), HasSubstr("behind an order for tick 9"));
  // What was heard is not heard again.
  EXPECT_EQ(text(host.log.hear(OrderSeen{1, 5, 1, "o0", "host-a", ""}, kBegin)), "");
}

TEST(ExerciseClock, DoesNotGoBackForTheFirstLateGrantsOfANewLeader) {
  ExerciseClock clock;
  clock.hear(seconds(10), kBegin);
  clock.forget();
  const auto grant = [&](int i, milliseconds late) {
    const Duration sent = seconds(11) + milliseconds(100 * i);
    const HostTime now = kBegin + seconds(1) + milliseconds(100 * i) + late;
    clock.hear(sent, now);
    return *clock.at(now) - (now - kBegin) - seconds(10);
  };
  for (int i = 0; i < 4; ++i) EXPECT_EQ(grant(i, milliseconds(400)), Duration{}) << i;
  EXPECT_EQ(grant(4, milliseconds(3)), -milliseconds(3)) << "it is 3 ms behind the former";
  EXPECT_EQ(grant(5, -milliseconds(2)), milliseconds(2)) << "ahead it goes at once";
}

TEST(ExerciseClock, BelievesTheFastestOfTheLastGrants) {
  ExerciseClock clock;
  EXPECT_FALSE(clock.at(kBegin));
  const auto hear = [&](int sent_ms, int late_ms) {
    clock.hear(milliseconds(sent_ms), kBegin + milliseconds(sent_ms + late_ms));
  };
  hear(0, 40);
  EXPECT_EQ(clock.at(kBegin + milliseconds(100)), milliseconds(60));
  hear(100, 3);
  hear(200, 250);
  EXPECT_EQ(clock.delay(), milliseconds(247));
  EXPECT_EQ(clock.at(kBegin + milliseconds(500)), milliseconds(497));
  // Of what the leader's clock was long ago nothing is left.
  for (std::size_t i = 1; i <= ExerciseClock::kSamples; ++i)
    hear(200 + 100 * static_cast<int>(i), 7);
  EXPECT_EQ(clock.at(kBegin + milliseconds(5000)), milliseconds(4993));
}

}  // namespace
}  // namespace skerry::fleet
