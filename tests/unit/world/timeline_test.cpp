#include "server/world/timeline.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

ScenarioTime at_tick(std::int64_t k) { return ScenarioTime(World::kTick * k); }

TEST(Timeline, GivesTheStateOfTheTickThatContainsTheTime) {
  Timeline timeline{World(default_scenario())};
  EXPECT_EQ(timeline.latest()->time, at_tick(0));
  EXPECT_EQ(timeline.at(ScenarioTime(99'999'999ns))->time, at_tick(0));
  EXPECT_EQ(timeline.at(ScenarioTime(100ms))->time, at_tick(1));
  EXPECT_EQ(timeline.at(ScenarioTime(1234ms))->time, at_tick(12));
  EXPECT_EQ(timeline.latest()->time, at_tick(12));
  EXPECT_EQ(timeline.at(ScenarioTime(-1h))->time, at_tick(0)) << "before the beginning";
}

TEST(Timeline, EveryTickIsMadeOnce) {
  Timeline timeline{World(default_scenario())};
  const WorldStatePtr state = timeline.at(at_tick(5));
  EXPECT_EQ(timeline.at(at_tick(5) + 99ms), state);
  timeline.at(at_tick(9));
  EXPECT_EQ(timeline.at(at_tick(5)), state);
}

TEST(Timeline, AnOlderTimeThanIsKeptGetsTheOldestKept) {
  Timeline timeline{World(default_scenario())};
  for (int k = 0; k <= 100; ++k) timeline.at(at_tick(k));
  EXPECT_EQ(timeline.at(at_tick(100))->time, at_tick(100));
  EXPECT_EQ(timeline.at(at_tick(69))->time, at_tick(69));
  EXPECT_EQ(timeline.at(at_tick(68))->time, at_tick(69));
  EXPECT_EQ(timeline.at(at_tick(0))->time, at_tick(69));
}

TEST(Timeline, IsTheWorldSteppedTickByTick) {
  World world(default_scenario());
  Timeline timeline{World(default_scenario())};
  EXPECT_EQ(timeline.order(0, 250.0, 4.0), 1u);
  world.order(0, 250.0, 4.0);
  for (int k = 0; k < 777; ++k) world.step();
  const WorldStatePtr state = timeline.at(at_tick(777));  // in one jump
  ASSERT_EQ(state->own_ships.size(), world.state().own_ships.size());
  for (std::size_t i = 0; i < state->own_ships.size(); ++i) {
    EXPECT_EQ(state->own_ships[i].position, world.state().own_ships[i].position);
    EXPECT_EQ(state->own_ships[i].heading_deg, world.state().own_ships[i].heading_deg);
  }
  for (std::size_t i = 0; i < state->targets.size(); ++i) {
    EXPECT_EQ(state->targets[i].position, world.state().targets[i].position);
  }
}

TEST(Timeline, CatchesUpWithAnHourInBoundedCalls) {
  Timeline timeline{World(default_scenario())};
  const ScenarioTime wanted = at_tick(36'000);
  std::uint64_t made = 0;
  int calls = 0;
  for (; timeline.latest()->time < wanted; ++calls) {
    timeline.at(wanted);
    const auto now =
        static_cast<std::uint64_t>(timeline.latest()->time.time_since_epoch() / World::kTick);
    ASSERT_GT(now, made);
    ASSERT_LE((now - made) * 2, Timeline::kMaxShipSteps);
    made = now;
  }
  EXPECT_EQ(calls, 15);
  EXPECT_EQ(timeline.at(wanted)->time, wanted);
  EXPECT_EQ(timeline.at(at_tick(0))->time, at_tick(36'000 - 31));
}

TEST(Timeline, TheEndOfTimeIsNoFurtherThanAnyOtherJump) {
  Timeline timeline{World(default_scenario())};
  const WorldStatePtr state = timeline.at(ScenarioTime::max());
  EXPECT_EQ(state->time, at_tick(2500));
  EXPECT_EQ(timeline.at(ScenarioTime::min())->time, at_tick(2500 - 31));
}

TEST(Timeline, AnOrderTakesEffectInTheTickItNames) {
  Timeline timeline{World(default_scenario())};
  timeline.at(at_tick(10));
  const std::uint64_t tick = timeline.order(1, 90.0, std::nullopt);
  EXPECT_EQ(tick, 11u);
  EXPECT_EQ(timeline.latest()->own_ships[1].ordered_course_deg, 347.4);
  EXPECT_EQ(timeline.at(at_tick(11))->own_ships[1].ordered_course_deg, 90.0);
  EXPECT_THROW(timeline.order(2, 90.0, std::nullopt), std::invalid_argument);
}

TEST(Timeline, MakesNoTickBeyondTheLastThatItMay) {
  Timeline timeline{World(default_scenario())};
  timeline.keep_to(7);
  EXPECT_EQ(timeline.at(ScenarioTime(20 * World::kTick))->time, ScenarioTime(7 * World::kTick));
  EXPECT_EQ(timeline.order(0, 10.0, std::nullopt), 8u);
  timeline.make(100);
  EXPECT_EQ(timeline.latest()->time, ScenarioTime(7 * World::kTick));
  timeline.keep_to(9);
  EXPECT_EQ(timeline.at(ScenarioTime(8 * World::kTick))->time, ScenarioTime(8 * World::kTick));
  EXPECT_EQ(timeline.at(ScenarioTime(20 * World::kTick))->time, ScenarioTime(9 * World::kTick));
  timeline.keep_to(3);  // what is made is made
  EXPECT_EQ(timeline.latest()->time, ScenarioTime(9 * World::kTick));
  timeline.make(3);
}

TEST(Timeline, ComesBackToAnEarlierWorldAsIfNothingHadBeen) {
  Timeline timeline{World(default_scenario())};
  timeline.make(40);
  const World kept = timeline.world();
  timeline.make(60);
  const GeoPoint there = timeline.latest()->own_ships[0].position;
  timeline.restore(kept);
  EXPECT_EQ(timeline.latest()->time, at_tick(40));
  timeline.order(0, 90.0, 3.0);
  timeline.make(60);
  EXPECT_NE(timeline.latest()->own_ships[0].position, there);
  timeline.restore(kept);
  timeline.make(60);
  EXPECT_EQ(timeline.latest()->own_ships[0].position, there);
}

TEST(Timeline, OrdersHoldBehindTheTicksThatWereMadeForThem) {
  const auto run = [](std::uint64_t looks) {
    Timeline timeline{World(default_scenario())};
    timeline.keep_to(3 * Timeline::kMaxShipSteps);
    for (std::uint64_t tick = 0; tick < looks; tick += 3) {
      timeline.at(ScenarioTime(static_cast<std::int64_t>(tick) * World::kTick));
    }
    const std::uint64_t far = 2 * Timeline::kMaxShipSteps;  // in several steps
    timeline.make(far);
    EXPECT_EQ(timeline.order(0, 10.0, 3.0), far + 1);
    timeline.make(far + 600);
    return timeline.latest()->own_ships[0];
  };
  const ShipState seldom = run(0), often = run(5000);
  EXPECT_EQ(seldom.position, often.position);
}

TEST(Timeline, AnOrderThatCannotBeGivenIsToldAndOrdersNothing) {
  scenario::Scenario scenario = default_scenario();
  scenario.mutable_own_ships(0)->set_ship_class("pilot");
  Timeline timeline{World(scenario)};
  timeline.at(at_tick(10));
  wire::ConOrder order;
  order.set_steering(wire::STEERING_TRACK);
  order.set_engine_percent(-100.0);
  const Timeline::ConOrdered refused = timeline.order(0, order);
  EXPECT_EQ(refused.fault, timeline.fault_of(0, order));
  ASSERT_TRUE(refused.fault);
  EXPECT_TRUE(timeline.at(at_tick(12))->own_ships[0].con->keeps_speed);
  order.clear_steering();
  EXPECT_EQ(timeline.order(0, order).fault, std::nullopt);
  EXPECT_EQ(timeline.order(0, order).tick, 13u);
  EXPECT_EQ(timeline.at(at_tick(14))->own_ships[0].con->engine_percent, -100.0);
}

}  // namespace
}  // namespace skerry::server
