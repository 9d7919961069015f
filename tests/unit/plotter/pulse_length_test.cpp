// What is learnt of the pulse, and from whom.
#include "server/plotter/plots/pulse_length.hpp"

#include <gtest/gtest.h>

#include <array>

namespace skerry::server {
namespace {

constexpr double kCell_m = 10.0;

TEST(PulseLength, IsWhatAFifthOfEchoesInSeveralDirectionsStayBelow) {
  PulseLength pulse(0.0);
  EXPECT_EQ(pulse.of(kCell_m), 30.0);
  // Ten ships all round, of 60 to 240 m: the second one is the shortest but one.
  double mean_m = 0.0;
  for (int turn = 0; turn < 400; ++turn) {
    for (int ship = 0; ship < 10; ++ship)
      pulse.learn(60.0 + 20.0 * (ship * 7 % 10), kCell_m, turn + 0.1 * ship);
    if (turn >= 300) mean_m += pulse.of(kCell_m) / 100.0;
  }
  EXPECT_GT(mean_m, 58.0);
  EXPECT_LT(mean_m, 100.0);
}

TEST(PulseLength, AShipThatIsAloneTeachesNothingWhereverSheIsAndWithHerSideLobes) {
  for (const double degrees_a_turn : {0.0, 3.0, -3.0}) {
    PulseLength pulse(0.0);
    for (int turn = 0; turn < 500; ++turn)
      for (const double lobe_deg : {-15.0, -8.0, 0.0, 8.0, 15.0})
        pulse.learn(200.0, kCell_m, turn + (degrees_a_turn * turn + lobe_deg) / 360.0);
    EXPECT_EQ(pulse.of(kCell_m), 30.0) << degrees_a_turn;
  }
}

TEST(PulseLength, IsLearntTheFasterTheMoreDirectionsThereAre) {
  double before_m = 30.0;
  for (int ships = 2; ships <= static_cast<int>(PulseLength::kWhole); ++ships) {
    PulseLength pulse(0.0);
    int count = 0;
    for (int turn = 0; count < 100; ++turn)
      for (int ship = 0; ship < ships && count < 100; ++ship, ++count)
        pulse.learn(500.0, kCell_m, turn + 0.15 * ship);
    EXPECT_GT(pulse.of(kCell_m), before_m + 2.0) << ships;
    before_m = pulse.of(kCell_m);
  }
}

TEST(PulseLength, IsAsToldAndBeginsAnewWithOtherCells) {
  PulseLength told(75.0);
  for (int i = 0; i < 50; ++i) told.learn(400.0, kCell_m, 0.15 * i);
  EXPECT_EQ(told.of(kCell_m), 75.0);
  PulseLength learnt(0.0);
  for (int i = 0; i < 200; ++i) learnt.learn(400.0, kCell_m, 0.15 * i);
  EXPECT_GT(learnt.of(kCell_m), 60.0);
  EXPECT_EQ(learnt.of(2.0 * kCell_m), 60.0);
}

}  // namespace
}  // namespace skerry::server
