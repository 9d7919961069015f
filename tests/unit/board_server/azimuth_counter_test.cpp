#include "server/board/azimuth_counter.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

namespace fault = board::fault;

// Pulses by hand: 360 ACPs a turn, 100 ticks apart.
class AzimuthCounterTest : public testing::Test {
 protected:
  void turn(int acps) {
    for (int i = 0; i < acps; ++i) counter.on_acp(tick += 100);
    counter.on_arp(tick + 30);
  }
  AzimuthCounter counter{Encoder{360, 100}};
  Tick tick = 0;
};

TEST_F(AzimuthCounterTest, CountsAndMeasuresGoodTurns) {
  turn(17);
  turn(360);
  turn(360);
  counter.on_acp(tick += 100);
  counter.on_acp(tick += 100);
  counter.on_trigger(tick + 40);
  const PulseCounts& counts = counter.counts();
  EXPECT_EQ(counter.faults(), 0u);
  EXPECT_TRUE(counter.steady());
  EXPECT_EQ(counts.arps, 3u);
  EXPECT_EQ(counts.acps, 739u);
  EXPECT_EQ(counts.acps_since_arp, 2u);
  EXPECT_EQ(counts.acps_per_arp, 360u);
  EXPECT_EQ(counts.acps_at_arp, 737u);
  EXPECT_EQ(counts.ticks_from_acp_to_arp, 30u);
  EXPECT_EQ(counts.acp_period(), 100u);
  EXPECT_EQ(counts.ticks_since_acp(tick + 40), 40u);
  EXPECT_EQ(counts.triggers, 1u);
  EXPECT_EQ(counts.trigger_tick, tick + 40);
  EXPECT_EQ(counts.arp_tick - counts.previous_arp_tick, 36'000u);
}

TEST_F(AzimuthCounterTest, TheTurnInWhichItBeganIsNotJudged) {
  turn(359);
  EXPECT_EQ(counter.faults(), 0u);
  turn(359);
  EXPECT_EQ(counter.faults(), fault::acp_missing);
}

TEST_F(AzimuthCounterTest, TooFewAndTooManyLastUntilAGoodTurn) {
  turn(1);
  turn(359);
  EXPECT_EQ(counter.faults(), fault::acp_missing);
  turn(361);
  EXPECT_EQ(counter.faults(), fault::acp_extra);
  turn(360);
  EXPECT_EQ(counter.faults(), 0u);
}

TEST_F(AzimuthCounterTest, AMissingArpIsNoticedAfterOneAndAHalfTurnsAndIsNoMiscount) {
  turn(1);
  turn(360);
  for (int i = 0; i < 540; ++i) counter.on_acp(tick += 100);
  EXPECT_EQ(counter.faults(), 0u);
  counter.on_acp(tick += 100);
  EXPECT_EQ(counter.faults(), fault::arp_missing);
  turn(720 - 541);
  EXPECT_EQ(counter.counts().acps_per_arp, 720u);
  EXPECT_EQ(counter.faults(), fault::arp_missing) << "until a good turn";
  turn(360);
  EXPECT_EQ(counter.faults(), 0u);
}

TEST_F(AzimuthCounterTest, AStallIsEightPeriodsWithoutAnAcp) {
  turn(1);
  turn(360);
  EXPECT_EQ(counter.stall_tick(), tick + 800);
  counter.on_stall();
  EXPECT_EQ(counter.faults(), fault::stalled);
  EXPECT_EQ(counter.stall_tick(), AzimuthCounter::kNever) << "once";
  counter.on_acp(tick += 5000);
  EXPECT_EQ(counter.faults(), 0u);
}

TEST_F(AzimuthCounterTest, OtherSettingsForgiveTheTurnInProgress) {
  turn(1);
  turn(360);
  counter.restart({512, 70}, tick + 30, tick + 30, false);
  EXPECT_EQ(counter.stall_tick(), tick + 30 + 8 * 70) << "of the period configured";
  turn(100);
  EXPECT_EQ(counter.faults(), 0u);
  turn(360);
  EXPECT_EQ(counter.faults(), fault::acp_missing);
  EXPECT_EQ(counter.counts().arps, 4u) << "counts go on";
  counter.restart({360, 100}, tick, 2 * tick, true);
  EXPECT_EQ(counter.counts().arps, 4u);
  EXPECT_EQ(counter.counts().acp_period(), 0u) << "ticks of another clock";
}

TEST_F(AzimuthCounterTest, AResetForgetsAll) {
  turn(1);
  turn(300);
  counter.reset(tick);
  EXPECT_EQ(counter.faults(), 0u);
  EXPECT_EQ(counter.counts().arps, 0u);
  EXPECT_EQ(counter.counts().acp_period(), 0u);
  turn(60);
  EXPECT_EQ(counter.faults(), 0u) << "a part of a turn";
}

TEST_F(AzimuthCounterTest, AMissingArpIsNoticedWithoutOneBefore) {
  for (const bool reset : {false, true}) {
    if (reset) counter.reset(tick);
    for (int i = 0; i < 540; ++i) counter.on_acp(tick += 100);
    EXPECT_EQ(counter.faults(), 0u);
    counter.on_acp(tick += 100);
    EXPECT_EQ(counter.faults(), fault::arp_missing);
    turn(100);
    EXPECT_EQ(counter.faults(), fault::arp_missing) << "until a good turn";
    turn(360);
    EXPECT_EQ(counter.faults(), 0u);
    turn(100);
  }
}

TEST_F(AzimuthCounterTest, AStallIsNoticedBeforeAPeriodIsKnown) {
  EXPECT_EQ(counter.stall_tick(), 800u);
  counter.on_acp(50);
  EXPECT_EQ(counter.stall_tick(), 850u);
  counter.on_acp(90);
  EXPECT_EQ(counter.stall_tick(), 410u) << "a period that came, not the one configured";
  counter.reset(1000);
  EXPECT_EQ(counter.stall_tick(), 1800u);
  counter.restart({360, 40}, 1000, 400, true);
  EXPECT_EQ(counter.stall_tick(), 720u);
}

TEST_F(AzimuthCounterTest, AnotherClockForgetsTicksAndKeepsCounts) {
  turn(1);
  counter.on_trigger(tick);
  turn(360);
  counter.on_acp(tick += 100);
  counter.restart({360, 50}, tick, tick / 2, true);
  const PulseCounts& counts = counter.counts();
  EXPECT_EQ(counts.acps, 362u);
  EXPECT_EQ(counts.acps_since_arp, 1u);
  EXPECT_EQ(counts.acps_at_arp, 361u);
  EXPECT_EQ(counts.triggers_at_arp, 1u);
  EXPECT_EQ(counts.acps_per_arp, 360u);
  EXPECT_EQ(counts.acp_tick, 0u);
  EXPECT_EQ(counts.arp_tick, 0u);
  EXPECT_EQ(counts.ticks_from_acp_to_arp, 0u);
  EXPECT_EQ(counts.ticks_since_acp(tick), 0u) << "none of this clock";
  counter.on_acp(tick / 2 + 20);
  EXPECT_EQ(counts.ticks_since_acp(tick / 2 + 30), 10u);
  EXPECT_EQ(counts.acp_period(), 0u) << "one of this clock makes none";
  counter.on_acp(tick / 2 + 70);
  EXPECT_EQ(counts.acp_period(), 50u);
}

TEST_F(AzimuthCounterTest, OtherAcpsOfATurnTakeTheCountWithThem) {
  turn(1);
  turn(360);
  for (int i = 0; i < 90; ++i) counter.on_acp(tick += 100);
  counter.restart({4096, 9}, tick + 50, tick + 50, false);
  // 90.5 ACPs since the first, less 0.3 before the ARP.
  EXPECT_EQ(counter.counts().acps_since_arp, 1026u);
  EXPECT_EQ(counter.counts().ticks_from_acp_to_arp, 0u);
  EXPECT_EQ(counter.counts().acps, 451u) << "what came has come";
}

TEST(AzimuthCounter, ATurnOfMoreTicksThan32BitsHaveIsNotSaid) {
  for (const Tick period : {Tick{11'930'464}, Tick{11'930'465}}) {
    AzimuthCounter counter(Encoder{360, period});
    Tick tick = 0;
    for (int turn = 0; turn < 3; ++turn) {
      for (int i = 0; i < 360; ++i) counter.on_acp(tick += period);
      counter.on_arp(tick);
    }
    EXPECT_EQ(counter.counts().turn_ticks, period == 11'930'464 ? 4'294'967'040u : 0u);
    EXPECT_TRUE(counter.steady());
  }
}

}  // namespace
}  // namespace skerry::server
