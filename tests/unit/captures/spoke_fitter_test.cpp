#include "protocol/captures/spoke_fitter.hpp"

#include <gtest/gtest.h>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/turn_counter.hpp"

namespace skerry::captures {
namespace {

UtcTime at(double seconds) { return UtcTime(seconds_as_duration(seconds)); }

CapturedSpoke captured(std::size_t cells, double reach_m, std::uint32_t index = 0,
                       double time_s = 0.0) {
  CapturedSpoke spoke;
  spoke.time = at(time_s);
  spoke.spokes_per_turn = 2048;
  spoke.index = index;
  spoke.reach = metres(reach_m);
  spoke.cells.assign(cells, 7);
  return spoke;
}

TEST(ScaleOf, HoldsTheNominalRangeAndHalfTheReach) {
  const auto nm = [](double nominal_m, double reach_m) {
    const auto scale = scale_of(metres(nominal_m), metres(reach_m));
    return scale ? scale->in_nautical_miles() : 0.0;
  };
  EXPECT_EQ(nm(463, 796), 0.25);   // a plotter's 0.25 NM
  EXPECT_EQ(nm(1852, 3183), 1.5);  // there is no scale of 1 NM
  EXPECT_EQ(nm(3704, 8307), 3.0);
  EXPECT_EQ(nm(231.5, 520), 0.25);  // twice 0.125 NM would not hold it
  EXPECT_EQ(nm(44448, 57860), 24.0);
  EXPECT_EQ(nm(0, 57860), 48.0);  // all of what is shown
  EXPECT_EQ(nm(0, 15), 0.125);
  EXPECT_EQ(nm(0, 14), 0.0);
  EXPECT_EQ(nm(0, 350'000), 96.0);
  EXPECT_EQ(nm(0, 356'000), 0.0);
  EXPECT_EQ(nm(0, 0), 0.0);
}

TEST(SpokeFitter, SpokesWithoutRangeTakeTheNextOneThenTheLast) {
  SpokeFitter fitter(3, {}, at(0));
  const ShipTrack ship;
  std::vector<Spoke> out;
  for (std::uint32_t i = 0; i < 5; ++i) fitter.take(captured(1024, 0, i), ship, out);
  EXPECT_TRUE(out.empty());
  fitter.take(captured(1024, 2000, 5), ship, out);
  fitter.take(captured(1024, 0, 6), ship, out);
  ASSERT_EQ(out.size(), 7u);
  for (std::uint32_t i = 0; i < 7; ++i) {
    EXPECT_EQ(out[i].header.index, i);
    EXPECT_EQ(out[i].header.sequence, i);
    EXPECT_EQ(out[i].header.radar, 3u);
    EXPECT_EQ(out[i].header.reach(), metres(2000));
  }
  EXPECT_EQ(fitter.counts().range_unknown, 6u);
}

TEST(SpokeFitter, ThoseThatNeverLearnTheirRangeAreGivenAtTheEndAndWaitInBoundedNumber) {
  SpokeFitter fitter(0, {}, at(0));
  std::vector<Spoke> out;
  for (std::size_t i = 0; i < SpokeFitter::kMaxWaiting + 10; ++i) {
    fitter.take(captured(200, 0), {}, out);
  }
  EXPECT_EQ(out.size(), SpokeFitter::kMaxWaiting);
  fitter.finish(out);
  EXPECT_EQ(out.size(), SpokeFitter::kMaxWaiting + 10);
  EXPECT_EQ(out.back().header.reach().in_nautical_miles(), SpokeFitter::kAssumedRangeNm);
}

TEST(SpokeFitter, TooManyCellsKeepTheirPeaks) {
  SpokeFitter fitter(0, {}, at(0));
  std::vector<Spoke> out;
  CapturedSpoke spoke = captured(10'000, 20'000);
  for (auto& cell : spoke.cells) cell = 0;
  spoke.cells[5000] = 250;
  fitter.take(std::move(spoke), {}, out);
  ASSERT_EQ(out.at(0).cells.size(), ScanGeometry::kMaxCells);
  EXPECT_EQ(out[0].cells[2048], 250);
  EXPECT_EQ(std::count(out[0].cells.begin(), out[0].cells.end(), 0), ScanGeometry::kMaxCells - 1);
  EXPECT_EQ(fitter.counts().thinned, 1u);
}

TEST(SpokeFitter, SpokesThatWaitAreThinnedOnce) {
  SpokeFitter fitter(0, {}, at(0));
  std::vector<Spoke> out;
  for (int i = 0; i < 3; ++i) fitter.take(captured(65'000, 0), {}, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(fitter.counts().thinned, 3u);  // before they wait
  fitter.take(captured(65'000, 2000), {}, out);
  ASSERT_EQ(out.size(), 4u);
  EXPECT_EQ(out[0].cells.size(), ScanGeometry::kMaxCells);
  EXPECT_EQ(out[0].header.reach(), metres(2000));
  EXPECT_EQ(fitter.counts().thinned, 4u);
}

TEST(SpokeFitter, WhatCannotBeSaidIsCounted) {
  SpokeFitter fitter(0, {}, at(0));
  std::vector<Spoke> out;
  fitter.take(captured(512, 5), {}, out);
  fitter.take(captured(512, 1e9), {}, out);
  fitter.take(captured(512, 1000, 2048), {}, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(fitter.counts().refused, 3u);
}

TEST(TurnCounter, CountsWrapsPausesAndNoStepsBack) {
  TurnCounter turns;
  const Duration turn = std::chrono::seconds(2);
  EXPECT_EQ(turns.take(10, 100, at(0.2), turn), 0u);
  EXPECT_EQ(turns.take(99, 100, at(1.98), turn), 0u);
  EXPECT_EQ(turns.take(0, 100, at(2.0), turn), 1u);
  EXPECT_EQ(turns.take(99, 100, at(2.001), turn), 0u);  // late
  EXPECT_EQ(turns.take(1, 100, at(2.02), turn), 1u);
  EXPECT_EQ(turns.take(50, 100, at(3.0), turn), 1u);
  EXPECT_EQ(turns.take(60, 100, at(23.2), turn), 11u);  // ten turns of pause
  EXPECT_EQ(turns.take(5, 200, at(24.0), turn), 12u);   // another shape
  EXPECT_EQ(turns.take(6, 200, at(20.0), turn), 12u);   // a clock set back
}

TEST(TurnCounter, CountsWithoutKnowingTheTime) {
  TurnCounter turns;
  std::uint32_t scan = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) scan = turns.take(i % 250, 250, at(0), {});
  EXPECT_EQ(scan, 3u);
  EXPECT_EQ(turns.take(248, 250, at(0), {}), 3u);
}

TEST(CounterGap, BelievesJumpsWithinATurnOnly) {
  CounterGap gap(4096, 2048);
  const Duration turn = std::chrono::milliseconds(2500);
  EXPECT_EQ(gap.take(4090, at(0), turn), 0u);
  EXPECT_EQ(gap.take(4091, at(0.1), turn), 0u);
  EXPECT_EQ(gap.take(4, at(0.2), turn), 8u);
  EXPECT_EQ(gap.take(4, at(0.3), turn), 0u);     // again
  EXPECT_EQ(gap.take(3000, at(0.4), turn), 0u);  // began anew
  EXPECT_EQ(gap.take(3100, at(60), turn), 0u);   // after a pause
}

}  // namespace
}  // namespace skerry::captures
