// Plots that may be another echo's doing.
#include "server/plotter/tracks/suspect_echoes.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

Plot plot_at(double bearing_deg, double range_m, int level, double second = 10.0) {
  Plot plot;
  plot.bearing = TrueBearing::from(degrees(bearing_deg));
  plot.range_m = range_m;
  plot.greatest = static_cast<std::uint8_t>(level);
  plot.time =
      ScenarioTime(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(second)));
  return plot;
}

// Weak plots at that range all round, as those of an antenna with side lobes.
void add_lobes(SuspectEchoes& suspects, double range_m, int count, double second = 10.0) {
  for (int i = 0; i < count; ++i) suspects.add(plot_at(80.0 + 30.0 * i, range_m, 110, second));
}

TEST(SuspectEchoes, LobesLieAtAStrongEchosRange) {
  SuspectEchoes suspects;
  suspects.add(plot_at(50, 6000, 255));
  add_lobes(suspects, 6000, 3);
  EXPECT_FALSE(suspects.is_suspect(plot_at(200, 6010, 120))) << "boats by chance";
  EXPECT_TRUE(suspects.is_suspect(plot_at(52, 6010, 120))) << "close to the beam one is enough";
  add_lobes(suspects, 6000, 4);
  EXPECT_TRUE(suspects.is_suspect(plot_at(200, 6010, 120)));
  EXPECT_FALSE(suspects.is_suspect(plot_at(200, 6010, 240))) << "as strong";
  EXPECT_FALSE(suspects.is_suspect(plot_at(200, 6150, 120))) << "elsewhere";
  EXPECT_FALSE(suspects.is_suspect(plot_at(200, 6010, 120, 30.0))) << "long after";
  EXPECT_FALSE(suspects.is_suspect(plot_at(50, 6000, 255))) << "itself";
  SuspectEchoes weak;
  weak.add(plot_at(50, 6000, 150));
  add_lobes(weak, 6000, 6);
  EXPECT_FALSE(weak.is_suspect(plot_at(200, 6010, 60)));
}

TEST(SuspectEchoes, ALobeKeepsItsCauseAndABoatDoesNot) {
  SuspectEchoes suspects;
  suspects.add(plot_at(350, 6000, 255));
  suspects.add(plot_at(120, 6000, 250));
  suspects.add(plot_at(200, 6500, 255));
  add_lobes(suspects, 6000, 4);
  add_lobes(suspects, 6500, 4);
  const auto before = suspects.causes_of(plot_at(20, 6010, 120));
  EXPECT_EQ(before.count, 2u);
  suspects.add(plot_at(352, 6000, 255, 12.5));
  suspects.add(plot_at(200, 6500, 255, 12.5));
  EXPECT_TRUE(suspects.causes_of(plot_at(22, 6010, 120, 12.5)).shares_one_with(before));
  EXPECT_FALSE(suspects.causes_of(plot_at(40, 6510, 120, 12.5)).shares_one_with(before));
  EXPECT_FALSE(suspects.causes_of(plot_at(20, 7000, 120, 12.5)).shares_one_with(before));
}

TEST(SuspectEchoes, HoldTheStrongestCausesOfMany) {
  SuspectEchoes suspects;
  for (int i = 0; i < 40; ++i) suspects.add(plot_at(9.0 * i, 6000, 205 + i));
  EXPECT_EQ(suspects.causes_of(plot_at(4, 6000, 214)).count, SuspectEchoes::Causes::kMost);
  EXPECT_EQ(suspects.causes_of(plot_at(4, 6000, 221)).count, 0u);
}

Plot plot_of(double bearing_deg, double range_m, int level, std::uint32_t cells) {
  Plot plot = plot_at(bearing_deg, range_m, level);
  plot.cells = cells;
  return plot;
}

TEST(SuspectEchoes, OfARingAllAreLobesButTheLargest) {
  SuspectEchoes suspects;
  suspects.add(plot_of(250, 3530, 255, 200));
  for (int i = 0; i < 4; ++i) suspects.add(plot_of(20.0 + 40.0 * i, 3530, 245, 9));
  EXPECT_FALSE(suspects.is_suspect(plot_of(20, 3530, 245, 9))) << "five ships by chance";
  for (int i = 4; i < 8; ++i) suspects.add(plot_of(20.0 + 40.0 * i, 3530, 245, 9));
  EXPECT_TRUE(suspects.is_suspect(plot_of(20, 3530, 245, 9))) << "cut off, so as strong";
  EXPECT_FALSE(suspects.is_suspect(plot_of(250, 3530, 255, 200))) << "its cause";
  EXPECT_FALSE(suspects.is_suspect(plot_of(90, 3535, 255, 120))) << "another ship";
  EXPECT_FALSE(suspects.is_suspect(plot_of(20, 3700, 245, 9))) << "another range";
}

TEST(SuspectEchoes, BoatsBeforeLandAreNoRing) {
  SuspectEchoes suspects;
  Plot land = plot_of(250, 3530, 255, 2000);
  land.extended = true;
  suspects.add(land);
  for (int i = 0; i < 8; ++i) suspects.add(plot_of(20.0 + 25.0 * i, 3530, 245, 9));
  EXPECT_FALSE(suspects.is_suspect(plot_of(20, 3530, 245, 9)));
  EXPECT_TRUE(suspects.is_suspect(plot_of(20, 3530, 200, 9))) << "weaker: it may be a lobe of it";
}

TEST(SuspectEchoes, BesideAStrongEchoASmallOneIsItsFirstLobe) {
  SuspectEchoes suspects;
  suspects.add(plot_of(250, 3530, 255, 200));
  EXPECT_TRUE(suspects.is_suspect(plot_of(248, 3530, 250, 9)));
  EXPECT_FALSE(suspects.is_suspect(plot_of(248, 3530, 250, 90)));
  EXPECT_FALSE(suspects.is_suspect(plot_of(240, 3530, 250, 9))) << "farther off";
}

TEST(SuspectEchoes, AnEchosEchoLiesAtTwiceAndThreeTimesItsRange) {
  SuspectEchoes suspects;
  suspects.add(plot_at(359.5, 3000, 255));
  EXPECT_TRUE(suspects.is_suspect(plot_at(0.3, 6010, 180)));
  EXPECT_TRUE(suspects.is_suspect(plot_at(359.0, 8990, 120)));
  EXPECT_FALSE(suspects.is_suspect(plot_at(5.0, 6010, 180))) << "another bearing";
  EXPECT_FALSE(suspects.is_suspect(plot_at(0.3, 6200, 180))) << "another range";
  EXPECT_FALSE(suspects.is_suspect(plot_at(0.3, 1500, 180))) << "half of it";
}

TEST(SuspectEchoes, OfShipsThatAreOneEchoAnyIsSeenAgain) {
  SuspectEchoes suspects;
  Plot two = plot_at(5, 5590, 255);
  two.length_m = 80.0;
  suspects.add(two);
  EXPECT_TRUE(suspects.is_suspect(plot_at(5.2, 2.0 * 5545, 120)));
  EXPECT_FALSE(suspects.is_suspect(plot_at(5.2, 2.0 * 5590 + 200.0, 120)));
  Plot land = two;
  land.range_m = 3000.0;
  land.length_m = 5000.0;
  suspects.add(land);
  EXPECT_FALSE(suspects.is_suspect(plot_at(5.2, 2.0 * 3000 + 400.0, 120)));
}

TEST(SuspectEchoes, DotsOfASartLieInSteps) {
  SuspectEchoes suspects;
  const auto dot = [](int i) { return plot_at(300.0 + 0.1 * (i % 3), 3000.0 + 1185.28 * i, 150); };
  for (int i = 0; i < 3; ++i) suspects.add(dot(i));
  EXPECT_FALSE(suspects.is_suspect(dot(0))) << "three by chance";
  for (int i = 3; i < 6; ++i) suspects.add(dot(i));
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(suspects.is_suspect(dot(i))) << i;
  EXPECT_FALSE(suspects.is_suspect(plot_at(300.0, 3500.0, 150))) << "between them";
  EXPECT_FALSE(suspects.is_suspect(plot_at(310.0, 3000.0, 150))) << "another bearing";
}

TEST(SuspectEchoes, ForgetsAndIsBounded) {
  SuspectEchoes suspects;
  for (int i = 0; i < 10'000; ++i) suspects.add(plot_at(i * 0.7, 1e5 + i, 255));
  EXPECT_FALSE(suspects.is_suspect(plot_at(10.0, 1e6, 10)));
  EXPECT_FALSE(suspects.is_suspect(plot_at(10.0, 0.0, 10)));
}

}  // namespace
}  // namespace skerry::server
