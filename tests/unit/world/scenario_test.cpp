#include "server/world/scenario.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "server/config/config_error.hpp"
#include "tests/scenes/ten_errors.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

const std::string kOwnShip =
    "name: s\n"
    "own_ships:\n"
    "  - name: Frida\n"
    "    position: {lat: 60.4, lon: 5}\n"
    "    radars: [{}, {name: Aft}]\n";
const std::string kTarget = kOwnShip +
                            "targets:\n"
                            "  - name: Rosund\n"
                            "    position: {lat: 60.4, lon: 5}\n";

TEST(Scenario, FillsInDefaultsAndNames) {
  const scenario::Scenario scenario = parse_scenario(kOwnShip, "test.yaml");
  const scenario::OwnShip& ship = scenario.own_ships(0);
  EXPECT_EQ(ship.length_m(), 100.0);
  EXPECT_EQ(ship.turn_time_constant_s(), 8.0);
  EXPECT_EQ(ship.radars(0).name(), "Frida 1");
  EXPECT_EQ(ship.radars(1).name(), "Aft");
  EXPECT_EQ(ship.radars(0).spokes(), 4096u);
  EXPECT_EQ(ship.radars(0).controls().range_nm(), 6.0);
}

TEST(Scenario, RefusesWhatTheSchemaForbids) {
  EXPECT_EQ(refusal(kOwnShip + "    coarse_deg: 3\n"),
            "6:5: own_ships[0].coarse_deg: unknown key; did you mean \"course_deg\"?; known keys: "
            "name, position, course_deg, speed_kn, length_m, beam_m, height_m, "
            "speed_time_constant_s, turn_time_constant_s, max_rate_of_turn_deg_min, radars, "
            "motion, wake, mmsi, ship_type, ship_class, route, turn_radius_nm, wind_model");
  EXPECT_EQ(refusal("name: s\nown_ships:\n  - name: Frida\n    position: {lat: 91, lon: 5}\n"
                    "    radars: [{}]\n"),
            "4:21: own_ships[0].position.lat: 91 is out of range; allowed: -90 to 90 deg");
  EXPECT_EQ(refusal("name: s\nown_ships:\n  - name: Frida\n    position: {lat: 60}\n"
                    "    radars: [{}]\n"),
            "4:15: own_ships[0].position.lon: missing; expected a number, -180 to 180 deg");
  EXPECT_EQ(refusal("name: s\n"), "1:1: own_ships: missing; expected a list");
  EXPECT_EQ(refusal("name: s\nown_ships: []\n"),
            "2:12: own_ships: is empty; expected at least one entry");
  EXPECT_EQ(refusal("name: s\nown_ships:\n  - name: Frida\n    position: {lat: 60, lon: 5}\n"
                    "    radars:\n      - range_nm: 5\n"),
            "6:19: own_ships[0].radars[0].range_nm: 5 is not one of these; allowed: 0.125, 0.25, "
            "0.5, 0.75, 1.5, 3, 6, 12, 24, 48, 72, 96 NM");
  EXPECT_EQ(refusal("name: s\nown_ships:\n  - name: Frida\n    position: {lat: 60, lon: 5}\n"
                    "    radars:\n      - rpm: 24\n      - rpm: 75\n"),
            "7:14: own_ships[0].radars[1].rpm: 75 is out of range; allowed: 10 to 60 turns/min");
}

TEST(Scenario, NamesDiffer) {
  EXPECT_EQ(refusal(kOwnShip + "  - name: Frida\n    position: {lat: 60, lon: 5}\n"),
            "6:11: own_ships[1].name: \"Frida\" is the name of own_ships[0] too (line 3); names "
            "must differ");
  EXPECT_EQ(refusal(kOwnShip +
                    "  - name: Ymer\n    position: {lat: 60, lon: 5}\n    radars: [{name: Aft}]\n"),
            "8:21: own_ships[1].radars[0].name: \"Aft\" is the name of own_ships[0].radars[1] too "
            "(line 5); names must differ");
}

TEST(Scenario, AtLeastOneShipHasARadar) {
  EXPECT_EQ(refusal("name: s\nown_ships:\n  - name: Frida\n    position: {lat: 60, lon: 5}\n"),
            "3:3: own_ships: no own ship has a radar; give one \"radars: [{}]\"");
}

TEST(Scenario, NoShipIsBroaderThanLong) {
  EXPECT_EQ(refusal(kOwnShip + "    length_m: 20\n    beam_m: 21\n"),
            "7:13: own_ships[0].beam_m: beam 21 m is more than length 20 m; allowed: at most the "
            "length");
  EXPECT_EQ(refusal(kTarget + "    length_m: 8\n"),
            "9:15: targets[0].length_m: beam 11 m is more than length 8 m; allowed: at most the "
            "length");
}

TEST(Scenario, WaypointsAreAWay) {
  EXPECT_EQ(refusal(kTarget + "    waypoints: [{lat: 60.5, lon: 5}]\n    speed_kn: 8\n"), "");
  EXPECT_EQ(refusal(kTarget + "    waypoints: [{lat: 60.5, lon: 5}]\n"),
            "7:5: targets[0].speed_kn: 0 with waypoints; allowed: more than 0 kn");
  EXPECT_EQ(refusal(kTarget +
                    "    waypoints: [{lat: 60.5, lon: 5}]\n    speed_kn: 8\n    course_deg: 0\n"),
            "11:17: targets[0].course_deg: 0 given besides waypoints, which set the course; "
            "allowed: one of the two");
  EXPECT_EQ(refusal(kTarget + "    waypoints:\n      - {lat: 60.4, lon: 5}\n    speed_kn: 8\n"),
            "10:9: targets[0].waypoints[0]: the leg to it is 0.000 NM long; allowed: 1 m to 5000 "
            "NM");
  EXPECT_EQ(refusal(kTarget + "    waypoints:\n      - {lat: 60.5, lon: 5}\n"
                              "      - {lat: -60, lon: -175}\n    speed_kn: 8\n"),
            "11:9: targets[0].waypoints[1]: the leg to it is 10771.179 NM long; allowed: 1 m to "
            "5000 NM");
}

TEST(Scenario, CountsAreBounded) {
  std::string ships = "name: s\nown_ships:\n";
  for (int i = 0; i <= kMaxOwnShips; ++i) {
    ships += "  - {name: s" + std::to_string(i) + ", position: {lat: 0, lon: 0}, radars: [{}]}\n";
  }
  EXPECT_EQ(refusal(ships), "3:3: own_ships: 65 entries; allowed: at most 64");
  std::string radars = kOwnShip.substr(0, kOwnShip.find("    radars"));
  radars += "    radars: [";
  for (int i = 0; i <= kMaxRadars; ++i) radars += "{},";
  EXPECT_EQ(refusal(radars + "]\n"), "3:3: own_ships: 65 radars; allowed: at most 64");
  std::string targets = kOwnShip + "targets:\n";
  for (int i = 0; i <= kMaxTargets; ++i) {
    targets += "  - {name: t, position: {lat: 0, lon: 0}}\n";
  }
  EXPECT_EQ(refusal(targets), "7:3: targets: 1001 ships; allowed: at most 1000");
  std::string places = kOwnShip + "coast:\n  places:\n";
  for (int i = 0; i <= kMaxCoastPlaces; ++i) places += "    - {position: {lat: 0, lon: 0}}\n";
  EXPECT_EQ(refusal(places), "8:5: coast.places: 1001 entries; allowed: at most 1000");
  EXPECT_EQ(refusal(kTarget + "    course_deg: 360\n    name: " + std::string(65, 'x') + "\n"),
            "10:5: targets[0].name: given twice; first in line 7");
  EXPECT_EQ(refusal(kTarget.substr(7) + "name: " + std::string(65, 'x') + "\n"),
            "9:7: name: \"" + std::string(60, 'x') +
                "...\" has 65 characters; allowed: at most 64 characters");
}

// Errors of all kinds, of the schema and of the checks beyond it, in one list.
TEST(Scenario, SaysAllThatIsWrongAtOnce) {
  const std::string path = testing::TempDir() + "ten_errors.yaml";
  std::ofstream(path) << scenes::kTenErrors;
  std::vector<std::string> lines;
  try {
    load_scenario(path);
  } catch (const ConfigError& error) {
    std::istringstream all(error.what());
    for (std::string line; std::getline(all, line);) lines.push_back(line);
  }
  std::filesystem::remove(path);
  ASSERT_EQ(lines.size(), scenes::kTenErrorsFound.size() + 1);
  for (std::size_t i = 0; i < scenes::kTenErrorsFound.size(); ++i) {
    const std::string expected = path + scenes::kTenErrorsFound[i];
    EXPECT_EQ(lines[i].substr(0, expected.size()), expected);
  }
  EXPECT_EQ(lines.back(), path + ": " + std::to_string(scenes::kTenErrorsFound.size()) + " errors");
}

// A check is left out where a value that it reads was refused already, and only there.
TEST(Scenario, OneMistakeIsReportedOnce) {
  EXPECT_EQ(refusal("name: s\nown_ships:\n"
                    "  - {position: {lat: 60, lon: 5}, radars: [{}]}\n"
                    "  - {position: {lat: 60, lon: 5}, radars: [{}]}\n"),
            "3:5: own_ships[0].name: missing; expected text, at most 64 characters\n"
            "test.yaml:4:5: own_ships[1].name: missing; expected text, at most 64 characters\n"
            "test.yaml: 2 errors")
      << "not that two ships of no name have the same";
  EXPECT_EQ(refusal(kOwnShip + "    length_m: long\n    beam_m: 80\n"),
            "6:15: own_ships[0].length_m: expected a number, given long; allowed: 2 to 500 m");
  EXPECT_EQ(
      refusal(kTarget + "    waypoints: [{lat: 99, lon: 5}, {lat: 61, lon: 5}]\n"
                        "    speed_kn: fast\n"),
      "9:23: targets[0].waypoints[0].lat: 99 is out of range; allowed: -90 to 90 deg\n"
      "test.yaml:10:15: targets[0].speed_kn: expected a number, given fast; allowed: 0 to 100 "
      "kn\ntest.yaml: 2 errors");
  const std::string set = refusal(
      "name: s\nown_ships:\n  - name: F\n    position: {lat: 60, lon: 5}\n"
      "    radars: [{set: none, antenna_gain_db: 40, gain: 101}]\n");
  EXPECT_NE(set.find("\"none\" is no shipped set"), std::string::npos) << set;
  EXPECT_NE(set.find("gain: 101 is out of range"), std::string::npos) << set;
  EXPECT_NE(set.find("test.yaml: 2 errors"), std::string::npos)
      << "not that the gain does not go with the beams of no set";
}

TEST(Scenario, IsReadFromAFile) {
  const std::string path = testing::TempDir() + "scenario_test.yaml";
  std::ofstream(path) << kTarget;
  EXPECT_EQ(load_scenario(path).targets(0).name(), "Rosund");
  std::filesystem::remove(path);
  EXPECT_THROW(load_scenario(path), ConfigError);
}

}  // namespace
}  // namespace skerry::server
