#include "server/app/playback_options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options.hpp"

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

}  // namespace
}  // namespace skerry::server
