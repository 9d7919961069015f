#include "server/track_tool/truth_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

struct Table {
  std::string text;
  TruthTable::Sink sink() {
    return [this](std::string_view more) { text += more; };
  }
};

wire::ExerciseShip& add_ship(wire::ExerciseState& state, const std::string& name, bool own) {
  wire::ExerciseShip& ship = *state.add_ships();
  ship.set_name(name);
  ship.set_own(own);
  ship.set_number(static_cast<std::uint32_t>(state.ships_size() - 1));
  ship.set_latitude_deg(60.5);
  ship.set_longitude_deg(-5.25);
  ship.set_course_over_ground_deg(359.999);
  ship.set_speed_kn(12.345);
  return ship;
}

TEST(TruthTable, HasARowForEachShip) {
  wire::ExerciseState state;
  add_ship(state, "Alfa", true);
  add_ship(state, "Bravo", true).add_radars(1);
  add_ship(state, "Kilo, \"the old\"", false);
  add_ship(state, "Lima", false).set_removed(true);
  Table table;
  TruthTable truth(1, table.sink());
  truth.add(kRecordedAt + std::chrono::milliseconds(40), state);
  EXPECT_EQ(table.text,
            "utc_s,id,lat_deg,lon_deg,course_deg,speed_kn\n"
            "1795341600.040,Alfa,60.5000000,-5.2500000,0.00,12.35\n"
            "1795341600.040,own,60.5000000,-5.2500000,0.00,12.35\n"
            "1795341600.040,\"Kilo, \"\"the old\"\"\",60.5000000,-5.2500000,0.00,12.35\n");
  EXPECT_EQ(truth.states(), 1u);
}

TEST(TruthTable, TellsShipsOfOneNameApart) {
  wire::ExerciseState state;
  add_ship(state, "Alfa", true);
  add_ship(state, "Kilo", false);
  add_ship(state, "Kilo", false);
  add_ship(state, "", false);
  add_ship(state, "own", false);
  Table table;
  TruthTable(std::nullopt, table.sink()).add(kRecordedAt, state);
  for (const char* id : {",own,", ",Kilo #1,", ",Kilo #2,", ",#3,", ",own #4,"}) {
    EXPECT_THAT(table.text, HasSubstr(id));
  }
}

TEST(WriteTruth, TakesAllStatesOfARecording) {
  const RecordedFile recorded({.turns = 3, .exercise = true});  // 6 s
  Table table;
  EXPECT_EQ(write_truth(recorded.open(), 0, table.sink()), 6u);
  EXPECT_THAT(table.text, HasSubstr("\n1795341600.000,own,60.0000000,5.0000000,"));
  EXPECT_THAT(table.text, HasSubstr("\n1795341605.000,own,60.0050000,5.0000000,"));
}

TEST(WriteTruth, RefusesWhatHasNone) {
  const auto error_of = [](const RecordedFile& recorded, std::optional<std::uint32_t> radar) {
    try {
      Table table;
      write_truth(recorded.open(), radar, table.sink());
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const RecordedFile without({.turns = 1});
  EXPECT_THAT(error_of(without, {}), HasSubstr(without.path() + ": it holds no state"));
  const RecordedFile with({.turns = 1, .exercise = true});
  EXPECT_EQ(error_of(with, {}), "no error");
  EXPECT_THAT(error_of(with, 5), HasSubstr("no own ship has radar 5"));
}

TEST(WriteTruth, BringsNumbersFromOutsideIntoRange) {
  wire::ExerciseState state;
  wire::ExerciseShip& ship = add_ship(state, "Alfa", true);
  ship.set_latitude_deg(std::numeric_limits<double>::quiet_NaN());
  ship.set_longitude_deg(1e300);
  ship.set_course_over_ground_deg(-1e300);
  const RecordedFile recorded([&](recording::RecordingWriter& writer) {
    add(writer, {recording::Kind::exercise}, kRecordedAt, state);
  });
  Table table;
  write_truth(recorded.open(), {}, table.sink());
  EXPECT_LT(table.text.size(), 200u) << table.text;
  EXPECT_EQ(table.text.find("nan"), std::string::npos) << table.text;
}

}  // namespace
}  // namespace skerry::server
