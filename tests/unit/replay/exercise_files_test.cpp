#include "server/app/exercise_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() { fs::create_directories(folder_); }
  ~Files() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& bytes) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }
  static std::string charts_of(const ChartFiles& files) {
    return exercise_documents("name: x\n", files)[1].bytes;
  }
  const fs::path folder_ =
      fs::temp_directory_path() / ("skerry-exercise-files-" + std::to_string(getpid()));
};

TEST_F(Files, AreFoundAgainWhereTheyWere) {
  const std::string chart = write("cells/a.000", "aaa");
  write("cells/b.000", std::string(3 << 20, 'b'));
  const std::string folder = (folder_ / "cells").string();
  const ChartFiles files = recorded_charts(charts_of({{folder, chart}, ""}), {});
  EXPECT_EQ(files.charts, (std::vector<std::string>{folder, chart}));
  EXPECT_TRUE(files.elevation.empty());
}

TEST_F(Files, MayLieElsewhere) {
  const std::string chart = write("a.000", "aaa");
  const std::string json = charts_of({{chart}, ""});
  const std::string elsewhere = (folder_ / "moved.000").string();
  fs::rename(chart, elsewhere);
  EXPECT_THROW(recorded_charts(json, {}), std::runtime_error);
  // The name is part of what a chart is: ENC updates go by it.
  fs::create_directories(folder_ / "new");
  fs::rename(elsewhere, folder_ / "new" / "a.000");
  EXPECT_EQ(recorded_charts(json, {{(folder_ / "new" / "a.000").string()}, ""}).charts.size(), 1u);
}

TEST_F(Files, AreRefusedWhenTheyAreOthers) {
  const std::string chart = write("a.000", std::string(3 << 20, 'a'));
  const std::string json = charts_of({{chart}, ""});
  std::string changed(3 << 20, 'a');
  changed.back() = 'b';
  write("a.000", changed);
  EXPECT_THROW(recorded_charts(json, {}), std::runtime_error);
  write("a.000", std::string((3 << 20) + 1, 'a'));
  EXPECT_THROW(recorded_charts(json, {}), std::runtime_error);
  write("a.000", std::string(3 << 20, 'a'));
  EXPECT_NO_THROW(recorded_charts(json, {}));
  EXPECT_THROW(recorded_charts(json, {{chart, chart}, ""}), std::runtime_error);
}

TEST_F(Files, OfNonsenseAreRefused) {
  for (const char* wrong : {"", "{", "[]", "{\"charts\": 7}", "{\"charts\": [{}]}",
                            "{\"charts\": [{\"path\": 1, \"digest\": 2}]}"}) {
    EXPECT_THROW(recorded_charts(wrong, {}), std::runtime_error) << wrong;
  }
}

}  // namespace
}  // namespace skerry::server
