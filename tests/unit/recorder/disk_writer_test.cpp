#include "server/recorder/disk_writer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Bytes bytes_of(const std::string& text) { return Bytes(text.begin(), text.end()); }

TEST(DiskWriter, WritesInTheOrderOfTheCallsIntoOneFileAfterTheOther) {
  const ScratchFolder folder;
  for (const Sync sync : {Sync::none, Sync::file, Sync::chunk}) {
    const std::string name = "of " + std::to_string(static_cast<int>(sync));
    RecorderConfig config;
    config.folder = folder.path();
    config.reserve_bytes = 0;
    config.sync = sync;
    DiskWriter disk(config);
    disk.begin(name);
    for (const char* text : {"one ", "two ", "three"}) {
      EXPECT_EQ(disk.take(bytes_of(text), 1), DiskWriter::Taken::yes);
    }
    disk.next_file();
    disk.take(bytes_of("four"), 1);
    disk.end();
    EXPECT_TRUE(comes_true([&] { return !disk.state().is_busy; }));
    EXPECT_EQ(contents(folder.path(name + ".mcap")), "one two three");
    EXPECT_EQ(contents(folder.path(name + "-002.mcap")), "four");
    const DiskState state = disk.state();
    EXPECT_EQ(state.file, name + "-002.mcap");
    EXPECT_EQ(state.file_bytes, 4u);
    EXPECT_EQ(state.total_bytes, 17u);
    EXPECT_GT(state.free_bytes, 0u);
    EXPECT_FALSE(state.failed) << state.problem;
  }
}

TEST(DiskWriter, TakesNothingThatTheReserveIsSpokenForBut) {
  const ScratchFolder folder;
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = std::uint64_t{1} << 62;
  DiskWriter disk(config);
  disk.begin("a");
  ASSERT_TRUE(comes_true([&] { return !disk.state().is_busy; }));  // it has looked
  const std::uint64_t version = disk.state().version;
  EXPECT_EQ(disk.take(bytes_of("chunk"), 1), DiskWriter::Taken::no_room);
  EXPECT_TRUE(disk.state().is_full);
  EXPECT_GT(disk.state().version, version);
  EXPECT_EQ(disk.take_end(bytes_of("end")), DiskWriter::Taken::yes);
  disk.end();
  ASSERT_TRUE(comes_true([&] { return !disk.state().is_busy; }));
  EXPECT_EQ(contents(folder.path("a.mcap")), "end");
}

TEST(DiskWriter, HoldsNoMoreThanItsQueue) {
  const ScratchFolder folder;
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = 0;
  config.max_queue = 1000;
  DiskWriter disk(config);
  disk.begin("a");
  EXPECT_EQ(disk.take(Bytes(1001, 1), 1), DiskWriter::Taken::too_slow);
  EXPECT_EQ(disk.take(Bytes(1000, 1), 1), DiskWriter::Taken::yes);
}

TEST(DiskWriter, AFolderThatCannotBeIsItsStateUntilTheNextBegin) {
  const ScratchFolder folder;
  std::ofstream(folder.path("file")) << "x";
  RecorderConfig config;
  config.folder = folder.path("file");
  config.reserve_bytes = 0;
  DiskWriter disk(config);
  disk.begin("a");
  disk.take(bytes_of("chunk"), 7);
  ASSERT_TRUE(comes_true([&] { return disk.state().failed; }));
  EXPECT_NE(disk.state().problem.find(folder.path("file")), std::string::npos);
  EXPECT_EQ(disk.take(bytes_of("more"), 1), DiskWriter::Taken::failed);
  disk.end();
  ASSERT_TRUE(comes_true([&] { return !disk.state().is_busy; }));
  EXPECT_EQ(disk.state().spokes_lost, 7u);
  std::filesystem::remove(folder.path("file"));
  disk.begin("a");
  EXPECT_FALSE(disk.state().failed);
  EXPECT_EQ(disk.take(bytes_of("chunk"), 1), DiskWriter::Taken::yes);
  disk.end();
  ASSERT_TRUE(comes_true([&] { return !disk.state().is_busy; }));
  EXPECT_EQ(contents(folder.path("file/a.mcap")), "chunk");
}

TEST(DiskWriter, FinishesWhatWasOrderedBeforeItStops) {
  const ScratchFolder folder;
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = 0;
  {
    DiskWriter disk(config);
    disk.begin("a");
    for (int i = 0; i < 100; ++i) disk.take(Bytes(10'000, 'x'), 1);
    disk.end();
  }
  EXPECT_EQ(std::filesystem::file_size(folder.path("a.mcap")), 1'000'000u);
}

TEST(DiskWriter, SaysWhatIsFreeBeforeAnythingIsWrittenAndMakesNothing) {
  const ScratchFolder folder;
  RecorderConfig config;
  config.folder = folder.path("recordings");
  const DiskWriter disk(config);
  EXPECT_TRUE(comes_true([&] { return disk.state().free_bytes > 0; }));
  EXPECT_FALSE(std::filesystem::exists(config.folder));
}

}  // namespace
}  // namespace skerry::server
