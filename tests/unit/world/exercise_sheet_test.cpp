// What an exercise's sheet may say.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

const std::string kBegin =
    "name: S\n"
    "own_ships:\n"
    "  - {name: Own, position: {lat: 50, lon: 1}, radars: [{name: X}]}\n"
    "targets:\n"
    "  - {name: Ship, position: {lat: 50, lon: 2}}\n"
    "  - {name: Buoy, kind: buoy, position: {lat: 50, lon: 2}}\n"
    "racons: [{name: Racon, position: {lat: 50, lon: 2}, code: K}]\n"
    "sarts: [{position: {lat: 50, lon: 2}}]\n"
    "events: [{name: bang, at_min: 1}]\n";

TEST(ExerciseSheet, MayNameAllThatIsThere) {
  EXPECT_EQ(
      refusal(kBegin +
              "exercise:\n"
              "  goal: Look.\n"
              "  answers: [one, two]\n"
              "  length_min: 5\n"
              "  checks:\n"
              "    - {at_min: 1, radar: X, range_nm: 6, sees: [Ship, Buoy, Racon, SART 1]}\n"
              "    - {at_min: 5, event: bang, apart: [{ship: Own, other: Ship, least_nm: 1}]}\n"
              "    - {at_min: 2, land: false, gyro_error_least_deg: 0}\n"),
      "");
}

TEST(ExerciseSheet, AllItsMistakesAreSaidAtOnce) {
  EXPECT_EQ(
      refusal(kBegin + "exercise:\n"
                       "  goal: Look.\n"
                       "  length_min: 5\n"
                       "  checks:\n"
                       "    - {at_min: 6, event: bang}\n"
                       "    - {at_min: 1, radar: Y, sees: [Shop], misses: [Ship]}\n"
                       "    - {at_min: 1}\n"
                       "    - {at_min: 1, event: bung, range_nm: 7}\n"
                       "    - {at_min: 1, apart: [{ship: Own, other: Buoy}]}\n"),
      "14:16: exercise.checks[0].at_min: 6 min is after the end; allowed: up to length_min, 5\n"
      "test.yaml:15:26: exercise.checks[1].radar: there is no radar \"Y\"; allowed: X\n"
      "test.yaml:15:36: exercise.checks[1].sees[0]: there is no target, racon or SART \"Shop\"; "
      "allowed: Buoy, Racon, SART 1, Ship\n"
      "test.yaml:16:7: exercise.checks[2]: asks nothing; expected sees, misses, apart, event, "
      "land, clutter_least_percent, clutter_most_percent, gyro_error_least_deg or "
      "position_error_least_m\n"
      "test.yaml:17:26: exercise.checks[3].event: there is no event \"bung\"; allowed: bang\n"
      "test.yaml:17:42: exercise.checks[3].range_nm: 7 is not one of these; allowed: 0.125, 0.25, "
      "0.5, 0.75, 1.5, 3, 6, 12, 24, 48, 72, 96 NM\n"
      "test.yaml:18:27: exercise.checks[4].apart[0]: asks nothing; expected least_nm or "
      "most_nm besides\n"
      "test.yaml:18:46: exercise.checks[4].apart[0].other: there is no ship \"Buoy\"; allowed: "
      "Own, Ship\n"
      "test.yaml: 8 errors");
}

TEST(ExerciseSheet, NeedsAGoal) {
  EXPECT_NE(refusal(kBegin + "exercise: {length_min: 5}\n").find("exercise.goal: missing"),
            std::string::npos);
}

}  // namespace
}  // namespace skerry::server
