// What is read out of files, whole and broken, and what figures say of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "echo/picture_tool/captured_radars.hpp"
#include "echo/picture_tool/picture_comparison.hpp"
#include "tests/unit/clients/program.hpp"
#include "tests/unit/picture_tool/picture_kit.hpp"

namespace skerry::echo {
namespace {

using client::test_folder;
using test::blobs;
using test::put;
using test::recording_of;
using testing::HasSubstr;

// What read_picture() complains of.
std::string complaint_of(const std::string& file, const PictureChoice& choice = {}) {
  try {
    read_picture(file, choice);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(PictureSource, GivesBackTheTurnsOfARecording) {
  const TurnsOfPicture made = blobs(1, {}, 3);
  const TurnsOfPicture read = read_picture(put(test_folder(), "a.mcap", recording_of(made)));
  EXPECT_EQ(read.spokes, made.spokes);
  EXPECT_EQ(read.cells, made.cells);
  EXPECT_NEAR(read.reach_m, made.reach_m, 1e-6);
  EXPECT_EQ(read.full_scale, 15);
  ASSERT_EQ(read.turns.size(), 3u);
  EXPECT_EQ(read.turns, made.turns);
  EXPECT_EQ(read.follows, (std::vector<bool>{false, true, true}));
}

TEST(PictureSource, RefusesWhatIsNoPictureByItsName) {
  const std::string folder = test_folder();
  EXPECT_THAT(complaint_of(folder + "/none.mcap"), HasSubstr("none.mcap"));
  EXPECT_THAT(complaint_of(put(folder, "empty.pcap", "")), HasSubstr("capture"));
  EXPECT_NE(complaint_of(put(folder, "text.pcap", "This is neither of them, but long enough.")),
            "none");
  const std::string file = put(folder, "a.mcap", recording_of(blobs(1)));
  EXPECT_THAT(complaint_of(file, {.radar = 3}), HasSubstr("no whole turn of radar 3"));
  EXPECT_THAT(complaint_of(file, {.reach_m = 500.0}), HasSubstr("1920 m (1 whole, 0 not)"));
}

TEST(PictureSource, ReadsUpToWhereARecordingIsCut) {
  const std::string folder = test_folder();
  const std::string bytes = recording_of(blobs(1, {}, 4));
  for (const double share : {0.0, 0.01, 0.3, 0.6, 0.9}) {
    const auto length = static_cast<std::size_t>(share * static_cast<double>(bytes.size()));
    const std::string file = put(folder, "cut.mcap", bytes.substr(0, length));
    try {
      const TurnsOfPicture read = read_picture(file);
      EXPECT_GE(read.turns.size(), 1u) << share;
      EXPECT_LE(read.turns.size(), 4u) << share;
    } catch (const std::runtime_error& error) {
      EXPECT_LT(share, 0.9) << error.what();
    }
  }
}

TEST(PictureFigures, OfTurnsThatDoNotFollowHaveNoCorrelationOfTurns) {
  TurnsOfPicture picture = blobs(1, {.holes = 0.1}, 3);
  const auto figures = [&] { return spread_statistics({&picture, 1}, 5.0); };
  EXPECT_GT(figures().mean.turn_lag1, 0.3);
  EXPECT_NEAR(figures().mean.bow_seam, 1.0, 0.9);
  picture.follows = {false, false, false};
  EXPECT_TRUE(std::isnan(figures().mean.turn_lag1));
  EXPECT_TRUE(std::isnan(figures().mean.bow_seam));
  EXPECT_TRUE(std::isfinite(figures().mean.spoke_lag1));
}

TEST(PictureFigures, OfNearlyNothingAreNone) {
  TurnsOfPicture picture = blobs(1);
  for (std::size_t i = 0; i < picture.turns[0].size(); ++i) {
    if (i % 1000 != 0) picture.turns[0][i] = 0;
  }
  const SpreadStatistics figures = spread_statistics({&picture, 1}, 5.0);
  EXPECT_TRUE(figures.empty());
  for (const StatisticRow& row : statistic_rows())
    EXPECT_EQ(std::isfinite(figures.mean.*row.of), row.key == "occupancy") << row.key;
}

TEST(PictureFigures, SpreadIsOverPlacesOrElseOverTurns) {
  const auto places = test::places_of_blobs(1, 3);
  const SpreadStatistics over_places = spread_statistics(places, 5.0);
  EXPECT_EQ(over_places.places, 3u);
  EXPECT_GT(over_places.spread.occupancy, 0.0);
  const TurnsOfPicture one = blobs(1, {.holes = 0.1}, 3);
  const SpreadStatistics over_turns = spread_statistics({&one, 1}, 5.0);
  EXPECT_GT(over_turns.spread.occupancy, 0.0);
  EXPECT_LT(over_turns.spread.occupancy, over_places.spread.occupancy);
}

TEST(CapturedRadars, AreFoundByNameAndReach) {
  const auto far = captured_radar_of("/data/br24-ranges-nm.pcap.gz", 2440.0);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->set, "BR24");
  EXPECT_EQ(far->reach_m, 2454.0);
  EXPECT_FALSE(captured_radar_of("/br24-ranges/other.pcap", 2440.0));
  std::vector<std::string> notes;
  EXPECT_EQ(stand_in_set("3G", notes).name, "3G");
  EXPECT_TRUE(notes.empty());
  EXPECT_EQ(stand_in_set("none such", notes).name, "HALO20");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("none such"));
}

}  // namespace
}  // namespace skerry::echo
