// The built `skerry track`: recordings and captures in, tables and lines on a map out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "tests/system/child_process.hpp"
#include "tests/system/running_server.hpp"
#include "tests/unit/playback/recorded_file.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::system_test {
namespace {

namespace fs = std::filesystem;
using server::MadeRadar;
using server::RecordedFile;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t kTurns = 24;  // of 2.5 s
constexpr double kDegree_m = 111'319.5;

// Two ships off an own ship that lies still at 50 N 3 E: one goes away to the east at 6 m/s, the
// other lies still in the south.
double eastbound_m(std::uint32_t turn) { return 2000.0 + 15.0 * turn; }
constexpr double kStill_m = 1500.0;

RecordedFile made_recording() {
  return RecordedFile([](recording::RecordingWriter& writer) {
    MadeRadar radar;
    radar.geometry = {720, 512, 8};
    for (std::uint32_t turn = 0; turn < kTurns; ++turn) {
      radar.echoes = {
          {.bearing_deg = 90.0, .range_m = eastbound_m(turn), .length_m = 60.0, .width_m = 20.0},
          {.bearing_deg = 180.0, .range_m = kStill_m, .length_m = 60.0, .width_m = 20.0}};
      for (std::uint32_t k = 0; k < radar.geometry.spokes_per_turn; ++k) {
        Spoke spoke = radar.spoke(std::uint64_t{turn} * radar.geometry.spokes_per_turn + k);
        spoke.header.utc = server::kRecordedAt + spoke.header.scenario_time.time_since_epoch();
        writer.add(spoke);
      }
    }
  });
}

using Row = std::map<std::string, std::string>;

// Every row has a cell for each name.
std::vector<Row> rows_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<Row> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

double number(const Row& row, const char* name) { return std::stod(row.at(name)); }

Ending track(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {skerry_program(), "track"});
  return run(std::move(arguments));
}

TEST(Track, FindsTheShipsOfARecording) {
  const TempFolder folder;
  const RecordedFile recording = made_recording();
  const std::string tracks = folder.path("tracks.csv"), plots = folder.path("plots.csv");
  const Ending made = track({recording.path(), "-o", tracks, "--plots", plots, "--acquire", "2"});
  ASSERT_EQ(made.code, 0) << made.err;
  // And no progress but on a terminal.
  EXPECT_THAT(made.err, AllOf(HasSubstr("no change of heading is told"),
                              HasSubstr("no way of own ship is told"), Not(HasSubstr("%"))));
  EXPECT_THAT(made.out, HasSubstr("radar 0 view 0: 17280 spokes, 24 turns, "));

  const auto rows = rows_of(text_of_file(tracks));
  ASSERT_FALSE(rows.empty());
  double time_s = 0.0;
  std::map<std::string, double> times_s;
  std::map<std::string, Row> last;
  for (const Row& row : rows) {
    if (row.at("status") == "tracked") {
      EXPECT_GE(number(row, "utc_s"), time_s) << "turn after turn";
      time_s = number(row, "utc_s");
      double& before_s = times_s[row.at("track")];
      EXPECT_GT(time_s, before_s) << "track " << row.at("track");
      before_s = time_s;
    }
    EXPECT_GE(number(row, "utc_s"), 1'795'341'600.0);
    EXPECT_LE(number(row, "utc_s"), 1'795'341'600.0 + 2.5 * kTurns);
    EXPECT_EQ(number(row, "own_lat_deg"), 50.0);
    EXPECT_LE(number(row, "hits"), number(row, "looks"));
    last[row.at("track")] = row;
  }
  // Both ships are tracked at the end, where they are.
  bool east = false, south = false;
  for (const auto& [name, row] : last) {
    if (row.at("status") != "tracked") continue;
    const double north_m = (number(row, "lat_deg") - 50.0) * kDegree_m;
    const double east_m = (number(row, "lon_deg") - 3.0) * kDegree_m * std::cos(50.0 / 57.29578);
    if (std::hypot(east_m - eastbound_m(kTurns - 1), north_m) < 60.0) east = true;
    if (std::hypot(east_m, north_m + kStill_m) < 60.0) south = true;
    std::printf("track %s: %.0f m north, %.0f m east, %s kn\n", name.c_str(), north_m, east_m,
                row.at("speed_kn").c_str());
  }
  EXPECT_TRUE(east);
  EXPECT_TRUE(south);

  const auto found = rows_of(text_of_file(plots));
  EXPECT_GE(found.size(), 2u * (kTurns - 1));
  for (const Row& row : found) EXPECT_GT(number(row, "cells"), 0.0);
}

TEST(Track, OfTheSameFileIsTheSameByteByByte) {
  const TempFolder folder;
  const RecordedFile recording = made_recording();
  for (const char* ending : {".csv", ".geojson"}) {
    std::vector<std::string> texts;
    for (const char* name : {"first", "second"}) {
      const std::string file = folder.path(std::string(name) + ending);
      const Ending made = track({recording.path(), "-o", file, "--plots", file + "_plots.csv"});
      ASSERT_EQ(made.code, 0) << made.err;
      texts.push_back(text_of_file(file) + text_of_file(file + "_plots.csv"));
    }
    EXPECT_GT(texts[0].size(), 1000u);
    EXPECT_EQ(texts[0], texts[1]) << ending;
  }
}

TEST(Track, FollowsItsSettingsAndItsPart) {
  const TempFolder folder;
  const RecordedFile recording = made_recording();
  const std::string plots = folder.path("plots.csv");
  ASSERT_EQ(track({recording.path(), "--plots", plots, "--from", "0:10", "--until", "20"}).code, 0);
  for (const Row& row : rows_of(text_of_file(plots))) {
    EXPECT_GE(number(row, "utc_s"), 1'795'341'610.0);
    EXPECT_LT(number(row, "utc_s"), 1'795'341'620.0);
  }
  const std::string tracks = folder.path("tracks.csv");
  ASSERT_EQ(track({recording.path(), "-o", tracks, "--most-tracks", "1", "--acquire", "2"}).code,
            0);
  std::map<std::string, int> at_once;
  for (const Row& row : rows_of(text_of_file(tracks))) {
    if (row.at("status") == "tracked") {
      EXPECT_EQ(++at_once[row.at("utc_s")], 1);
    }
  }
  EXPECT_FALSE(at_once.empty());
}

TEST(Track, ReadsWhatIsLeftOfADamagedRecording) {
  const TempFolder folder;
  const RecordedFile recording = made_recording();
  recording.cut(recording.size() / 2);
  const Ending made = track({recording.path(), "-o", folder.path("tracks.csv")});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, AllOf(HasSubstr(recording.path()), HasSubstr("byte "),
                              HasSubstr("what can be read is used")));
}

TEST(Track, OfACaptureHasTimesThatGrow) {
  const std::string capture = SKERRY_SOURCE_DIR "/../shared/data/radar/halo20-ranges.pcap.gz";
  if (!fs::exists(capture)) GTEST_SKIP() << "no captures of real radars beside the repository";
  const TempFolder folder;
  const std::string plots = folder.path("plots.csv");
  const Ending made = track({capture, "-o", folder.path("tracks.geojson"), "--plots", plots});
  ASSERT_EQ(made.code, 0) << made.err;
  const auto rows = rows_of(text_of_file(plots));
  EXPECT_GT(rows.size(), 100u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    // In the order in which the beam has passed them, to an echo's width.
    ASSERT_GT(number(rows[i], "utc_s"), number(rows[i - 1], "utc_s") - 1.0);
  }
  // The same cut short, with all that is before the cut.
  const std::string whole = text_of_file(capture);
  const std::string cut = folder.write("cut.pcap.gz", whole.substr(0, whole.size() / 2));
  const Ending some = track({cut, "--plots", plots});
  ASSERT_EQ(some.code, 0) << some.err;
  EXPECT_THAT(some.err, AllOf(HasSubstr(cut), HasSubstr("what is before it is used")));
  const std::size_t fewer = rows_of(text_of_file(plots)).size();
  EXPECT_GT(fewer, 10u);
  EXPECT_LT(fewer, rows.size());
}

TEST(Track, ARecordingOfTargetsBecomesATableAgain) {
  const TempFolder folder;
  const RecordedFile recording = made_recording();
  const std::string tracks = folder.path("tracks.mcap"), known = folder.path("known.csv");
  ASSERT_EQ(track({recording.path(), "-o", tracks, "--acquire", "2"}).code, 0);
  const Ending made = track({"recorded", tracks, "-o", known});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr(" lists, 2 targets"));
  // The same places as in the table of the run itself.
  const std::string direct = folder.path("tracks.csv");
  ASSERT_EQ(track({recording.path(), "-o", direct, "--acquire", "2"}).code, 0);
  const auto rows = rows_of(text_of_file(known)), wanted = rows_of(text_of_file(direct));
  ASSERT_EQ(rows.size(), wanted.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const char* name : {"utc_s", "track", "status", "lat_deg", "lon_deg", "hits"}) {
      EXPECT_EQ(rows[i].at(name), wanted[i].at(name)) << name;
    }
  }
}

TEST(Track, TellsTheTruthOfAnExercise) {
  const TempFolder folder;
  const RecordedFile recording({.turns = 5, .exercise = true});  // 10 s
  const std::string truth = folder.path("truth.csv");
  const Ending made = track({"truth", recording.path(), "-o", truth});
  ASSERT_EQ(made.code, 0) << made.err;
  int owns = 0;
  for (const Row& row : rows_of(text_of_file(truth))) owns += row.at("id") == "own" ? 1 : 0;
  EXPECT_EQ(owns, 10);
}

TEST(Track, SaysWhatCannotBeTracked) {
  const TempFolder folder;
  const RecordedFile recording({.turns = 1});
  const auto refused = [&](int code, std::vector<std::string> arguments, const std::string& why) {
    const Ending ending = track(std::move(arguments));
    EXPECT_EQ(ending.code, code) << why << ending.out;
    EXPECT_THAT(ending.err, HasSubstr(why));
    for (const auto& each : fs::directory_iterator(folder.path(""))) {
      EXPECT_TRUE(each.path().filename().string().starts_with("in.")) << each.path() << why;
    }
  };
  const std::string out = folder.path("tracks.csv"), in = recording.path();
  refused(1, {folder.path("none.mcap"), "-o", out}, "none.mcap: No such file");
  refused(1, {folder.write("in.mcap", ""), "-o", out}, "in.mcap: byte 0");
  refused(1, {folder.write("in.pcap", "short"), "-o", out}, "Expected a recording");
  refused(1, {in, "-o", out, "--radar", "7"}, "there are those of radar 0 view 0");
  refused(1, {in, "-o", out, "--until", "nothing"}, "--until: ");
  refused(1, {in, "-o", folder.path("no/tracks.csv")}, "no/tracks.csv: No such file");
  refused(1, {"truth", in, "-o", out}, "it holds no state of an exercise");
  refused(2, {in, "-o", folder.path("tracks.json")}, "expected .csv, .geojson or .mcap");
  refused(1, {"recorded", in, "-o", out}, "it holds no lists of targets");
  refused(2, {"recorded", in, "-o", folder.path("tracks.mcap")}, "expected .csv or .geojson");
  refused(2, {in, "--plots", folder.path("plots.geojson")}, "expected .csv");
  refused(2, {"truth", in, "-o", folder.path("truth.geojson")}, "expected .csv");
  refused(2, {in, "-o", out, "--plots", out}, "the same file");
  refused(2, {in}, "expected -o FILE or --plots FILE");
  refused(2, {"-o", out}, "FILE is missing");
  refused(2, {in, "-o", out, "--beam", "11"}, "--beam: 11 is not in 0.1 to 10");
  refused(2, {in, "-o", out, "--none-such"}, "--none-such");
  refused(2, {"judge", "--truth", in, "--told", in, "--page", in}, "expected a file that ends");
  const std::string page = folder.write("in.html", "a,b");
  refused(2, {"judge", "--truth", in, "--told", page, "--page", page}, "would be written over");
  EXPECT_EQ(text_of_file(page), "a,b");
  refused(2, {"-o", out, "truth", in, "-o", out}, "is not an option of truth");
}

TEST(Track, HasHelpAndTakesFilesNamedLikeItsSubcommands) {
  const Ending help = track({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("skerry track [OPTIONS] [FILE] [SUBCOMMAND]"),
                              HasSubstr("  truth "), HasSubstr("--least-cells"),
                              HasSubstr("  skerry track watch.mcap -o tracks.csv")));
  const Ending truth = track({"truth", "--help"});
  EXPECT_EQ(truth.code, 0);
  EXPECT_THAT(truth.out, AllOf(HasSubstr("skerry track truth [OPTIONS]"),
                               HasSubstr("For referees and tests")));
  EXPECT_EQ(track({}).code, 2);
  EXPECT_EQ(track({"truth"}).code, 2);

  const TempFolder folder;
  const RecordedFile recording({.turns = 1});
  fs::copy_file(recording.path(), folder.path("truth"));
  const Ending named = track({folder.path("") + "./truth", "--plots", folder.path("plots.csv")});
  EXPECT_EQ(named.code, 0) << named.err;
}

}  // namespace
}  // namespace skerry::system_test
