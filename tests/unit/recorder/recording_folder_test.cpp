#include "server/recorder/recording_folder.hpp"

#include <gtest/gtest.h>
#include <utime.h>

#include <ctime>
#include <fstream>

#include "server/recorder/file_names.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

using Names = std::vector<std::string>;
using std::chrono::seconds;

void put(const std::string& path, std::size_t bytes) {
  std::ofstream(path) << std::string(bytes, 'x');
}

void make_older(const std::string& path, std::time_t by) {
  const utimbuf times{std::time(nullptr) - by, std::time(nullptr) - by};
  ASSERT_EQ(::utime(path.c_str(), &times), 0);
}

TEST(RecordingFolder, IsMadeAndHasOneRecorder) {
  const ScratchFolder scratch;
  const std::string path = scratch.path("deep/in/it");
  RecordingFolder folder(path);
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_GT(folder.free_bytes().value_or(0), 0u);
  EXPECT_THROW(RecordingFolder second(path), FolderError);
}

TEST(RecordingFolder, IsFreeAgainWhenItsRecorderEnds) {
  const ScratchFolder scratch;
  { const RecordingFolder folder(scratch.path()); }
  EXPECT_NO_THROW(RecordingFolder again(scratch.path()));
}

TEST(RecordingFolder, SaysWhatCannotBeMade) {
  const ScratchFolder scratch;
  put(scratch.path("file"), 1);
  try {
    const RecordingFolder folder(scratch.path("file/in"));
    FAIL();
  } catch (const FolderError& error) {
    EXPECT_NE(std::string(error.what()).find(scratch.path("file/in")), std::string::npos);
  }
}

TEST(RecordingFolder, OverwritesNothing) {
  const ScratchFolder scratch;
  put(scratch.path("a.mcap"), 3);
  std::filesystem::create_symlink(scratch.path("elsewhere"), scratch.path("b.mcap"));
  RecordingFolder folder(scratch.path());
  std::uint32_t number = 1;
  EXPECT_THROW(folder.create("a", number, false), FolderError);
  EXPECT_THROW(folder.create("b", number, false), FolderError);
  EXPECT_EQ(std::filesystem::file_size(scratch.path("a.mcap")), 3u);
  EXPECT_FALSE(std::filesystem::exists(scratch.path("elsewhere")));
  EXPECT_EQ(folder.create("a", number, true).name, "a-002.mcap");
  EXPECT_EQ(number, 2u);
}

TEST(RecordingFolder, RemovesTheOldestOfItsOwnAlone) {
  const ScratchFolder scratch;
  RecordingFolder folder(scratch.path());
  put(scratch.path("foreign.mcap"), 5000);
  for (std::uint32_t number = 1; number <= 5; ++number) {
    folder.create("a", number, false);
    std::filesystem::resize_file(scratch.path(file_name("a", number)), 1000);
  }
  EXPECT_EQ(folder.remove_old(0, seconds(0), "a-005.mcap"), Names{});
  EXPECT_EQ(folder.remove_old(5000, seconds(0), "a-005.mcap"), Names{});
  EXPECT_EQ(folder.remove_old(2500, seconds(0), "a-005.mcap"),
            (Names{"a.mcap", "a-002.mcap", "a-003.mcap"}));
  EXPECT_EQ(scratch.recordings(), (Names{"a-004.mcap", "a-005.mcap", "foreign.mcap"}));
  make_older(scratch.path("a-004.mcap"), 7200);
  make_older(scratch.path("a-005.mcap"), 7200);
  make_older(scratch.path("foreign.mcap"), 7200);
  EXPECT_EQ(folder.remove_old(0, seconds(3600), "a-005.mcap"), Names{"a-004.mcap"});
  EXPECT_EQ(folder.remove_old(1, seconds(1), "a-005.mcap"), Names{}) << "never the present one";
}

TEST(RecordingFolder, LeavesAFileThatTookThePlaceOfItsOwn) {
  const ScratchFolder scratch;
  RecordingFolder folder(scratch.path());
  std::uint32_t number = 1;
  const auto made = folder.create("a", number, false);
  EXPECT_TRUE(folder.has(made.file, "a.mcap"));
  put(scratch.path("other"), 1000);
  std::filesystem::rename(scratch.path("other"), scratch.path("a.mcap"));
  EXPECT_FALSE(folder.has(made.file, "a.mcap"));
  EXPECT_EQ(folder.remove_old(1, seconds(0), ""), Names{});
  EXPECT_TRUE(std::filesystem::exists(scratch.path("a.mcap")));
}

TEST(RecordingFolder, BelievesNoListThatLeadsElsewhere) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path("in"));
  std::filesystem::create_directory(scratch.path("in/folder.mcap"));
  put(scratch.path("outside.mcap"), 1000);
  std::filesystem::create_symlink(scratch.path("outside.mcap"), scratch.path("in/link.mcap"));
  std::ofstream(scratch.path("in/.skerry-recorder"))
      << "../outside.mcap\n"
      << scratch.path("outside.mcap") << "\n.skerry-recorder\n\n"
      << "folder.mcap\t1:2.3\nlink.mcap\t1:2.3\ngone.mcap\t1:2.3\n.mcap\n\t\ncut.mca";
  RecordingFolder folder(scratch.path("in"));
  EXPECT_EQ(folder.remove_old(1, seconds(1), ""), Names{});
  EXPECT_TRUE(std::filesystem::exists(scratch.path("outside.mcap")));
  EXPECT_TRUE(std::filesystem::exists(scratch.path("in/folder.mcap")));
}

TEST(RecordingFolder, FreeBytesAreThoseOfWhereItWillBeMade) {
  const ScratchFolder folder;
  EXPECT_GT(free_bytes_at(folder.path("not/yet/made")).value_or(0), 0u);
  EXPECT_GT(free_bytes_at("/").value_or(0), 0u);
  EXPECT_EQ(free_bytes_at("/dev/null/folder"), std::nullopt);
}

}  // namespace
}  // namespace skerry::server
