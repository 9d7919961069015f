#include "server/app/options/recorder_options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options/options.hpp"

namespace skerry::server {
namespace {

using std::chrono::hours;
using std::chrono::minutes;

RecorderConfig recorder_of(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "skerryd");
  return read_options(static_cast<int>(arguments.size()), arguments.data())->recorder;
}

std::string config_file(const std::string& text) {
  const std::string path = testing::TempDir() + "/skerry_recorder_options.yaml";
  std::ofstream(path) << text;
  return path;
}

TEST(RecorderOptions, AreSafeAndOffWithoutAny) {
  const RecorderConfig config = recorder_of({});
  EXPECT_EQ(config.folder, "skerry-recordings");
  EXPECT_FALSE(config.record_at_start);
  EXPECT_FALSE(config.record_all_views);
  EXPECT_EQ(config.compression, recording::Compression::lz4);
  EXPECT_FALSE(config.compact);
  EXPECT_EQ(config.roll_bytes, 0u);
  EXPECT_EQ(config.roll_time.count(), 0);
  EXPECT_EQ(config.keep_bytes, 0u);
  EXPECT_EQ(config.keep_time.count(), 0);
  EXPECT_EQ(config.reserve_bytes, 512u << 20);
  EXPECT_EQ(config.sync, Sync::chunk);
}

TEST(RecorderOptions, OfTheConfigurationFileGiveWayToTheCommandLine) {
  const std::string file = config_file(R"(recorder:
  folder: /from/file
  record: true
  compression: zstd
  compact: true
  roll_mib: 2048
  roll_minutes: 60
  keep_gib: 100
  keep_hours: 48
  reserve_mib: 0
  fsync: none
)");
  RecorderConfig config = recorder_of({"--config", file.c_str()});
  EXPECT_EQ(config.folder, "/from/file");
  EXPECT_TRUE(config.record_at_start);
  EXPECT_EQ(config.compression, recording::Compression::zstd);
  EXPECT_TRUE(config.compact);
  EXPECT_EQ(config.roll_bytes, std::uint64_t{2048} << 20);
  EXPECT_EQ(config.roll_time, minutes(60));
  EXPECT_EQ(config.keep_bytes, std::uint64_t{100} << 30);
  EXPECT_EQ(config.keep_time, hours(48));
  EXPECT_EQ(config.reserve_bytes, 0u);
  EXPECT_EQ(config.sync, Sync::none);
  config = recorder_of({"--config", file.c_str(), "--record-folder", "/from/line",
                        "--record-compression", "none", "--record-roll-mib", "1", "--record-fsync",
                        "file", "--record-keep-hours", "1"});
  EXPECT_EQ(config.folder, "/from/line");
  EXPECT_EQ(config.compression, recording::Compression::none);
  EXPECT_EQ(config.roll_bytes, 1u << 20);
  EXPECT_EQ(config.keep_time, hours(1));
  EXPECT_EQ(config.sync, Sync::file);
  EXPECT_TRUE(config.record_at_start);
  EXPECT_FALSE(config.record_all_views);
}

TEST(RecorderOptions, AllViewsAreRecordedFromTheStart) {
  const std::string file = config_file("recorder:\n  record_all_views: true\n");
  for (const RecorderConfig& config :
       {recorder_of({"--config", file.c_str()}), recorder_of({"--record-all-views"})}) {
    EXPECT_TRUE(config.record_at_start);
    EXPECT_TRUE(config.record_all_views);
  }
}

TEST(RecorderOptions, SayWhatIsWrong) {
  EXPECT_THROW(recorder_of({"--record-compression", "gzip"}), std::runtime_error);
  EXPECT_THROW(recorder_of({"--record-fsync", "always"}), std::runtime_error);
  EXPECT_THROW(recorder_of({"--record-roll-mib", "0"}), std::runtime_error);
  const std::string file = config_file("recorder:\n  fsync: sometimes\n");
  EXPECT_THROW(recorder_of({"--config", file.c_str()}), std::runtime_error);
}

}  // namespace
}  // namespace skerry::server
