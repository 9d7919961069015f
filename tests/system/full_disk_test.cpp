// A disk that is full: what was taken waits for room, and what an operator does to make some helps.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "server/recorder/disk_writer.hpp"
#include "server/recorder/series_writer.hpp"
#include "tests/system/small_disk.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::system_test {
namespace {

using server::comes_true;
using server::DiskWriter;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

class FullDisk : public testing::Test {
 protected:
  // False where none can be had.
  bool begin(const std::string& options = "size=6m") {
    disk_.emplace(folder_.path("disk"), options);
    return disk_->is_there();
  }
  server::RecorderConfig config(std::uint64_t reserve_bytes = 0) const {
    server::RecorderConfig config;
    config.folder = folder_.path("disk");
    config.reserve_bytes = reserve_bytes;
    config.max_queue = 16 << 20;
    return config;
  }
  static bool is_done(const DiskWriter& writer) {
    return comes_true([&] { return !writer.state().is_busy; });
  }
  static bool gets_full(const DiskWriter& writer) {
    return comes_true([&] { return writer.state().is_full; });
  }
  std::uintmax_t size_of(const std::string& name) const {
    return std::filesystem::file_size(disk_->path(name));
  }

  server::ScratchFolder folder_;
  std::optional<SmallDisk> disk_;
};

TEST_F(FullDisk, AStartWaitsForRoomForItsFile) {
  if (!begin("size=6m,nr_inodes=3")) GTEST_SKIP() << SmallDisk::kNeeds;  // root, lock, ballast
  disk_->take_a_name();
  DiskWriter writer(config());
  writer.begin("waits");
  writer.take_end(Bytes(1000, 7));
  ASSERT_TRUE(gets_full(writer));
  EXPECT_FALSE(writer.state().failed) << writer.state().problem;
  disk_->make_room();
  ASSERT_TRUE(is_done(writer));
  EXPECT_EQ(writer.state().file, "waits.mcap");
  EXPECT_EQ(size_of("waits.mcap"), 1000u);
}

// Others may fill the disk between a look at it and a write.
TEST_F(FullDisk, WhatWasTakenWaitsForRoomButForTheEnd) {
  if (!begin()) GTEST_SKIP() << SmallDisk::kNeeds;
  DiskWriter writer(config());
  const Bytes chunk(500'000, 7);
  writer.begin("waits");
  ASSERT_EQ(writer.take(chunk, 10), DiskWriter::Taken::yes);
  ASSERT_TRUE(is_done(writer));
  disk_->fill();
  writer.take_end(chunk);  // as if it had not looked
  ASSERT_TRUE(gets_full(writer));
  EXPECT_EQ(writer.take(chunk, 10), DiskWriter::Taken::no_room);
  disk_->make_room();
  ASSERT_TRUE(is_done(writer));
  EXPECT_EQ(size_of("waits.mcap"), 2 * chunk.size());
  EXPECT_TRUE(comes_true([&] { return writer.take({}, 0) == DiskWriter::Taken::yes; }));
  EXPECT_FALSE(writer.state().is_full);
  // The end does not wait: the file then has none, and says so.
  disk_->fill();
  const std::uintmax_t size = size_of("waits.mcap");
  writer.take_end(chunk);
  writer.end();
  ASSERT_TRUE(is_done(writer));
  EXPECT_NE(writer.state().problem.find("skerry recording repair"), std::string::npos);
  EXPECT_FALSE(writer.state().failed);
  EXPECT_EQ(size_of("waits.mcap"), size);
}

TEST_F(FullDisk, WhatWasTakenBeforeAFileWasFollowedByTheNextWaitsToo) {
  if (!begin()) GTEST_SKIP() << SmallDisk::kNeeds;
  DiskWriter writer(config());
  writer.begin("rolls");
  writer.take_end(Bytes(1000, 1));
  ASSERT_TRUE(is_done(writer));
  disk_->fill();
  writer.take_end(Bytes(500'000, 2));
  writer.next_file();
  writer.take_end(Bytes(600'000, 3));
  ASSERT_TRUE(gets_full(writer));
  disk_->make_room();
  ASSERT_TRUE(is_done(writer));
  EXPECT_EQ(size_of("rolls.mcap"), 501'000u);
  EXPECT_EQ(size_of("rolls-002.mcap"), 600'000u);
  EXPECT_EQ(writer.state().spokes_lost, 0u);
  EXPECT_EQ(writer.state().problem, "");
}

// An operator who puts the file elsewhere on the same disk gains no room, and loses nothing.
TEST_F(FullDisk, WhatWasTakenWaitsForAFileThatWasRenamed) {
  if (!begin()) GTEST_SKIP() << SmallDisk::kNeeds;
  DiskWriter writer(config());
  writer.begin("a");
  writer.take_end(Bytes(1000, 1));
  ASSERT_TRUE(is_done(writer));
  disk_->fill();
  std::filesystem::rename(disk_->path("a.mcap"), disk_->path("kept.mcap"));
  ASSERT_TRUE(comes_true([&] { return writer.state().file_is_gone; }));
  writer.take_end(Bytes(500'000, 2));
  ASSERT_TRUE(gets_full(writer));
  disk_->make_room();
  ASSERT_TRUE(is_done(writer));
  EXPECT_EQ(size_of("kept.mcap"), 501'000u);
  EXPECT_EQ(writer.state().spokes_lost, 0u);
}

// The same with a recorder of a radar that goes on, started into "a".
class FullDiskOfARecorder : public FullDisk {
 protected:
  void record() {
    recorder_ = std::make_unique<server::Recorder>(host_, config(256 << 10));
    recorder_->start();
    recorder_->record(server::record_of(wire::Record::START, "a"), "test");
    ASSERT_TRUE(server::reaches(*recorder_, wire::RecorderState::RECORDING));
  }
  bool publish_until(const std::function<bool(const wire::RecorderState&)>& done,
                     milliseconds pause = {}) {
    return comes_true([&] {
      host_.publish();
      std::this_thread::sleep_for(pause);
      return done(recorder_->state());
    });
  }
  static bool is_full(const wire::RecorderState& state) {
    return state.phase() == wire::RecorderState::DISK_FULL;
  }
  // That the next file is "a-002", whole, and has spokes.
  void end() {
    recorder_->record(server::record_of(wire::Record::STOP), "test");
    ASSERT_TRUE(server::reaches(*recorder_, wire::RecorderState::OFF));
    EXPECT_EQ(recorder_->state().file(), "a-002.mcap");
    const server::Recorded file = server::recorded(disk_->path("a-002.mcap"));
    EXPECT_TRUE(file.is_whole);
    EXPECT_FALSE(file.of(recording::Kind::spoke).empty());
  }

  server::RecordedHost host_{1, 1024};
  std::unique_ptr<server::Recorder> recorder_;
};

// An operator who makes room by removing the very file that is being written.
TEST_F(FullDiskOfARecorder, AFileThatIsRemovedMakesRoomForTheNext) {
  if (!begin()) GTEST_SKIP() << SmallDisk::kNeeds;
  record();
  ASSERT_TRUE(publish_until(is_full));
  std::filesystem::remove(disk_->path("a.mcap"));
  ASSERT_TRUE(publish_until([](const wire::RecorderState& state) {
    return state.phase() == wire::RecorderState::RECORDING && state.file() == "a-002.mcap";
  }));
  host_.publish();
  end();
}

TEST_F(FullDiskOfARecorder, FilesDoNotQueueUpWhileTheNextCannotBeMade) {
  // The root, the lock, the list, a file and another.
  if (!begin("size=32m,nr_inodes=5")) GTEST_SKIP() << SmallDisk::kNeeds;
  disk_->take_a_name();
  record();
  std::filesystem::rename(disk_->path("a.mcap"), disk_->path("moved.mcap"));
  constexpr milliseconds kPause{20};
  ASSERT_TRUE(publish_until(is_full, kPause));
  const auto later = steady_clock::now() + 2 * server::SeriesWriter::kGoneAfter + milliseconds(500);
  ASSERT_TRUE(publish_until([&](const auto&) { return steady_clock::now() > later; }, kPause));
  EXPECT_TRUE(is_full(recorder_->state()));
  disk_->make_room();
  ASSERT_TRUE(publish_until([](const auto& state) { return !is_full(state); }, kPause));
  host_.publish();
  end();
}

}  // namespace
}  // namespace skerry::system_test
