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
  AzimuthCounter counter{360};
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
  counter.restart(512, false);
  EXPECT_EQ(counter.stall_tick(), AzimuthCounter::kNever);
  turn(100);
  EXPECT_EQ(counter.faults(), 0u);
  turn(360);
  EXPECT_EQ(counter.faults(), fault::acp_missing);
  EXPECT_EQ(counter.counts().arps, 4u) << "counts go on";
  counter.restart(360, true);
  EXPECT_EQ(counter.counts().arps, 4u);
  EXPECT_EQ(counter.counts().acp_period(), 0u) << "ticks of another clock";
}

TEST_F(AzimuthCounterTest, AResetForgetsAll) {
  turn(1);
  turn(300);
  counter.reset();
  EXPECT_EQ(counter.faults(), 0u);
  EXPECT_EQ(counter.counts().arps, 0u);
  EXPECT_EQ(counter.counts().acp_period(), 0u);
  turn(60);
  EXPECT_EQ(counter.faults(), 0u) << "a part of a turn";
}

}  // namespace
}  // namespace skerry::server
