// A collision course with the running server and its recorder, and the report of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/running_server.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

// On the equator, far from land.  Alfa sails north; Kilo crosses from starboard and hits her, Lima
// passes.
constexpr const char* kScenario = R"(
name: Collision course
seed: 2
exercise:
  goal: Give way
  freeze_on: [collision]
  checks: [{at_min: 3.9, says: Lima is seen, sees: [Lima]}]
own_ships:
  - name: Alfa
    position: {lat: 0, lon: -30}
    course_deg: 0
    speed_kn: 12
    length_m: 120
    beam_m: 20
    radars: [{name: Main, spokes: 256, cells: 256, rpm: 24, range_nm: 3}]
targets:
  - {name: Kilo, position: {lat: 0.02, lon: -29.98}, course_deg: 270, speed_kn: 12, length_m: 90, beam_m: 14}
  - {name: Lima, position: {lat: 0.03, lon: -30.01}, course_deg: 180, speed_kn: 15, length_m: 90, beam_m: 14}
)";

// WGS-84 at the equator, metres a degree.
constexpr double kNorth_m = 110'574.2758, kEast_m = 111'319.4908;
constexpr double kKnot_mps = 1852.0 / 3600.0;

struct Ship {
  double east_m, north_m, course_deg, mps, length_m, beam_m;
  double x(double t) const {
    return east_m + t * mps * std::sin(course_deg * std::numbers::pi / 180);
  }
  double y(double t) const {
    return north_m + t * mps * std::cos(course_deg * std::numbers::pi / 180);
  }
  // Whether a place is within her outline.
  bool has(double px, double py, double t) const {
    const double c = course_deg * std::numbers::pi / 180, dx = px - x(t), dy = py - y(t);
    const double ahead = dx * std::sin(c) + dy * std::cos(c);
    const double right = std::fabs(dx * std::cos(c) - dy * std::sin(c));
    if (std::fabs(ahead) > length_m / 2) return false;
    return right <= beam_m / 2 * std::min(1.0, (length_m / 2 - ahead) / (length_m / 4));
  }
  bool touches(const Ship& other, double t) const {
    const double c = course_deg * std::numbers::pi / 180;
    for (double ahead = -length_m / 2; ahead <= length_m / 2; ahead += 0.25) {
      const double half = beam_m / 2 * std::min(1.0, (length_m / 2 - ahead) / (length_m / 4));
      for (const double right : {-half, -0.5 * half, 0.0, 0.5 * half, half}) {
        if (other.has(x(t) + ahead * std::sin(c) + right * std::cos(c),
                      y(t) + ahead * std::cos(c) - right * std::sin(c), t)) {
          return true;
        }
      }
    }
    return false;
  }
};
const Ship kAlfa{0, 0, 0, 12 * kKnot_mps, 120, 20};
const Ship kKilo{0.02 * kEast_m, 0.02 * kNorth_m, 270, 12 * kKnot_mps, 90, 14};
const Ship kLima{-0.01 * kEast_m, 0.03 * kNorth_m, 180, 15 * kKnot_mps, 90, 14};

double touching_time() {
  for (double t = 0.0; t < 1000.0; t += 0.01) {
    if (std::hypot(kAlfa.x(t) - kKilo.x(t), kAlfa.y(t) - kKilo.y(t)) > 130.0) continue;
    if (kAlfa.touches(kKilo, t) || kKilo.touches(kAlfa, t)) return t;
  }
  return -1.0;
}

// Rows of a CSV file by the names of its columns; cells without commas.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells;
    std::stringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Begins the recording "exercise" and runs it at that pace.
void record_at(client::SpokeClient& client, double rate) {
  wire::Record record;
  record.set_action(wire::Record::START);
  record.set_name("exercise");
  ASSERT_EQ(client.record(record, kAnswerTime)->code(), wire::Reply::OK);
  wire::Set set;
  set.set_instructor(true);
  set.mutable_exercise()->mutable_clock()->set_rate(rate);
  ASSERT_EQ(client.set(set, kAnswerTime)->code(), wire::Reply::OK);
}

// Waits until the mishap has frozen the exercise, and for some seconds of radar after it (a
// recording ends with its last spoke); ends the recording.
wire::Status recorded_until_frozen(client::SpokeClient& client) {
  const wire::Status frozen =
      await_status(client, [](const wire::Status& status) { return status.world().frozen(); });
  await_status(client, [&](const wire::Status& status) {
    return status.scenario_s() > frozen.scenario_s() + 3.0;
  });
  wire::Record record;
  record.set_action(wire::Record::STOP);
  EXPECT_EQ(client.record(record, kAnswerTime)->code(), wire::Reply::OK);
  return frozen;
}

TEST(Debrief, OfARecordedCollisionHasItsTimeAndTheLeastDistance) {
  const TempFolder folder;
  const std::string recordings = folder.path("recordings");
  RunningServer server({"--scenario", folder.write("collision.yaml", kScenario), "--record-folder",
                        recordings, "--record-reserve-mib", "0"});
  client::SpokeClient client = connected(server);
  ASSERT_NO_FATAL_FAILURE(record_at(client, 20.0));
  // A change before its first spoke is none to the recording.
  await_status(client, [](const wire::Status& status) { return status.recorder().spokes() > 0; });
  wire::Set gain;
  gain.set_gain(77.0);
  ASSERT_EQ(client.set(gain, kAnswerTime)->code(), wire::Reply::OK);
  const wire::Status frozen = recorded_until_frozen(client);
  const double touch_s = touching_time();
  ASSERT_GT(touch_s, 0.0);
  EXPECT_NEAR(frozen.world().exercise_s(), touch_s, 0.12) << "at the end of that step";
  EXPECT_EQ(server.stop().code, 0);

  const std::string page = folder.path("report.html"), tables = folder.path("tables");
  const Ending made = run({skerry_program(), "exercise", "report", recordings + "/exercise.mcap",
                           "-o", page, "--csv", tables});
  ASSERT_EQ(made.code, 0) << made.out << made.err;
  // Checks of the sheet are judged too.
  EXPECT_THAT(text_of(tables + "/checks.csv"), HasSubstr("Lima is seen,passed"));
  EXPECT_THAT(made.out, HasSubstr("1 collisions, 0 groundings"));

  const auto mishaps = rows_of(tables + "/mishaps.csv");
  ASSERT_EQ(mishaps.size(), 1u);
  EXPECT_EQ(mishaps[0].at("kind"), "collision");
  EXPECT_EQ(mishaps[0].at("own_ship"), "Alfa");
  EXPECT_EQ(mishaps[0].at("other"), "Kilo");
  const double told_s = std::stod(mishaps[0].at("exercise_s"));
  EXPECT_NEAR(told_s, touch_s, 0.05);
  EXPECT_NEAR(std::stod(mishaps[0].at("speed_kn")), 12.0 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(std::stod(mishaps[0].at("latitude_deg")), kAlfa.y(touch_s) / kNorth_m, 1e-5);

  const auto passings = rows_of(tables + "/passings.csv");
  ASSERT_EQ(passings.size(), 2u);
  for (const auto& passing : passings) {
    const Ship& other = passing.at("other") == "Kilo" ? kKilo : kLima;
    double least_m = 1e9, least_s = 0.0;
    for (double t = 0.0; t <= frozen.world().exercise_s(); t += 0.01) {
      const double apart_m = std::hypot(other.x(t) - kAlfa.x(t), other.y(t) - kAlfa.y(t));
      if (apart_m < least_m) {
        least_m = apart_m;
        least_s = t;
      }
    }
    EXPECT_NEAR(std::stod(passing.at("least_range_m")), least_m, 1.5) << passing.at("other");
    EXPECT_NEAR(std::stod(passing.at("exercise_s")), least_s, 0.5) << passing.at("other");
    std::printf("%s: least %.2f m told, %.2f m by plane sailing; collision at %.3f s, %.3f s\n",
                passing.at("other").c_str(), std::stod(passing.at("least_range_m")), least_m,
                told_s, touch_s);
  }

  const std::string html = text_of(page);
  for (const char* word : {"Collision course", "Give way", "Collisions: 1, groundings: 0.", "Kilo",
                           "gain: ", "<svg", "20 times"}) {
    EXPECT_THAT(html, HasSubstr(word));
  }

  // The same recording without its end, and what is none.
  const std::string whole = text_of(recordings + "/exercise.mcap");
  for (const double share : {0.2, 0.5, 0.9, 0.999}) {
    const std::string cut = folder.write(
        "cut.mcap",
        whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    const Ending ending = run({skerry_program(), "exercise", "report", cut, "-o",
                               folder.path("cut.html"), "--no-checks"});
    EXPECT_TRUE(ending.code == 0 || ending.code == 1) << ending.code << ending.err;
    EXPECT_THAT(ending.err, HasSubstr("cut.mcap")) << share;
  }
}

// North of her lies an island, of the world's shoreline: the server has her run aground, and the
// recording makes that again without looking at a chart.
TEST(Debrief, OfAGroundingAtTheShoreHasItWhereTheShoreIs) {
  const TempFolder folder;
  const std::string recordings = folder.path("recordings");
  RunningServer server({"--scenario", folder.write("shore.yaml", R"(
name: Upon the shore
exercise: {goal: Keep off, freeze_on: [grounding]}
own_ships:
  - name: Alfa
    position: {lat: 60.452, lon: 5.034}
    course_deg: 0
    speed_kn: 10
    length_m: 60
    beam_m: 12
    radars: [{name: Main, spokes: 256, cells: 256, rpm: 60, range_nm: 3}]
)"),
                        "--record-folder", recordings, "--record-reserve-mib", "0"});
  client::SpokeClient client = connected(server);
  ASSERT_NO_FATAL_FAILURE(record_at(client, 10.0));
  const wire::Status frozen = recorded_until_frozen(client);
  EXPECT_EQ(server.stop().code, 0);

  const std::string file = recordings + "/exercise.mcap", tables = folder.path("tables");
  const Ending made = run({skerry_program(), "exercise", "report", file, "--csv", tables});
  ASSERT_EQ(made.code, 0) << made.out << made.err;
  EXPECT_THAT(made.out, HasSubstr("0 collisions, 1 groundings"));
  const auto mishaps = rows_of(tables + "/mishaps.csv");
  ASSERT_EQ(mishaps.size(), 1u);
  EXPECT_EQ(mishaps[0].at("why"), "the shore");
  // The shore lies at 60.457; she may be told some 4 s of the exercise late, and machines are slow.
  const double latitude = std::stod(mishaps[0].at("latitude_deg"));
  EXPECT_GT(latitude, 60.4560);
  EXPECT_LT(latitude, 60.4590);
  std::printf("aground at %.5f N after %s s\n", latitude, mishaps[0].at("exercise_s").c_str());
  const Ending verified = run({skerry_program(), "recording", "verify", file});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("\nidentical\n"));
}

TEST(Debrief, SaysWhatCannotBeDebriefed) {
  const TempFolder folder;
  const auto refused = [&](const std::string& file, const std::string& reason) {
    const Ending ending =
        run({skerry_program(), "exercise", "report", file, "-o", folder.path("report.html")});
    EXPECT_EQ(ending.code, 1) << ending.out;
    EXPECT_THAT(ending.err, HasSubstr(reason));
    EXPECT_THAT(ending.err, HasSubstr(file));
    EXPECT_FALSE(std::filesystem::exists(folder.path("report.html")));
  };
  refused(folder.path("none.mcap"), "No such file");
  refused(folder.write("garbage.mcap", std::string(1000, 'x')), "byte 0");
  refused(folder.write("empty.mcap", ""), "byte 0");
  const Ending nothing = run({skerry_program(), "exercise", "report", folder.path("none.mcap")});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("-o FILE or --csv FOLDER"));
}

}  // namespace
}  // namespace skerry::system_test
