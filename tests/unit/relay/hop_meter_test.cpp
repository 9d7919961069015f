#include "server/relay/hop_meter.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(HopMeter, TellsTheMedianRoundTripOfTheLast) {
  const HopMeter::Time now{};
  HopMeter meter("other:7410", now);
  EXPECT_FALSE(meter.tell(now)[0].has_round_trip_ms());
  for (const int ms : {900, 1, 2, 100, 3, 4}) meter.round_trip(milliseconds(ms));
  EXPECT_EQ(meter.tell(now)[0].round_trip_ms(), 3);
  meter.connected("skerryd", now);  // another way, perhaps
  EXPECT_FALSE(meter.tell(now)[0].has_round_trip_ms());
}

TEST(HopMeter, TellsBytesASecondOfTheLastSecondsAlone) {
  HopMeter::Time now{};
  HopMeter meter("other:7410", now);
  meter.connected("skerryd", now);
  meter.received(0, 0, 0, now);
  for (int i = 0; i < 100; ++i) meter.received(1, 0, 50'000, now += milliseconds(100));
  EXPECT_NEAR(meter.tell(now)[0].bytes_per_second(), 500'000, 1);
  for (int i = 0; i < 100; ++i) meter.received(1, 0, 10'000, now += milliseconds(100));
  EXPECT_NEAR(meter.tell(now)[0].bytes_per_second(), 100'000, 1);
  EXPECT_EQ(meter.tell(now)[0].bytes(), 6'000'000u);
  EXPECT_EQ(meter.tell(now + seconds(10))[0].bytes_per_second(), 0);
}

TEST(HopMeter, CountsWhatComesBackAndHowLongItIsSo) {
  HopMeter::Time now{};
  HopMeter meter("other:7410", now);
  meter.connected("skerryd", now);
  EXPECT_EQ(meter.tell(now)[0].reconnects(), 0u);
  meter.gone("closed", now + seconds(10));
  meter.gone("refused", now + seconds(20));
  const auto gone = meter.tell(now + seconds(30))[0];
  EXPECT_EQ(gone.since_s(), 20);
  EXPECT_EQ(gone.problem(), "refused");
  meter.connected("skerryd", now + seconds(40));
  const auto back = meter.tell(now + seconds(41))[0];
  EXPECT_EQ(back.reconnects(), 1u);
  EXPECT_EQ(back.since_s(), 1);
  EXPECT_EQ(back.problem(), "");
}

TEST(HopMeter, WhatIsToldOfHopsBeforeIsBounded) {
  HopMeter meter("other:7410", {});
  wire::Hops hops;
  for (int i = 0; i < 1000; ++i) hops.add_hops()->set_problem(std::string(5000, 'x'));
  meter.set_before(hops);
  const auto told = meter.tell({});
  EXPECT_EQ(told.size(), 17u);
  EXPECT_LE(told.back().problem().size(), 300u);
}

}  // namespace
}  // namespace skerry::server
