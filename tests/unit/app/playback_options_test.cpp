#include "server/app/options/playback_options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options/options.hpp"

namespace skerry::server {
namespace {

Options options_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "skerryd");
  return *read_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(PlaybackOptions, OfTheConfigurationFileGiveWayToTheCommandLine) {
  const std::string file = testing::TempDir() + "/skerry_playback_options.yaml";
  std::ofstream(file) << "scenario: of_file.yaml\nplayback:\n  file: of_file.mcap\n";
  EXPECT_EQ(options_of({"--config", file.c_str()}).playback.file, "of_file.mcap");
  EXPECT_EQ(options_of({"--config", file.c_str(), "--play", "line.mcap"}).playback.file,
            "line.mcap");
  const Options radars = options_of({"--config", file.c_str(), "--scenario", "line.yaml"});
  EXPECT_EQ(radars.playback.file, "");
  EXPECT_EQ(radars.scenario, "line.yaml");
  EXPECT_THROW(options_of({"--scenario", "line.yaml", "--play", "line.mcap"}), std::runtime_error);
}

TEST(PlaybackOptions, OfTheCommandLineChangeThoseOfTheFile) {
  const std::string file = testing::TempDir() + "/skerry_playback_parts.yaml";
  std::ofstream(file) << "playback: {file: of_file.mcap, rate: 4, loop: true, from: departure}\n";
  const PlaybackOptions faster =
      options_of({"--config", file.c_str(), "--play-rate", "20", "--play-paused"}).playback;
  EXPECT_EQ(faster.file, "of_file.mcap");
  EXPECT_EQ(faster.rate, 20.0);
  EXPECT_TRUE(faster.loop);
  EXPECT_TRUE(faster.paused);
  EXPECT_EQ(faster.from, "departure");
  EXPECT_FALSE(options_of({"--config", file.c_str(), "--play-loop=false"}).playback.loop);
  const PlaybackOptions other =
      options_of({"--config", file.c_str(), "--play", "line.mcap", "--play-from", "1:30"}).playback;
  EXPECT_EQ(other.rate, 1.0) << "what was said of another recording does not hold";
  EXPECT_FALSE(other.loop);
  EXPECT_EQ(other.from, "1:30");
}

TEST(PlaybackOptions, NeedARecording) {
  EXPECT_THROW(options_of({"--play-rate", "2"}), std::runtime_error);
  EXPECT_THROW(options_of({"--scenario", "line.yaml", "--play-loop"}), std::runtime_error);
  EXPECT_THROW(options_of({"--play", "line.mcap", "--play-rate", "101"}), std::runtime_error);
  EXPECT_THROW(options_of({"--play", "line.mcap", "--play-rate", "nan"}), std::runtime_error);
  EXPECT_THROW(options_of({"--play", ""}), std::runtime_error);
}

}  // namespace
}  // namespace skerry::server
