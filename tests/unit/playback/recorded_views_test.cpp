// Recordings of many views.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/playback/player.hpp"
#include "server/playback/recorded_radars.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

TEST(RecordedViews, AreThoseOfADayOfConsolesUpToABound) {
  const RecordedFile file([](recording::RecordingWriter& writer) {
    const RecordedScene scene;
    for (std::uint32_t view = 0; view < RecordedRadars::kMaxViews + 3; ++view) {
      writer.add(recorded_spoke(scene, 0, view, view));
    }
  });
  const recording::RecordingReader reader = file.open();
  const auto radars = radars_of(reader);
  ASSERT_TRUE(radars.ok());
  EXPECT_EQ(radars->radars[0].views.size(), RecordedRadars::kMaxViews);
  EXPECT_THAT(radars->problem, testing::HasSubstr("3 radars or views more"));
}

// A Quantum of 250 short spokes played as an xHD leaves as 1440 longer ones.
TEST(RecordedViews, HoldHalfASecondOfWhateverTheyGoOutAs) {
  wire::RadarInfo quantum;
  quantum.set_spokes_per_turn(250);
  quantum.set_cells(231);
  quantum.set_bits(8);
  quantum.set_rpm(24.0);
  constexpr double kXhdTurn = 1440 * (36 + 705), kNavicoTurn = 64 * 17'160;
  for (const double rate : {1.0, 4.0, 10.0, 100.0}) {
    const double turns = 24.0 / 60.0 * rate * in_seconds(Player::kHeld);
    for (const double turn : {kXhdTurn, kNavicoTurn}) {
      const double held = static_cast<double>(Player::held_bytes(quantum, rate));
      EXPECT_GE(held, std::min<double>(turn * turns, Player::kMostHeld)) << rate;
    }
  }
  EXPECT_EQ(Player::held_bytes(quantum, 1e6), Player::kMostHeld);
}

TEST(RecordedViews, OfAllRadarsHaveABoundToo) {
  const RecordedFile file([](recording::RecordingWriter& writer) {
    const RecordedScene scene{.cells = 16};
    std::uint64_t n = 0;
    for (std::uint32_t radar = 0; radar < 9; ++radar) {
      for (std::uint32_t view = 0; view < RecordedRadars::kMaxViews; ++view) {
        writer.add(recorded_spoke(scene, radar, view, n++));
      }
    }
  });
  const recording::RecordingReader reader = file.open();
  const auto radars = radars_of(reader);
  ASSERT_TRUE(radars.ok());
  std::size_t views = 0;
  for (const RecordedRadar& radar : radars->radars) views += radar.views.size();
  EXPECT_EQ(views, RecordedRadars::kMaxAllViews);
  EXPECT_THAT(radars->problem, testing::HasSubstr("256 radars or views more"));
}

}  // namespace
}  // namespace skerry::server
