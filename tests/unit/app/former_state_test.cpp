// Configuration and scenarios that version 0.1 took: today's server takes them, and for what they
// said then.  tests/golden/state/README.md tells what they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "server/app/options/options.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

const fs::path kFormer = SKERRY_SOURCE_DIR "/tests/golden/state/0.1";

Options former_options(const std::string& file) {
  const std::string path = (kFormer / file).string();
  const std::vector<const char*> arguments{"skerryd", "--config", path.c_str()};
  return *read_options(static_cast<int>(arguments.size()), arguments.data());
}

TEST(FormerState, ItsConfigurationSaysWhatItSaid) {
  const Options options = former_options("server.yaml");
  const NetConfig& net = options.net;
  EXPECT_EQ(options.scenario, "crossing");
  EXPECT_EQ(options.charts, (std::vector<std::string>{"US5WA22M.000", "coast.geojson"}));
  EXPECT_EQ(options.elevation, "heights");
  EXPECT_EQ(net.bind, "192.0.2.7");
  EXPECT_EQ(net.tcp_port, 7411);
  EXPECT_EQ(net.http_port, 7481);
  EXPECT_EQ(net.streams.size(), 4u);
  EXPECT_EQ(net.target_outputs.size(), 1u);
  EXPECT_EQ(net.displays.size(), 2u);
  EXPECT_EQ(net.navigation_outputs.size(), 2u);
  EXPECT_EQ(net.navigation_inputs.size(), 1u);
  EXPECT_EQ(options.live.size(), 1u);
  EXPECT_EQ(options.board_ring_bytes, 8u << 20);
  EXPECT_EQ(net.control_token, "a token of the year before");
  EXPECT_EQ(net.tokens, "tokens.yaml");
  EXPECT_EQ(net.users, "users.yaml");
  EXPECT_EQ(net.setups, "setups");
  EXPECT_EQ(options.audit, "audit.jsonl");
  EXPECT_EQ(net.allowed_hosts, std::vector<std::string>{"radar.school.example"});
  EXPECT_EQ(net.web_root, "console");
  EXPECT_EQ(net.max_connections, 400u);
  EXPECT_EQ(net.signalk.dialect, signalk::Dialect::keyed);
  ASSERT_EQ(net.signalk.further_ships.size(), 1u);
  EXPECT_EQ(net.signalk.further_ships[0].port, 7490);
  EXPECT_EQ(options.workers, 1u);
  EXPECT_EQ(options.recorder.folder, "recordings");
  EXPECT_TRUE(options.recorder.record_all_views);
  EXPECT_EQ(options.recorder.compression, recording::Compression::zstd);
  EXPECT_EQ(options.recorder.roll_bytes, 2048ull << 20);
  EXPECT_EQ(options.recorder.keep_time, std::chrono::hours(240));
  EXPECT_EQ(options.recorder.sync, Sync::file);
  const PlaybackOptions played = former_options("played.yaml").playback;
  EXPECT_EQ(played.file, "watch.mcap");
}

TEST(FormerState, ItsScenariosAreGood) {
  std::size_t read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kFormer)) {
    const fs::path& file = entry.path();
    const std::string name = file.filename().string();
    const bool is_scenario = file.parent_path().filename() == "exercises" ||
                             name == "bergen.yaml" || name == "every_section.yaml";
    if (file.extension() != ".yaml" || !is_scenario) continue;
    ++read;
    EXPECT_FALSE(load_scenario(file.string()).name().empty()) << file;
  }
  EXPECT_EQ(read, 8u);
}

}  // namespace
}  // namespace skerry::server
