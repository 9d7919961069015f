#include "echo/receiver/automatic_controls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

constexpr double kNm = 3.0;
constexpr std::uint32_t kTurn = 1024;

ViewControls automatic(double sea = 50.0) {
  ViewControls controls = controls_of(kNm, 80.0);
  controls.sea_auto = true;
  controls.sea = sea;
  return controls;
}

// Surface clutter that falls below noise at 1.5 NM.
double clutter(std::uint64_t spoke, std::uint32_t cell) {
  return std::pow(512.0 / (cell + 0.5), 3.0) * fluctuation(spoke, cell);
}

// The second turn.
std::vector<std::uint8_t> second_turn(const ViewControls& controls, const Echo& echo) {
  ViewReceiver receiver(model_of(kNm, 1.25, kTurn), controls);
  (void)video_of(receiver, echo, 0, kTurn);
  return video_of(receiver, echo, kTurn, kTurn);
}

TEST(AutoSea, BringsClutterDownToNoise) {
  ViewControls by_hand = controls_of(kNm, 80.0);
  const auto open = second_turn(by_hand, clutter), even = second_turn(automatic(), clutter);
  const double noise = share_on(second_turn(automatic(), silence), 60);
  const double near = share_on(even, 60, 120), middle = share_on(even, 200, 300),
               far = share_on(even, 900, 1000);
  std::printf("on: %.3f near, %.3f middle, %.3f far, noise %.3f; without, near %.3f\n", near,
              middle, far, noise, share_on(open, 60, 120));
  EXPECT_GT(share_on(open, 60, 120), 0.98);
  EXPECT_NEAR(near, noise, 0.5 * noise);
  EXPECT_NEAR(middle, noise, 0.5 * noise);
  // Clutter less than kDeadDb over noise stays.
  EXPECT_NEAR(far, noise, 0.35 * noise);
}

TEST(AutoSea, LeavesACalmSeaAsItIs) {
  EXPECT_EQ(second_turn(automatic(), silence), second_turn(controls_of(kNm, 80.0), silence));
}

TEST(AutoSea, TheSeaControlTrimsIt) {
  const auto level = [&](double sea) {
    return share_on(second_turn(automatic(sea), clutter), 60, 120);
  };
  const double less = level(20.0), even = level(50.0), more = level(80.0);
  EXPECT_GT(less, 1.5 * even);
  EXPECT_LT(more, 0.6 * even);
}

TEST(AutoSea, KeepsAShipInTheClutterAndLandOnOneSide) {
  const auto scene = [](std::uint64_t spoke, std::uint32_t cell) {
    const auto in_turn = spoke % kTurn;
    const bool ship = in_turn >= 500 && in_turn < 504 && cell >= 150 && cell < 154;
    const bool land = in_turn >= 700 && in_turn < 900 && cell >= 100 && cell < 800;
    return clutter(spoke, cell) * (ship ? 300.0 : 1.0) +
           (land ? 1e5 * fluctuation(spoke, cell) : 0.0);
  };
  ViewReceiver receiver(model_of(kNm, 1.25, kTurn), automatic());
  (void)video_of(receiver, scene, 0, 2 * kTurn);
  const auto video = video_of(receiver, scene, 2 * kTurn, kTurn);
  double ship = 0.0;
  for (std::size_t s = 500; s < 504; ++s) {
    for (std::size_t i = 150; i < 154; ++i) ship += video[s * kCells + i] > 60;
  }
  const auto ashore =
      std::span(video).subspan(std::size_t{720} * kCells, std::size_t{160} * kCells);
  std::printf("ship on in %.0f of 16 cells, land in %.3f\n", ship, share_on(ashore, 150, 750));
  EXPECT_GE(ship, 10.0);
  EXPECT_GT(share_on(ashore, 150, 750), 0.95);
}

TEST(AutoSea, SectorsCoverATurn) {
  for (std::uint32_t spokes : {256u, 1440u, 2048u, 4096u, 8191u, 8192u}) {
    const AutoSea sea(spokes, 1024, 5.0, 3, -0.83);
    std::uint32_t sampled = 0;
    for (std::uint32_t spoke = 0; spoke < spokes; ++spoke) {
      const std::uint32_t sector = sea.sector_of(spoke);
      ASSERT_LT(sector, AutoSea::kBearings);
      ASSERT_GE(spoke, sea.first_spoke_of(sector));
      ASSERT_LT(spoke, sea.first_spoke_of(sector + 1));
      sampled += sea.samples(spoke);
    }
    EXPECT_GE(sampled, AutoSea::kBearings * 4u);
    EXPECT_LE(sampled, AutoSea::kBearings * 12u);
  }
}

}  // namespace
}  // namespace skerry::echo
