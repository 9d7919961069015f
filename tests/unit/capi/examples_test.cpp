// The examples, run as a reader of README.md would.
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

struct Ended {
  int code = -1;
  std::string said;
};

Ended run(const std::string& command) {
  Ended ended;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return ended;
  char buffer[512];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) {
    ended.said.append(buffer, n);
  }
  const int status = pclose(pipe);
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  return ended;
}

// A grey picture of that side, with both land and water on it.
void expect_picture(const std::string& file, std::size_t side) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string header = "P5\n" + std::to_string(side) + " " + std::to_string(side) + "\n255\n";
  ASSERT_EQ(bytes.size(), header.size() + side * side);
  EXPECT_EQ(bytes.substr(0, header.size()), header);
  const auto bright = static_cast<std::size_t>(
      std::count_if(bytes.begin() + static_cast<std::ptrdiff_t>(header.size()), bytes.end(),
                    [](char c) { return static_cast<unsigned char>(c) > 100; }));
  EXPECT_GT(bright, side * side / 50);
  EXPECT_LT(bright, side * side / 2);
}

const std::string kC = SKERRY_PPI_C;
const std::string kPython = std::string(SKERRY_PYTHON) +
                            " -B " SKERRY_SOURCE_DIR
                            "/echo/capi/examples/ppi.py " SKERRY_ECHO_LIBRARY;

class CExamples : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == kPython && SKERRY_SANITIZED) {
      GTEST_SKIP() << "an interpreter built without the sanitizer cannot load a library with it";
    }
  }
  std::string picture = testing::TempDir() + "/capi-ppi-" + std::to_string(getpid()) + ".pgm";
};

TEST_P(CExamples, DrawTheSoundOffBergen) {
  if (!world_installed()) GTEST_SKIP() << "no GSHHG chart installed (Debian: gmt-gshhg-full)";
  const Ended ended = run(GetParam() + " " + picture);
  EXPECT_EQ(ended.code, 0) << ended.said;
  expect_picture(picture, GetParam() == kC ? 800 : 500);
  std::filesystem::remove(picture);
}

TEST_P(CExamples, SayWhatIsWrongWithAChart) {
  const Ended ended = run(GetParam() + " " + picture + " 60.27 5.15 6 /no-such-chart.nc");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.said, testing::HasSubstr("no-such-chart.nc"));
  EXPECT_FALSE(std::filesystem::exists(picture));
}

INSTANTIATE_TEST_SUITE_P(All, CExamples, testing::Values(kC, kPython),
                         [](const auto& each) { return each.param == kC ? "C" : "Python"; });

}  // namespace
}  // namespace skerry::capi_test
