// A recorder that is killed at any moment, its file cut anywhere, its disk full: what was recorded
// up to a second before is there, byte for byte, and becomes a whole file again.
//
// SKERRY_KILLS=1000 for as many kills and cuts, and a fifth as many on a full disk; 20 without.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "protocol/recording/repair.hpp"
#include "tests/system/child_process.hpp"
#include "tests/system/small_disk.hpp"
#include "tests/system/sudden_death_kit.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::system_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// The repaired file is whole and has the same spokes.
void check_repair(const std::string& path, UtcTime begin, const Found& before) {
  const std::string to = path + ".repaired";
  const auto report = recording::repair(path, to);
  if (!report.ok()) {
    // Not even the beginning was there.
    EXPECT_EQ(before.spokes, 0u) << report.error().to_string();
    return;
  }
  const auto reader = recording::RecordingReader::open(to);
  ASSERT_TRUE(reader.ok());
  EXPECT_FALSE(reader->summary().damage.has_value()) << reader->summary().damage->to_string();
  const Found after = check_bytes(to, begin);
  EXPECT_EQ(after.spokes, before.spokes);
  EXPECT_EQ(after.next, before.next);
  std::filesystem::remove(to);
}

class SuddenDeath : public testing::Test {
 protected:
  // Records in `folder` for that long after it began, or after the disk is full; gives when it was
  // killed.
  steady_clock::time_point record_and_kill(const std::string& folder, const Tale& tale,
                                           milliseconds time, bool until_full = false) {
    ChildProcess child({RECORDER_CHILD_PROGRAM, folder, tale.path(), "a"});
    EXPECT_EQ(child.read_line(), "recording");
    if (until_full) {
      EXPECT_EQ(child.read_line(), "full");
    }
    std::this_thread::sleep_for(time);
    const auto killed = steady_clock::now();
    child.signal(SIGKILL);
    child.wait();
    return killed;
  }
  milliseconds any_time(int most) {
    return milliseconds(std::uniform_int_distribution<int>(0, most)(random_));
  }

  server::ScratchFolder folder_;
  std::mt19937 random_{20261122};
};

TEST_F(SuddenDeath, TakesNoMoreThanTheLastSecond) {
  double worst_ms = 0.0;
  for (int i = 0; i < kills(); ++i) {
    SCOPED_TRACE(i);
    const Tale tale(folder_.path("tale"));
    const auto killed = record_and_kill(folder_.path(), tale, any_time(i % 5 == 0 ? 1500 : 500));
    const Found found = check_bytes(folder_.path("a.mcap"), tale.begin());
    ASSERT_GE(found.next, tale.published(killed - kMostLost));
    EXPECT_EQ(found.missing, found.told);
    auto lost = std::chrono::nanoseconds(0);
    while (lost < kMostLost && tale.published(killed - lost) > found.next) lost += milliseconds(5);
    worst_ms = std::max(worst_ms, std::chrono::duration<double, std::milli>(lost).count());
    check_repair(folder_.path("a.mcap"), tale.begin(), found);
    std::filesystem::remove(folder_.path("a.mcap"));
  }
  fmt::print("{} kills: at most the last {:.0f} ms lost\n", kills(), worst_ms);
}

TEST_F(SuddenDeath, AFileCutAnywhereHasAllBeforeItsLastChunk) {
  const Tale tale(folder_.path("tale"));
  record_and_kill(folder_.path(), tale, milliseconds(1200));
  const std::string whole = folder_.path("a.mcap"), cut = folder_.path("cut.mcap");
  const std::uint64_t size = std::filesystem::file_size(whole);
  const Found all = check_bytes(whole, tale.begin());
  ASSERT_GT(all.spokes, 0u);
  for (int i = 0; i < kills(); ++i) {
    SCOPED_TRACE(i);
    const auto at = std::uniform_int_distribution<std::uint64_t>(0, size)(random_);
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, at);
    const Found found = check_bytes(cut, tale.begin());
    EXPECT_EQ(found.missing, found.told);
    // Spokes are evenly spread over the file; a chunk has 0.4 s of 8000 a second.
    EXPECT_GE(
        static_cast<double>(found.spokes) + 8000.0,
        static_cast<double>(all.spokes) * static_cast<double>(at) / static_cast<double>(size));
    check_repair(cut, tale.begin(), found);
  }
}

TEST_F(SuddenDeath, OnAFullDiskLeavesAFileThatCanBeRead) {
  for (int i = 0; i < std::max(1, kills() / 5); ++i) {
    SCOPED_TRACE(i);
    const SmallDisk disk(folder_.path("disk"));
    if (!disk.is_there()) GTEST_SKIP() << SmallDisk::kNeeds;
    const Tale tale(folder_.path("tale"));
    record_and_kill(folder_.path("disk"), tale, any_time(300), true);
    std::filesystem::copy_file(folder_.path("disk/a.mcap"), folder_.path("a.mcap"));
    const Found found = check_bytes(folder_.path("a.mcap"), tale.begin());
    EXPECT_GT(found.spokes, 0u);
    EXPECT_EQ(found.missing, found.told);
    check_repair(folder_.path("a.mcap"), tale.begin(), found);
    std::filesystem::remove(folder_.path("a.mcap"));
  }
}

// The operator makes room; the recording goes on, and says what is missing.
TEST_F(SuddenDeath, ADiskThatHasRoomAgainIsRecordedToAgain) {
  const SmallDisk disk(folder_.path("disk"), "size=8m");
  if (!disk.is_there()) GTEST_SKIP() << SmallDisk::kNeeds;
  const std::string ballast = folder_.path("disk/ballast");
  // Room for the longest chunk, 2 MiB, wherever the disk was found full: chunks are shorter on a
  // busy machine.
  { std::ofstream(ballast) << std::string(3 << 20, 'x'); }
  server::RecordedHost host(1, 1024);
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 256 << 10;
  server::Recorder recorder(host, config);
  recorder.start();
  recorder.record(server::record_of(wire::Record::START, "a"), "test");
  ASSERT_TRUE(server::reaches(recorder, wire::RecorderState::RECORDING));
  const auto publish_until = [&](wire::RecorderState::Phase phase) {
    return server::comes_true([&] {
      host.publish();
      return recorder.state().phase() == phase;
    });
  };
  ASSERT_TRUE(publish_until(wire::RecorderState::DISK_FULL));
  recorder.record(server::record_of(wire::Record::MARK, "while full"), "test");
  ASSERT_TRUE(server::comes_true([&] {
    host.publish();
    return recorder.state().spokes_lost() > 2000;
  }));
  std::filesystem::remove(ballast);
  ASSERT_TRUE(publish_until(wire::RecorderState::RECORDING));
  for (int i = 0; i < 8; ++i) host.publish();
  recorder.record(server::record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(server::reaches(recorder, wire::RecorderState::OFF));
  const wire::RecorderState state = recorder.state();
  const std::string path = folder_.path("disk/a.mcap");
  const Found found = check_bytes(path, host.begin_utc);
  EXPECT_EQ(found.spokes, state.spokes());
  EXPECT_EQ(found.missing, state.spokes_lost());
  EXPECT_EQ(found.told, state.spokes_lost());
  EXPECT_EQ(found.spokes + found.missing, host.published());
  const server::Recorded file = server::recorded(path);
  EXPECT_TRUE(file.is_whole);
  ASSERT_EQ(file.events(recording::Event::MARK).size(), 1u);
  EXPECT_EQ(file.events(recording::Event::MARK)[0].text(), "while full");
}

}  // namespace
}  // namespace skerry::system_test
