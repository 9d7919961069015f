// A recorder that is killed at any moment, its file cut anywhere, its disk full: what was recorded
// up to a second before is there, byte for byte, and becomes a whole file again.
//
// SKERRY_KILLS=1000 for as many kills and cuts, and a fifth as many on a full disk; 20 without.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <random>
#include <thread>

#include "protocol/recording/repair.hpp"
#include "tests/system/child_process.hpp"
#include "tests/system/recorder_child.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::system_test {
namespace {

using recording::Kind;
using server::RecordedHost;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::chrono::nanoseconds kMostLost = std::chrono::seconds(1);

int kills() {
  const char* text = std::getenv("SKERRY_KILLS");
  return text == nullptr ? 20 : std::max(1, std::atoi(text));
}

// The memory in which a child tells what it published.
class Tale {
 public:
  explicit Tale(std::string path) : path_(std::move(path)) {
    const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::ftruncate(file, sizeof(ChildsTale)) != 0) {
      throw std::runtime_error("no memory for the child's tale");
    }
    memory_ = ::mmap(nullptr, sizeof(ChildsTale), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory_ == MAP_FAILED) throw std::runtime_error("no memory for the child's tale");
  }
  ~Tale() { ::munmap(memory_, sizeof(ChildsTale)); }
  Tale(const Tale&) = delete;
  Tale& operator=(const Tale&) = delete;

  const std::string& path() const { return path_; }
  const ChildsTale& told() const { return *static_cast<const ChildsTale*>(memory_); }
  UtcTime begin() const { return UtcTime(Duration(told().begin_utc_ns.load())); }
  // Spokes that had been published then.
  std::uint64_t published(steady_clock::time_point time) const {
    const std::uint64_t entries = told().entries;
    const std::uint64_t first = entries > ChildsTale::kEntries ? entries - ChildsTale::kEntries : 0;
    std::uint64_t spokes = 0;
    for (std::uint64_t i = first; i < entries; ++i) {
      const ChildsTale::Entry& entry = told().told[i % ChildsTale::kEntries];
      if (entry.steady_ns.load() <= time.time_since_epoch().count()) spokes = entry.spokes;
    }
    return spokes;
  }

 private:
  std::string path_;
  void* memory_ = nullptr;
};

struct Found {
  std::uint64_t spokes = 0;
  std::uint64_t next = 0;     // after the last spoke
  std::uint64_t missing = 0;  // before it
  std::uint64_t told = 0;     // of these, told in events
};

// Every spoke of the file must be one that the child published.
Found check_bytes(const std::string& path, UtcTime begin) {
  Found found;
  RecordedHost host;
  host.begin_utc = begin;
  auto reader = recording::RecordingReader::open(path);
  if (!reader.ok()) return found;
  recording::ItemCursor cursor = reader->items();
  wire::Spoke spoke;
  while (const auto item = cursor.next()) {
    const std::string bytes(item->bytes.begin(), item->bytes.end());
    if (item->topic.kind == Kind::event) {
      recording::Event event;
      EXPECT_TRUE(event.ParseFromString(bytes));
      if (event.kind() == recording::Event::DISK_FULL || event.kind() == recording::Event::LOST) {
        found.told += event.count();
      }
    }
    if (item->topic.kind != Kind::spoke) continue;
    if (!spoke.ParseFromString(bytes) || bytes != host.spoke_bytes(0, spoke.sequence())) {
      ADD_FAILURE() << path << ": a wrong spoke at " << found.next;
      return found;
    }
    // The child published some before it recorded.
    if (found.spokes == 0) found.next = spoke.sequence();
    EXPECT_GE(spoke.sequence(), found.next) << path;
    found.missing += spoke.sequence() - found.next;
    found.next = spoke.sequence() + 1;
    ++found.spokes;
  }
  return found;
}

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

// A disk of a few MiB, that is there while the object lives.
class SmallDisk {
 public:
  explicit SmallDisk(std::string folder, const std::string& options = "size=6m")
      : folder_(std::move(folder)) {
    std::filesystem::create_directory(folder_);
    is_there_ = ::mount("none", folder_.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  bool is_there() const { return is_there_; }

 private:
  std::string folder_;
  bool is_there_ = false;
};

TEST_F(SuddenDeath, OnAFullDiskLeavesAFileThatCanBeRead) {
  for (int i = 0; i < std::max(1, kills() / 5); ++i) {
    SCOPED_TRACE(i);
    const SmallDisk disk(folder_.path("disk"));
    if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
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
  const SmallDisk disk(folder_.path("disk"));
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  { std::ofstream(ballast) << std::string(1 << 20, 'x'); }
  RecordedHost host(1, 1024);
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

// An operator who makes room by removing the very file that is being written.
TEST_F(SuddenDeath, AFileRemovedFromAFullDiskMakesRoomForTheNext) {
  const SmallDisk disk(folder_.path("disk"));
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  RecordedHost host(1, 1024);
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 256 << 10;
  server::Recorder recorder(host, config);
  recorder.start();
  recorder.record(server::record_of(wire::Record::START, "a"), "test");
  const auto publish_until = [&](wire::RecorderState::Phase phase, const std::string& name) {
    return server::comes_true([&] {
      host.publish();
      const wire::RecorderState state = recorder.state();
      return state.phase() == phase && state.file() == name;
    });
  };
  ASSERT_TRUE(publish_until(wire::RecorderState::DISK_FULL, "a.mcap"));
  std::filesystem::remove(folder_.path("disk/a.mcap"));
  ASSERT_TRUE(publish_until(wire::RecorderState::RECORDING, "a-002.mcap"));
  host.publish();
  recorder.record(server::record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(server::reaches(recorder, wire::RecorderState::OFF));
  EXPECT_EQ(recorder.state().file(), "a-002.mcap");
  const server::Recorded file = server::recorded(folder_.path("disk/a-002.mcap"));
  EXPECT_TRUE(file.is_whole);
  EXPECT_FALSE(file.of(Kind::spoke).empty());
}

TEST_F(SuddenDeath, AStartWaitsForADiskThatHasRoomForItsFile) {
  const SmallDisk disk(folder_.path("disk"), "size=6m,nr_inodes=3");  // root, lock, ballast
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  { std::ofstream(ballast) << 'x'; }
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 0;
  server::DiskWriter writer(config);
  writer.begin("waits");
  writer.take_end(Bytes(1000, 7));
  ASSERT_TRUE(server::comes_true([&] { return writer.state().is_full; }));
  EXPECT_FALSE(writer.state().failed) << writer.state().problem;
  std::filesystem::remove(ballast);
  ASSERT_TRUE(server::comes_true([&] { return !writer.state().is_busy; }));
  EXPECT_EQ(writer.state().file, "waits.mcap");
  EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/waits.mcap")), 1000u);
}

// Others may fill the disk between a look at it and a write.
TEST_F(SuddenDeath, WhatWasTakenWaitsForADiskThatOthersFilled) {
  const SmallDisk disk(folder_.path("disk"));
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 0;
  config.max_queue = 16 << 20;
  server::DiskWriter writer(config);
  const auto fill = [&] {
    std::ofstream file(ballast);
    while (file << std::string(4096, 'x') << std::flush) continue;
  };
  const Bytes chunk(500'000, 7);
  const auto is_done = [&] { return !writer.state().is_busy; };

  writer.begin("waits");
  ASSERT_EQ(writer.take(chunk, 10), server::DiskWriter::Taken::yes);
  ASSERT_TRUE(server::comes_true(is_done));
  fill();
  // Until the writer has looked, it takes what it has no room for.
  if (writer.take(chunk, 10) == server::DiskWriter::Taken::yes) {
    ASSERT_TRUE(server::comes_true([&] { return writer.state().is_full; }));
    EXPECT_EQ(writer.take(chunk, 10), server::DiskWriter::Taken::no_room);
    std::filesystem::remove(ballast);
    ASSERT_TRUE(server::comes_true(is_done));
    EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/waits.mcap")), 2 * chunk.size());
    EXPECT_TRUE(
        server::comes_true([&] { return writer.take({}, 0) == server::DiskWriter::Taken::yes; }));
    EXPECT_FALSE(writer.state().is_full);
    fill();
  }
  // The end does not wait: the file then has none, and says so.
  const std::uint64_t size = std::filesystem::file_size(folder_.path("disk/waits.mcap"));
  writer.take_end(chunk);
  writer.end();
  ASSERT_TRUE(server::comes_true(is_done));
  EXPECT_NE(writer.state().problem.find("skerry recording repair"), std::string::npos);
  EXPECT_FALSE(writer.state().failed);
  EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/waits.mcap")), size);
}

TEST_F(SuddenDeath, WhatWasTakenBeforeAFileWasFollowedByTheNextWaitsToo) {
  const SmallDisk disk(folder_.path("disk"));
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 0;
  server::DiskWriter writer(config);
  const auto is_done = [&] { return !writer.state().is_busy; };
  writer.begin("rolls");
  writer.take_end(Bytes(1000, 1));
  ASSERT_TRUE(server::comes_true(is_done));
  {
    std::ofstream file(ballast);
    while (file << std::string(4096, 'x') << std::flush) continue;
  }
  writer.take_end(Bytes(500'000, 2));
  writer.next_file();
  writer.take_end(Bytes(600'000, 3));
  ASSERT_TRUE(server::comes_true([&] { return writer.state().is_full; }));
  std::filesystem::remove(ballast);
  ASSERT_TRUE(server::comes_true(is_done));
  EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/rolls.mcap")), 501'000u);
  EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/rolls-002.mcap")), 600'000u);
  EXPECT_EQ(writer.state().spokes_lost, 0u);
  EXPECT_EQ(writer.state().problem, "");
}

// An operator who puts the file elsewhere on the same disk gains no room, and loses nothing.
TEST_F(SuddenDeath, WhatWasTakenWaitsForAFileThatWasRenamed) {
  const SmallDisk disk(folder_.path("disk"));
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 0;
  server::DiskWriter writer(config);
  writer.begin("a");
  writer.take_end(Bytes(1000, 1));
  ASSERT_TRUE(server::comes_true([&] { return !writer.state().is_busy; }));
  {
    std::ofstream file(ballast);
    while (file << std::string(4096, 'x') << std::flush) continue;
  }
  std::filesystem::rename(folder_.path("disk/a.mcap"), folder_.path("disk/kept.mcap"));
  ASSERT_TRUE(server::comes_true([&] { return writer.state().file_is_gone; }));
  writer.take_end(Bytes(500'000, 2));
  ASSERT_TRUE(server::comes_true([&] { return writer.state().is_full; }));
  std::filesystem::remove(ballast);
  ASSERT_TRUE(server::comes_true([&] { return !writer.state().is_busy; }));
  EXPECT_EQ(std::filesystem::file_size(folder_.path("disk/kept.mcap")), 501'000u);
  EXPECT_EQ(writer.state().spokes_lost, 0u);
}

TEST_F(SuddenDeath, FilesDoNotQueueUpWhileTheNextCannotBeMade) {
  // The root, the lock, the list, a file and another.
  const SmallDisk disk(folder_.path("disk"), "size=32m,nr_inodes=5");
  if (!disk.is_there()) GTEST_SKIP() << "needs to mount a tmpfs: run as root";
  const std::string ballast = folder_.path("disk/ballast");
  { std::ofstream(ballast) << 'x'; }
  RecordedHost host(1, 1024);
  server::RecorderConfig config;
  config.folder = folder_.path("disk");
  config.reserve_bytes = 256 << 10;
  server::Recorder recorder(host, config);
  recorder.start();
  recorder.record(server::record_of(wire::Record::START, "a"), "test");
  ASSERT_TRUE(server::reaches(recorder, wire::RecorderState::RECORDING));
  std::filesystem::rename(folder_.path("disk/a.mcap"), folder_.path("disk/moved.mcap"));
  const auto publish_until = [&](const std::function<bool()>& done) {
    return server::comes_true([&] {
      host.publish();
      std::this_thread::sleep_for(milliseconds(20));
      return done();
    });
  };
  const auto is_full = [&] { return recorder.state().phase() == wire::RecorderState::DISK_FULL; };
  ASSERT_TRUE(publish_until(is_full));
  const auto later = steady_clock::now() + 2 * server::SeriesWriter::kGoneAfter + milliseconds(500);
  ASSERT_TRUE(publish_until([&] { return steady_clock::now() > later; }));
  EXPECT_TRUE(is_full());
  std::filesystem::remove(ballast);
  ASSERT_TRUE(publish_until([&] { return !is_full(); }));
  recorder.record(server::record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(server::reaches(recorder, wire::RecorderState::OFF));
  EXPECT_EQ(recorder.state().file(), "a-002.mcap");
  EXPECT_TRUE(server::recorded(folder_.path("disk/a-002.mcap")).is_whole);
}

}  // namespace
}  // namespace skerry::system_test
