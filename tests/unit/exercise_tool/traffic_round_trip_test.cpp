// Shipped exercises as logs of AIS and back: the ships sail as they did.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "protocol/nmea/log_line.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/traffic_list.hpp"
#include "server/exercise_tool/exercise_run.hpp"
#include "server/exercise_tool/traffic_export.hpp"
#include "server/traffic_logs/log_files.hpp"
#include "server/traffic_logs/traffic_fragment.hpp"
#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

// 1e-4 minute of latitude and as much of longitude, half of each; and 1e-7 degree.
constexpr double kAisStep_m = 0.5 * 1.8553 * 0.1 * 1.41422 + 0.02;
constexpr double kTolerance_m = 30.0;

using Seconds = std::map<int, GeoPoint>;
using Ways = std::map<std::uint32_t, Seconds>;  // by MMSI

double metres_between(GeoPoint a, GeoPoint b) {
  const ShortWay way = short_way_between(a, b);
  return std::hypot(way.north_m, way.east_m);
}

// Where each target that is a ship or boat says she is, every second; own ships are left out.
void note(const WorldState& state, int second, Ways& ways) {
  const auto own = static_cast<std::uint32_t>(state.scenario->own_ships_size());
  for (const TrafficItem& item : traffic_of(state, state.time)) {
    const bool sails = item.kind == TrafficKind::ship || item.kind == TrafficKind::boat;
    const AisSaid said = said_by_ais(item);
    if (item.number <= own || !sails || said.silent || !said.position) continue;
    ways[item.mmsi][second] = *said.position;
  }
}

Ways ways_of(const std::string& exercise, double minutes) {
  const ExercisePlan plan = exercise_plan(open_scenario(exercise).scenario);
  const auto chart = open_charts({}, "");
  ExerciseRun run(plan, *chart, {minutes, false, false});
  Ways ways;
  run.run({{}, {}, [&](Duration now) {
             note(run.world().state(), static_cast<int>(in_seconds(now)), ways);
             return true;
           }});
  return ways;
}

Ways ways_of(const scenario::Scenario& scenario, int seconds) {
  World world(scenario);
  Ways ways;
  for (int second = 0; second <= seconds; ++second) {
    note(world.state(), second, ways);
    for (int tick = 0; tick < 10; ++tick) world.step();
  }
  return ways;
}

struct Compared {
  double worst_m = 0.0, said_m = 0.0;
  std::size_t compared = 0, missing = 0;
  std::string worst_of;
};

class TrafficRoundTrip : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string exported(const TrafficExport& wanted, const std::string& name) {
    const std::string file = (folder_ / name).string();
    std::ofstream out(file, std::ios::binary);
    export_traffic(
        GetParam(), wanted, [&](std::string_view text) { out << text; }, [](double) {});
    return file;
  }
  Compared compared(const TrafficExport& wanted, const std::string& name) {
    TrackBook book(TrackRules{.tolerance_m = kTolerance_m});
    const auto read = read_log_file(exported(wanted, name), book);
    EXPECT_TRUE(read.ok());
    const auto begin =
        UtcTime(std::chrono::sys_days(std::chrono::year(2026) / 1 / 1).time_since_epoch());
    const TrafficFragment made = traffic_fragment(book.finish(), begin, {}, "test");
    EXPECT_EQ(made.ships_beyond, 0u);
    const Ways before = ways_of(GetParam(), wanted.minutes);
    const Ways after =
        ways_of(parse_scenario("name: a\nown_ships: [{name: \"own\", position: {lat: 0, lon: 0}, "
                               "radars: [{}]}]\n" +
                                   made.yaml,
                               "made.yaml"),
                static_cast<int>(60 * wanted.minutes));
    Compared result;
    result.said_m = made.worst_m;
    for (const auto& [mmsi, seconds] : before) {
      const auto found = after.find(mmsi);
      for (const auto& [second, place] : seconds) {
        if (found == after.end() || !found->second.contains(second)) {
          ++result.missing;
          continue;
        }
        ++result.compared;
        const double off_m = metres_between(found->second.at(second), place);
        if (off_m <= result.worst_m) continue;
        result.worst_m = off_m;
        result.worst_of = std::to_string(mmsi) + " at " + std::to_string(second) + " s";
      }
    }
    for (const auto& [mmsi, seconds] : after) EXPECT_TRUE(before.contains(mmsi)) << mmsi;
    std::printf("%s, %s: %zu places, worst %.2f m (%s), %zu without a ship\n", GetParam(),
                name.c_str(), result.compared, result.worst_m, result.worst_of.c_str(),
                result.missing);
    return result;
  }

  fs::path folder_ =
      fs::path(testing::TempDir()) / ("traffic_round_trip_" + std::to_string(getpid()));
};

// Reported every second, each ship is where she was within the tolerance and AIS's step.
TEST_P(TrafficRoundTrip, EverySecondTheShipsAreWithinTheTolerance) {
  const TrafficExport wanted{.every = std::chrono::seconds(1), .minutes = 20};
  const Compared result = compared(wanted, "log.nmea");
  EXPECT_LE(result.worst_m, kTolerance_m + kAisStep_m);
  EXPECT_GT(result.worst_m, 0.0);
  EXPECT_LE(result.said_m, kTolerance_m);
  // The last second, in which she vanishes, and what is left out where ships are put elsewhere.
  EXPECT_LT(result.missing, result.compared / 100);
}

TEST_P(TrafficRoundTrip, ATableDoesAsWell) {
  const TrafficExport wanted{
      .form = TrafficForm::csv, .every = std::chrono::seconds(1), .minutes = 5};
  const Compared result = compared(wanted, "table.csv");
  EXPECT_LE(result.worst_m, kTolerance_m + kAisStep_m);
  EXPECT_LT(result.missing, result.compared / 50);
}

// At the intervals of AIS the log itself does not say where she was in between: she may have
// turned, of which the chord leaves out some metres.
TEST_P(TrafficRoundTrip, AtTheIntervalsOfAisItIsLittleMore) {
  const TrafficExport wanted{.minutes = 20};
  const Compared result = compared(wanted, "log.nmea");
  EXPECT_LE(result.worst_m, kTolerance_m + kAisStep_m + 5.0);
  EXPECT_LE(result.said_m, kTolerance_m);
}

INSTANTIATE_TEST_SUITE_P(Shipped, TrafficRoundTrip,
                         testing::Values("crossing", "fairway", "tss", "night", "search"),
                         [](const auto& each) { return std::string(each.param); });

// gpsd's decoder reads what is written: names, and each place where the ship was.
class TrafficLogByGpsd : public TrafficRoundTrip {};
TEST_P(TrafficLogByGpsd, EachReportIsWhereTheShipWas) {
  if (::access("/usr/bin/gpsdecode", X_OK) != 0) {
    GTEST_SKIP() << "gpsdecode is not installed: apt-get install gpsd-clients";
  }
  const TrafficExport wanted{.minutes = 5};
  const std::string file = exported(wanted, "log.nmea");
  // When each message began, by the TAG blocks.
  std::vector<int> seconds;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const auto read = nmea::parse_log_line(line);
    ASSERT_TRUE(read.ok() && read->utc) << line;
    if (read->sentence.substr(6, 5) == ",2,2,") continue;
    const UtcTime begin(std::chrono::sys_days(std::chrono::year(2026) / 1 / 1).time_since_epoch());
    seconds.push_back(static_cast<int>(in_seconds(*read->utc - begin)));
  }
  const std::string out = (folder_ / "out.json").string();
  ASSERT_EQ(std::system(("/usr/bin/gpsdecode < '" + file + "' > '" + out + "'").c_str()), 0);
  const Ways ways = ways_of(GetParam(), 5);
  std::size_t message = 0, places = 0, names = 0;
  double worst_m = 0.0;
  std::ifstream objects(out);
  for (std::string text; std::getline(objects, text); ++message) {
    const auto object = nlohmann::json::parse(text);
    ASSERT_EQ(object.at("class"), "AIS") << text;
    ASSERT_LT(message, seconds.size());
    const std::uint32_t mmsi = object.at("mmsi");
    const int type = object.at("type");
    if (type == 5 && !object.at("shipname").get<std::string>().empty()) ++names;
    if (type != 1 && type != 18) continue;
    ++places;
    const auto ship = ways.find(mmsi);
    ASSERT_NE(ship, ways.end()) << mmsi;
    ASSERT_TRUE(ship->second.contains(seconds[message])) << mmsi << " at " << seconds[message];
    worst_m = std::max(worst_m, metres_between({object.at("lat"), object.at("lon")},
                                               ship->second.at(seconds[message])));
    EXPECT_EQ(object.at("second"), seconds[message] % 60);
  }
  EXPECT_EQ(message, seconds.size()) << "it reads every message";
  EXPECT_GT(places, 100u);
  EXPECT_GT(names, 0u);
  // Its own output has six decimals.
  EXPECT_LE(worst_m, kAisStep_m + 0.08);
  std::printf("%s: %zu places by gpsdecode, worst %.3f m\n", GetParam(), places, worst_m);
}
INSTANTIATE_TEST_SUITE_P(Shipped, TrafficLogByGpsd, testing::Values("tss", "crossing"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace skerry::server
