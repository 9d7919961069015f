#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "echo/chart/gshhg_reader.hpp"

namespace skerry::echo {
namespace {

using testing::HasSubstr;

std::string error_of(const std::filesystem::path& file) {
  try {
    (void)GshhgReader::open(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("skerry-chart-test-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(GshhgRefusal, NoChartNamesThePackageToInstall) {
  const ScratchFolder folder;
  try {
    (void)GshhgReader::find_finest({folder.path()});
    FAIL() << "found a chart in an empty folder";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("apt-get install gmt-gshhg-full"));
    EXPECT_THAT(error.what(), HasSubstr(folder.path().string()));
  }
}

TEST(GshhgRefusal, TheFinestFileIsChosen) {
  const ScratchFolder folder;
  for (const char* r : {"c", "i", "h"})
    std::ofstream(folder.path() / (std::string("binned_GSHHS_") + r + ".nc"));
  EXPECT_EQ(GshhgReader::find_finest({folder.path()}).filename(), "binned_GSHHS_h.nc");
}

TEST(GshhgRefusal, AFileThatIsNoChartIsNamed) {
  const ScratchFolder folder;
  const auto file = folder.path() / "binned_GSHHS_f.nc";
  EXPECT_THAT(error_of(file), HasSubstr("cannot open"));
  std::ofstream(file) << "not a chart at all";
  EXPECT_THAT(error_of(file), HasSubstr(file.string()));
}

TEST(GshhgRefusal, ATruncatedChartIsRefusedAtEveryLengthTried) {
  const std::filesystem::path whole = "/usr/share/gmt-gshhg/binned_GSHHS_c.nc";
  if (!std::filesystem::exists(whole)) GTEST_SKIP() << "no chart; install gmt-gshhg-low";
  const ScratchFolder folder;
  const auto file = folder.path() / "binned_GSHHS_c.nc";
  const auto size = std::filesystem::file_size(whole);
  for (std::uintmax_t keep = 0; keep < size; keep += size / 23) {
    std::filesystem::copy_file(whole, file, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(file, keep);
    EXPECT_THAT(error_of(file), HasSubstr(file.string())) << keep << " bytes of " << size;
  }
}

}  // namespace
}  // namespace skerry::echo
