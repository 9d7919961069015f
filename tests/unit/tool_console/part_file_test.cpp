// What the tools write is there whole or not at all.
#include "echo/tool_console/part_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "echo/tool_console/console.hpp"

namespace skerry::echo {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PartFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // What the error says, "" if there is none.
  static std::string fault_of_writing(const fs::path& file) {
    try {
      write_file(file, "text");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_ = fs::path(testing::TempDir()) / ("part_files_" + std::to_string(::getpid()));
  fs::path file_ = folder_ / "out.txt";
};

TEST_F(PartFiles, StandsUnderItsNameOnceItIsWhole) {
  PartFile part(file_);
  part.write("new");
  EXPECT_FALSE(fs::exists(file_));
  part.finish();
  EXPECT_EQ(text_of(file_), "new");
  EXPECT_FALSE(fs::exists(file_.string() + ".part"));
}

TEST_F(PartFiles, LeavesWhatStoodThereIfItIsGivenUp) {
  write_file(file_, "old");
  {
    PartFile part(file_);
    part.write("half of the n");
  }
  EXPECT_EQ(text_of(file_), "old");
  EXPECT_FALSE(fs::exists(file_.string() + ".part"));
  write_file(file_, "new");
  EXPECT_EQ(text_of(file_), "new");
}

TEST_F(PartFiles, SaysTheSystemsReason) {
  EXPECT_THAT(fault_of_writing(folder_ / "none" / "out.txt"), HasSubstr("No such file"));
  EXPECT_EQ(fault_of_writing("/dev/full"), "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(fs::exists("/dev/full"));
  EXPECT_THAT(fault_of_writing(folder_), HasSubstr("Is a directory"));
}

TEST_F(PartFiles, WritesWhereALinkLeads) {
  write_file(folder_ / "there.txt", "old");
  fs::create_symlink("there.txt", file_);
  write_file(file_, "new");
  EXPECT_TRUE(fs::is_symlink(file_));
  EXPECT_EQ(text_of(folder_ / "there.txt"), "new");
}

}  // namespace
}  // namespace skerry::echo
