// Charts laid over the world's shoreline, and coasts styled by the scenario, through the real
// server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

// A folder that goes when the test does.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "skerry-charts-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

// An own ship at anchor; no noise (gain 30), so that every echo is one of the coast.
std::string anchored(double lat, double lon, double range_nm, const std::string& more = "") {
  return "name: Anchored\nseed: 5\nown_ships:\n  - name: Tern\n    position: {lat: " +
         std::to_string(lat) + ", lon: " + std::to_string(lon) +
         "}\n    radars:\n      - {name: X, spokes: 512, cells: 512, rpm: 60, gain: 30, sea: 0, "
         "range_nm: " +
         std::to_string(range_nm) + "}\n" + more;
}

// In the open Atlantic, 900 NM from any other land.
constexpr double kLat = 30.0, kLon = -45.0;

// A square island of 1 km half a mile north of it.
constexpr const char* kIsland = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"type": "rocky"}, "geometry": {"type": "Polygon",
   "coordinates": [[[-45.005, 30.010], [-44.995, 30.010], [-44.995, 30.019], [-45.005, 30.019],
                    [-45.005, 30.010]]]}}]})";

Scan scan_of(const std::vector<std::string>& arguments) {
  RunningServer server(arguments);
  client::SpokeClient client = subscribed(server, 0);
  return next_scan(client);
}

std::size_t echoes(const Scan& scan) {
  std::size_t count = 0;
  for (const auto& spoke : scan.spokes) {
    if (!spoke) continue;
    count += static_cast<std::size_t>(std::count_if(spoke->cells.begin(), spoke->cells.end(),
                                                    [](auto cell) { return cell > 0; }));
  }
  return count;
}

// Cell of the first echo of a spoke, or -1.
int leading_edge(const Scan& scan, std::size_t spoke) {
  const auto& video = scan.spokes.at(spoke)->cells;
  const auto at = std::find_if(video.begin(), video.end(), [](auto cell) { return cell > 0; });
  return at == video.end() ? -1 : static_cast<int>(at - video.begin());
}

TEST(Charts, AnIslandOfAGeoJsonFileEchoesWhereItIs) {
  const Folder folder;
  const std::string scenario = folder.write("s.yaml", anchored(kLat, kLon, 1.5));
  const std::string island = folder.write("island.geojson", kIsland);
  EXPECT_EQ(echoes(scan_of({"--scenario", scenario})), 0u);
  const Scan scan = scan_of({"--scenario", scenario, "--chart", island});
  // 0.010 deg of latitude at 30 N is 1108.5 m; a cell of 1.5 NM in 512 is 5.43 m.  The fractal
  // coast may stand out by its share of the 1 km edge's height.
  EXPECT_NEAR(leading_edge(scan, 0), 1108.5 / (1.5 * 1852.0 / 512.0), 45.0);
  // South of the ship there is no echo.
  EXPECT_EQ(leading_edge(scan, 256), -1);
}

TEST(Charts, TheScenarioSaysHowTheCoastIsRefined) {
  const Folder folder;
  const std::string island = folder.write("island.geojson", kIsland);
  const auto edges = [&](const std::string& method) {
    const std::string scenario = folder.write(
        "s.yaml", anchored(kLat, kLon, 1.5, "coast: {rocky: {method: " + method + "}}\n"));
    const Scan scan = scan_of({"--scenario", scenario, "--chart", island});
    std::vector<int> cells;
    for (const std::size_t spoke : {504u, 506u, 508u, 510u, 0u, 2u, 4u, 6u, 8u}) {
      cells.push_back(leading_edge(scan, spoke));
    }
    return cells;
  };
  // A straight southern shore runs east and west: its range grows as 1 / cos.
  const std::vector<int> straight = edges("straight");
  EXPECT_NEAR(straight[4], 1108.5 / (1.5 * 1852.0 / 512.0), 1.5);
  EXPECT_NEAR(straight[0], straight[8], 1.5);
  for (const std::string method : {"koch", "random_koch", "midpoint", "weierstrass"}) {
    EXPECT_NE(edges(method), straight) << method;
  }
}

std::filesystem::path enc(const char* cell) {
  return std::filesystem::path(SKERRY_SOURCE_DIR) / "../shared/data/enc" / cell;
}

TEST(Charts, AnEncCellShowsThePiersThatTheWorldsShorelineHasNot) {
  if (!std::filesystem::exists(enc("US5WA22M.000"))) {
    GTEST_SKIP() << "no ENC cells beside the project";
  }
  const Folder folder;
  // Commencement Bay, Tacoma.
  const std::string scenario = folder.write("s.yaml", anchored(47.290, -122.440, 1.5));
  const Scan world = scan_of({"--scenario", scenario});
  const Scan cell = scan_of({"--scenario", scenario, "--chart", enc("US5WA22M.000").string()});
  EXPECT_GT(echoes(cell), 1000u);
  std::size_t moved = 0, seen = 0;
  for (std::size_t spoke = 0; spoke < cell.spokes.size(); ++spoke) {
    if (!cell.spokes[spoke] || !world.spokes[spoke]) continue;
    const int a = leading_edge(world, spoke), b = leading_edge(cell, spoke);
    if (b < 0) continue;
    ++seen;
    if (std::abs(a - b) > 3) ++moved;
  }
  std::printf("leading edge elsewhere than in the world's shoreline: %zu of %zu spokes\n", moved,
              seen);
  EXPECT_GT(seen, 100u);
  EXPECT_GT(moved, seen / 4);
}

void expect_refused_naming(std::vector<std::string> arguments,
                           const std::vector<std::string>& parts) {
  arguments.insert(arguments.begin(), skerryd_program());
  const Ending ending = run(std::move(arguments));
  EXPECT_EQ(ending.code, 2) << ending.err;
  for (const std::string& part : parts) EXPECT_THAT(ending.err, HasSubstr(part));
}

TEST(Charts, WhatCannotBeReadIsRefusedByName) {
  const Folder folder;
  expect_refused_naming({"--chart", "/no/such/cell.000", "--check"}, {"/no/such/cell.000"});
  const std::string text = folder.write("garbage.000", "this is no ENC cell");
  expect_refused_naming({"--chart", text, "--check"}, {text});
  const std::string json = folder.write("broken.geojson", R"({"type": "FeatureCollection", "fea)");
  expect_refused_naming({"--chart", json, "--check"}, {json});
  expect_refused_naming({"--elevation", text, "--check"}, {text});
  const std::string rough = folder.write(
      "rough.yaml", anchored(kLat, kLon, 1.5, "coast: {rocky: {method: koch, dimension: 1.4}}\n"));
  expect_refused_naming({"--scenario", rough, "--check"}, {"coast.rocky", "1.4", "1.25"});
}

}  // namespace
}  // namespace skerry::system_test
