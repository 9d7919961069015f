// Controlling the running server from the command line: what another console sees of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

class Control : public testing::Test {
 protected:
  // `skerry set`, which must succeed.
  void set(const std::vector<std::string>& arguments) const {
    const Ending ending = server_.skerry("set", arguments);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.out, "OK\n");
  }
  wire::Status status() const {
    client::SpokeClient client = connected(server_);
    auto status = client.get_status(kAnswerTime);
    if (!status) throw std::runtime_error(status.error().text);
    return std::move(status).value();
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("small.yaml", small_scenario())}};
};

TEST_F(Control, SettingsReachEveryConsoleOfTheViewAndNoOther) {
  client::SpokeClient console = subscribed(server_, 0);
  client::SpokeClient other = subscribed(server_, 2);
  set({"--gain", "70", "--range", "3", "--sea", "35", "--rain", "15"});
  const auto seen =
      await<wire::Settings>(console, [](const wire::Settings& s) { return s.gain() == 70.0; });
  EXPECT_EQ(seen.range_nm(), 3.0);
  EXPECT_EQ(seen.sea(), 35.0);
  EXPECT_EQ(seen.rain(), 15.0);
  await<Spoke>(console, [](const Spoke& spoke) {
    return spoke.header.range_scale == *RangeScale::find(3.0);
  });
  const wire::Status after = status();
  EXPECT_EQ(after.radars(0).settings().gain(), 70.0);
  EXPECT_EQ(after.radars(2).settings().gain(), 50.0);
  EXPECT_EQ(after.radars(2).settings().range_nm(), 12.0);
  for (unsigned i = 0; i < kSmallSpokes; ++i) {
    EXPECT_EQ(next_spoke(other).header.range_scale, *RangeScale::find(12.0));
  }
}

TEST_F(Control, OrdersTurnTheOwnShipAndHerSpokesWithHer) {
  client::SpokeClient console = subscribed(server_, 0);
  const double before = next_spoke(console).header.heading.in_degrees();
  EXPECT_NEAR(before, 335.0, 1.0);
  set({"--course", "45", "--speed", "20"});
  const auto ordered = await<wire::OwnShip>(
      console, [](const wire::OwnShip& ship) { return ship.ordered_course_deg() == 45.0; });
  EXPECT_EQ(ordered.name(), "Tern");
  EXPECT_NEAR(ordered.ordered_speed_kn(), 20.0, 1e-9);
  // 70 deg to starboard, through north.
  await<Spoke>(console, [](const Spoke& spoke) {
    const double heading = spoke.header.heading.in_degrees();
    return heading > 40.0 && heading < 50.0;
  });
  await<wire::OwnShip>(console, [](const wire::OwnShip& ship) { return ship.speed_kn() > 19.0; });
  const wire::Status after = status();
  EXPECT_EQ(after.radars(2).own_ship().ordered_course_deg(), 5.0) << "the other own ship";
}

TEST_F(Control, WhatIsOutOfRangeIsRefusedWithTheRangeAndChangesNothing) {
  struct Case {
    std::vector<std::string> arguments;
    std::vector<const char*> message;
  };
  const std::vector<Case> cases = {
      {{"--gain", "101"}, {"gain", "101", "0 to 100"}},
      {{"--sea", "-1"}, {"sea", "-1", "0 to 100"}},
      {{"--rain", "100.5"}, {"rain", "100.5", "0 to 100"}},
      {{"--range", "5"}, {"range", "5", "0.125", "96"}},
      {{"--course", "400"}, {"course", "400", "0 to 360"}},
      {{"--speed", "61"}, {"speed", "61", "-10 to 60"}},
      {{"--gain", "80", "--course", "90", "--range", "7"}, {"range", "7"}},
      {{"--radar", "9", "--gain", "80"}, {"radar 9", "0 to 2"}},
  };
  const wire::Status before = status();
  for (const auto& [arguments, message] : cases) {
    SCOPED_TRACE(arguments[0] + " " + arguments[1]);
    const Ending ending = server_.skerry("set", arguments);
    EXPECT_EQ(ending.code, 1);
    EXPECT_EQ(ending.out, "");
    for (const char* part : message) EXPECT_THAT(ending.err, HasSubstr(part));
  }
  const wire::Status after = status();
  for (int radar = 0; radar < before.radars_size(); ++radar) {
    EXPECT_EQ(after.radars(radar).settings().SerializeAsString(),
              before.radars(radar).settings().SerializeAsString());
    EXPECT_EQ(after.radars(radar).own_ship().ordered_course_deg(),
              before.radars(radar).own_ship().ordered_course_deg());
    EXPECT_EQ(after.radars(radar).own_ship().ordered_speed_kn(),
              before.radars(radar).own_ship().ordered_speed_kn());
  }
}

double mean_level(const Scan& scan) {
  double sum = 0.0;
  for (const auto& spoke : scan.spokes) {
    sum += std::accumulate(spoke->cells.begin(), spoke->cells.end(), 0.0);
  }
  return sum / (static_cast<double>(kSmallSpokes) * kSmallCells);
}

TEST_F(Control, MoreGainMakesABrighterPicture) {
  client::SpokeClient console = subscribed(server_, 0);
  std::vector<double> levels;
  for (const char* gain : {"20", "50", "80"}) {
    set({"--gain", gain});
    await<wire::Settings>(console,
                          [&](const wire::Settings& s) { return s.gain() == std::stod(gain); });
    levels.push_back(mean_level(next_scan(console)));
  }
  // Twice as far as noise and speckle move the mean of a turn, by far.
  EXPECT_GT(levels[1], levels[0] + 5.0);
  EXPECT_GT(levels[2], levels[1] + 5.0);
}

// Of the cells of `near` that show a strong echo, how many show one in `far` at the cell that
// `cell_in_far` gives.
template <typename CellInFar>
double agreement(const Scan& near, const Scan& far, CellInFar cell_in_far) {
  constexpr std::uint8_t kStrong = 128;
  double strong = 0.0, shared = 0.0;
  for (std::size_t i = 0; i < kSmallSpokes; ++i) {
    const auto& cells = near.spokes[i]->cells;
    for (std::size_t n = 40; n < kSmallCells; ++n) {  // beyond what sea clutter may fill
      if (cells[n] < kStrong) continue;
      ++strong;
      if (far.spokes[i]->cells[cell_in_far(n)] >= kStrong) ++shared;
    }
  }
  EXPECT_GT(strong, 1000.0) << "no land to compare";
  return shared / strong;
}

TEST_F(Control, AnotherRangeScaleShowsTheSameLandAtTheSameMetres) {
  client::SpokeClient console = subscribed(server_, 0);
  const auto scan_at = [&](const char* range_nm) {
    set({"--range", range_nm});
    await<Spoke>(console, [&](const Spoke& spoke) {
      return spoke.header.range_scale == *RangeScale::find(std::stod(range_nm));
    });
    // The coast is made anew for the scale on a thread of its own; the first turn may be without.
    next_scan(console);
    return next_scan(console);
  };
  const Scan near = scan_at("3"), far = scan_at("6");
  EXPECT_DOUBLE_EQ(far.spokes[0]->header.cell_size().in_metres(),
                   2.0 * near.spokes[0]->header.cell_size().in_metres());
  const double by_metres = agreement(near, far, [](std::size_t n) { return n / 2; });
  const double by_cell = agreement(near, far, [](std::size_t n) { return n; });
  std::printf("strong cells that agree: %.3f by metres, %.3f by cell number\n", by_metres, by_cell);
  EXPECT_GT(by_metres, 0.8);
  EXPECT_LT(by_cell, by_metres - 0.2);
}

TEST_F(Control, ASnapshotIsAPngOfTheSizeAskedForAndTheCellsBesides) {
  const std::string png = folder_.path("ppi.png"), pgm = folder_.path("cells.pgm");
  const Ending ending = server_.skerry("snapshot", {"-o", png, "--raw", pgm, "--size", "400"});
  ASSERT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("512 spokes of 512 cells"));
  const std::string picture = text_of_file(png);
  ASSERT_GT(picture.size(), 5000u) << "an empty picture is smaller";
  EXPECT_EQ(picture.substr(0, 8), std::string("\x89PNG\r\n\x1a\n"));
  const auto size_at = [&](std::size_t at) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i)
      size = size << 8 | static_cast<std::uint8_t>(picture[at + i]);
    return size;
  };
  EXPECT_EQ(size_at(16), 400u);
  EXPECT_EQ(size_at(20), 400u);
  const std::string cells = text_of_file(pgm);
  ASSERT_GE(cells.size(), 512u * 512u);
  EXPECT_EQ(cells.substr(0, 2), "P5");
  EXPECT_GT(std::count_if(cells.end() - 512 * 512, cells.end(),
                          [](char c) { return static_cast<std::uint8_t>(c) >= 128; }),
            1000);
}

TEST_F(Control, ADumpHasALinePerSpoke) {
  const Ending ending =
      server_.skerry("dump", {"--count", "20", "--format", "hex", "--radar", "1"});
  ASSERT_EQ(ending.code, 0) << ending.err;
  std::istringstream lines(ending.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("sequence,scan,index,")) << line;
  std::uint64_t previous = 0;
  int count = 0;
  while (std::getline(lines, line)) {
    const std::uint64_t sequence = std::stoull(line);
    if (count++ > 0) {
      EXPECT_EQ(sequence, previous + 1);
    }
    previous = sequence;
    EXPECT_EQ(line.size() - line.rfind(',') - 1, 2 * kSmallCells) << "hex digits of the cells";
  }
  EXPECT_EQ(count, 20);
}

TEST_F(Control, StatusIsWrittenAsATableAndAsJson) {
  const Ending table = server_.skerry("status");
  EXPECT_EQ(table.code, 0) << table.err;
  for (const char* part : {"Tern", "Gannet", "Eight bits", "scenario Small"}) {
    EXPECT_THAT(table.out, HasSubstr(part));
  }
  const Ending json = server_.skerry("status", {"--json"});
  EXPECT_EQ(json.code, 0) << json.err;
  EXPECT_THAT(json.out, HasSubstr("\"scenario\": \"Small\""));
}

}  // namespace
}  // namespace skerry::system_test
