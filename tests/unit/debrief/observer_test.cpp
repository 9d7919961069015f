// Debriefs of recordings: what was ordered and what came of it; recordings that are cut or wrong.
#include "server/debrief/observer.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "server/app/exercise_files.hpp"
#include "server/debrief/csv_files.hpp"
#include "server/debrief/debrief_page.hpp"
#include "server/world/short_way.hpp"
#include "tests/unit/debrief/recorded_inputs.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

// Alfa and Kilo meet head on: they touch after (1852 m - 100 m) / 20 kn.
constexpr const char* kYaml = R"(
name: Head <on>
seed: 3
exercise:
  goal: Keep clear
  briefing: You have the watch.
  checks:
    - {at_min: 1, says: apart, apart: [{ship: Alfa, other: Kilo, least_nm: 0.1}]}
    - {at_min: 20, says: late, apart: [{ship: Alfa, other: Kilo, least_nm: 0.1}]}
own_ships:
  - {name: Alfa, position: {lat: 0, lon: 2}, course_deg: 0, speed_kn: 10, length_m: 100, radars: [{name: Main}]}
targets:
  - {name: Kilo, position: {lat: 0.016748, lon: 2}, course_deg: 180, speed_kn: 10, length_m: 100}
  - {name: Far, position: {lat: 0.9, lon: 2}, course_deg: 0, speed_kn: 10}
events:
  - {name: call, at_min: 0.5, text: Kilo is near}
)";
const double kTouch_s =
    (short_way_between({0.0, 2.0}, {0.016748, 2.0}).north_m - 100.0) / (20.0 * 1852.0 / 3600.0);

class ObserverTest : public testing::Test {
 protected:
  ~ObserverTest() override { fs::remove_all(folder_); }

  Debrief debrief_of(const std::string& bytes, const DebriefOptions& options = {}) {
    const auto reader = recording::RecordingReader::open(write_bytes(folder_, bytes));
    if (!reader) throw std::runtime_error(reader.error().to_string());
    const auto exercise = RecordedExercise::read(*reader);
    if (!exercise) throw std::runtime_error(exercise.error().to_string());
    const ExercisePlan plan = exercise_plan(exercise->scenario_yaml, "scenario.yaml");
    return *make_debrief(*reader, *exercise, plan, options,
                         [](double, const char*) { return true; });
  }
  static std::vector<HappenedLine> lines(const Debrief& debrief, const std::string& kind) {
    std::vector<HappenedLine> found;
    std::copy_if(debrief.happened.begin(), debrief.happened.end(), std::back_inserter(found),
                 [&](const HappenedLine& line) { return line.kind == kind; });
    return found;
  }

  RecordedInputs recorded_{
      .yaml = kYaml, .length_s = 240.0, .inputs = {}, .settings = {}, .known = {}, .audit = {}};
  const fs::path folder_ =
      fs::temp_directory_path() / ("skerry-debrief-" + std::to_string(getpid()));
};

// As a damaged time says it.
TEST_F(ObserverTest, ARecordingOfDaysIsMadeAgainOnlyAsFarAsAsked) {
  recorded_.length_s = 60.0 * 3600.0;
  const std::string bytes = bytes_of(recorded_);
  try {
    debrief_of(bytes);
    ADD_FAILURE() << "it sailed for days";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("60 hours"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--until"), std::string::npos) << error.what();
  }
  EXPECT_NEAR(debrief_of(bytes, {.limits = {}, .until_s = 240.0, .judge = {}}).end.at_s, 240.0,
              0.11);
}

TEST_F(ObserverTest, TellsACollisionAtItsTime) {
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  EXPECT_EQ(debrief.exercise, "Head <on>");
  EXPECT_EQ(debrief.goal, "Keep clear");
  EXPECT_NEAR(debrief.end.at_s, 240.0, 0.11);
  EXPECT_TRUE(debrief.has_one_clock);
  EXPECT_FALSE(debrief.differs);
  ASSERT_EQ(debrief.contacts.size(), 1u);
  EXPECT_NEAR(debrief.contact_moments[0].at_s, kTouch_s, 0.02);
  ASSERT_EQ(lines(debrief, "collision").size(), 1u);
  EXPECT_NEAR(lines(debrief, "collision")[0].when.at_s, kTouch_s, 0.02);
  ASSERT_EQ(debrief.passings.size(), 1u) << "Far came no nearer than 3 NM";
  EXPECT_NEAR(debrief.passings[0].closest_m, 0.0, 0.1);
  EXPECT_NEAR(debrief.passings[0].when.at_s, kTouch_s + 100.0 / (20.0 * 1852.0 / 3600.0), 0.1);
  ASSERT_EQ(debrief.targets.size(), 1u);
  ASSERT_EQ(debrief.own_ships.size(), 1u);
  EXPECT_NEAR(static_cast<double>(debrief.own_ships[0].points.size()), 241.0, 1.0);
}

TEST_F(ObserverTest, TellsReactionsOfEachKind) {
  recorded_.helm(352, 0, 30.0);
  recorded_.engine(405, 0, 4.0);
  wire::Settings settings;
  settings.set_range_nm(6.0);
  settings.set_gain(50.0);
  recorded_.settings = {{0.0, 0, 0, settings}};
  for (int i = 1; i <= 10; ++i) {
    settings.set_gain(50.0 + i);
    recorded_.settings.push_back({60.0 + 0.1 * i, 0, 0, settings});
  }
  settings.set_range_nm(3.0);
  recorded_.settings.push_back({70.0, 0, 0, settings});
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  ASSERT_EQ(lines(debrief, "helm").size(), 1u);
  EXPECT_EQ(lines(debrief, "helm")[0].text, "course 30°");
  EXPECT_NEAR(lines(debrief, "helm")[0].when.at_s, 35.2, 1e-9);
  const auto changes = lines(debrief, "setting");
  ASSERT_EQ(changes.size(), 2u) << "a knob that is turned is one change";
  EXPECT_EQ(changes[0].text, "gain: 50 to 60");
  EXPECT_EQ(changes[0].who, "Main");
  EXPECT_EQ(changes[1].text, "range_nm: 6 to 3");
  const auto call =
      std::find_if(debrief.reactions.begin(), debrief.reactions.end(),
                   [](const Reaction& reaction) { return reaction.stimulus == "event: call"; });
  ASSERT_NE(call, debrief.reactions.end());
  EXPECT_NEAR(call->when.at_s, 30.0, 1.0);
  ASSERT_TRUE(call->helm_s && call->engine_s && call->setting_s);
  EXPECT_NEAR(*call->helm_s, 5.2, 0.11);
  EXPECT_NEAR(*call->engine_s, 10.5, 0.11);
  EXPECT_NEAR(*call->setting_s, 30.1, 0.11);
  EXPECT_TRUE(std::any_of(debrief.reactions.begin(), debrief.reactions.end(), [](const auto& each) {
    return each.stimulus == "CPA with Kilo forecast too small";
  }));
}

TEST_F(ObserverTest, TellsWhatTheSetKnew) {
  for (int second = 0; second <= 300; ++second) {  // beyond its end
    wire::TargetList list;
    wire::Target& target = *list.add_targets();
    target.set_number(1);
    target.set_latitude_deg(0.016748 - second * 5.144 / 110'574.0);
    target.set_longitude_deg(2.0);
    target.set_name("Kilo");
    if (second >= 60) target.set_cpa_nm(0.02);
    if (second >= 60 && second < 100) {
      wire::Alert& alert = *list.add_alerts();
      alert.set_number(3044);
      alert.set_instance(1);
      alert.set_priority(wire::ALERT_ALARM);
      alert.set_title("CPA/TCPA");
      alert.set_text("Target 1: CPA 0.0 NM in 2 min");
      if (second >= 75) alert.set_state(wire::ALERT_ACKNOWLEDGED);
    }
    recorded_.known.push_back({1.0 * second, 0, 3, list});
  }
  recorded_.known.push_back({10.0, 9, 0, {}});  // of a radar that the scenario does not have
  DebriefOptions options;
  options.until_s = 240.0;
  const Debrief debrief = debrief_of(bytes_of(recorded_), options);
  ASSERT_EQ(debrief.known.size(), 2u);
  const KnownView& view = debrief.known[0];
  EXPECT_EQ(view.own_name, "Alfa");
  EXPECT_EQ(view.radar, "Main");
  EXPECT_EQ(view.view, 3u);
  ASSERT_EQ(view.targets.size(), 1u);
  EXPECT_NEAR(view.targets[0].last.at_s, 240.0, 1e-6);
  ASSERT_EQ(view.alerts.size(), 1u);
  ASSERT_TRUE(view.alerts[0].reaction_s());
  EXPECT_NEAR(*view.alerts[0].reaction_s(), 15.0, 1e-6);
  EXPECT_FALSE(debrief.known[1].own_ship);
  const std::string page = debrief_page(debrief, {});
  for (const char* part : {"<h3>Alfa, Main, console view 3</h3>", "<td>Kilo</td>", "0.02 NM",
                           "15 s", "It tracked nothing.", "way known"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  for (const auto& [name, text] : csv_files(debrief)) {
    if (name == "known_targets.csv") {
      EXPECT_NE(text.find("0.000,0.000,Alfa,Main,3,1,Kilo,0,240,told to the end,0.02,,60\r\n"),
                std::string::npos)
          << text;
    } else if (name == "known_alerts.csv") {
      EXPECT_NE(text.find("60.000,60.000,Alfa,Main,3,3044,1,alarm,CPA/TCPA,"
                          "Target 1: CPA 0.0 NM in 2 min,75,15,\r\n"),
                std::string::npos)
          << text;
    }
  }
}

TEST_F(ObserverTest, TellsWhoDidWhatWhereTheRecordingHasIt) {
  EXPECT_TRUE(debrief_of(bytes_of(recorded_)).deeds.empty());
  recording::AuditEntry entry;
  entry.set_n(41);
  entry.set_utc("2026-11-29T12:00:00.000Z");
  entry.set_kind("change");
  entry.set_who("Anna, trainee of Alfa");
  entry.set_from("console 192.0.2.5:4711");
  entry.set_what("radar 0 view 0: gain");
  entry.set_before("50");
  entry.set_after("71");
  entry.set_times(3);
  recorded_.audit = {{12.0, entry}, {200.0, entry}};
  DebriefOptions options;
  options.until_s = 100.0;
  const Debrief debrief = debrief_of(bytes_of(recorded_), options);
  ASSERT_EQ(debrief.deeds.size(), 1u) << "the other came later";
  EXPECT_NEAR(debrief.deeds[0].when.at_s, 12.0, 1e-6);
  const std::string page = debrief_page(debrief, {});
  EXPECT_NE(page.find("<td>Anna, trainee of Alfa</td><td>radar 0 view 0: gain: 50 -&gt; 71 (3 "
                      "changes)</td>"),
            std::string::npos);
  EXPECT_EQ(page.find("192.0.2.5"), std::string::npos) << "no addresses";
  for (const auto& [name, text] : csv_files(debrief)) {
    if (name != "deeds.csv") continue;
    EXPECT_NE(text.find("12.000,12.000,41,2026-11-29T12:00:00.000Z,change,\"Anna, trainee of "
                        "Alfa\",console 192.0.2.5:4711,radar 0 view 0: gain,50,71,3,\r\n"),
              std::string::npos)
        << text;
  }
}

TEST_F(ObserverTest, TellsBothClocksWhereTheyDiffer) {
  wire::ExerciseOrder order;
  order.mutable_clock()->set_rate(10.0);
  recorded_.order(100, order);
  order.mutable_clock()->clear_rate();
  order.mutable_clock()->set_frozen(true);
  recorded_.order(1000, order);
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  EXPECT_FALSE(debrief.has_one_clock);
  ASSERT_EQ(debrief.contacts.size(), 1u);
  EXPECT_NEAR(in_seconds(debrief.contacts[0].when), kTouch_s, 0.02);
  // Ten seconds at one, then ten a second.
  EXPECT_NEAR(debrief.contact_moments[0].at_s, 10.0 + (kTouch_s - 10.0) / 10.0, 0.1);
  EXPECT_NEAR(debrief.end.at_s, 240.0, 0.11);
  EXPECT_NEAR(debrief.end.exercise_s, 10.0 + 10.0 * 90.0, 2.0);
  EXPECT_NEAR(debrief.passings[0].closest_m, 0.0, 0.5);
  EXPECT_EQ(lines(debrief, "clock").size(), 2u);
}

TEST_F(ObserverTest, TellsGroundingsFaultsAndPlaces) {
  wire::ExerciseOrder order;
  order.set_aground(0);
  recorded_.order(200, order);
  order.mutable_fault()->mutable_faults()->set_gyro_lost(true);
  recorded_.order(300, order);
  order.mutable_own_ship()->set_latitude_deg(0.5);
  order.mutable_own_ship()->set_longitude_deg(2.1);
  recorded_.order(400, order);
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  ASSERT_EQ(debrief.contacts.size(), 1u) << "she stopped before Kilo came";
  EXPECT_EQ(debrief.contacts[0].kind, Contact::Kind::grounding);
  EXPECT_EQ(debrief.contacts[0].why, "the shore");
  ASSERT_EQ(lines(debrief, "fault").size(), 1u);
  EXPECT_EQ(lines(debrief, "fault")[0].text, "Alfa: gyro_lost: true");
  ASSERT_EQ(lines(debrief, "order").size(), 1u);
  EXPECT_EQ(lines(debrief, "order")[0].text, "Alfa is put elsewhere");
  const auto& points = debrief.own_ships[0].points;
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const auto& p) { return p.jumped; }), 1);
}

// The world keeps the last thousand; she runs aground and is put elsewhere, again and again.
TEST_F(ObserverTest, TellsContactsAfterTheThousandth) {
  constexpr std::uint64_t kTimes = 1100;
  for (std::uint64_t i = 0; i < kTimes; ++i) {
    wire::ExerciseOrder order;
    order.set_aground(0);
    recorded_.order(10 + 2 * i, order);
    order.mutable_own_ship()->set_latitude_deg(0.5);
    order.mutable_own_ship()->set_longitude_deg(2.1);
    recorded_.order(11 + 2 * i, order);
  }
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  ASSERT_EQ(debrief.contacts.size(), kTimes);
  ASSERT_EQ(debrief.contact_moments.size(), kTimes);
  EXPECT_NEAR(debrief.contact_moments.back().at_s, 1.0 + 0.2 * (kTimes - 1), 0.11);
  EXPECT_TRUE(std::is_sorted(debrief.contacts.begin(), debrief.contacts.end(),
                             [](const Contact& a, const Contact& b) { return a.when < b.when; }));
  EXPECT_NE(debrief_page(debrief, {})
                .find("These are the first 1000 of 1100; all of them are in "
                      "mishaps.csv."),
            std::string::npos);
  for (const auto& [name, text] : csv_files(debrief)) {
    if (name != "mishaps.csv") continue;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<long>(kTimes) + 1);
  }
}

TEST_F(ObserverTest, JudgesChecksWhereTheWorldIsThen) {
  DebriefOptions options;
  std::vector<double> judged_at;
  options.judge = [&](const scenario::ExerciseCheck&, const World& world) {
    judged_at.push_back(in_seconds(world.state().exercise));
    return JudgedCheck{.when = {}, .says = {}, .passed = true, .lines = {}};
  };
  const Debrief debrief = debrief_of(bytes_of(recorded_), options);
  ASSERT_EQ(judged_at.size(), 1u);
  EXPECT_NEAR(judged_at[0], 60.0, 1e-6);
  ASSERT_EQ(debrief.checks.size(), 2u);
  EXPECT_TRUE(debrief.checks[0].passed);
  EXPECT_FALSE(debrief.checks[1].reached);
}

TEST_F(ObserverTest, SaysWhyThereIsNoDebrief) {
  const auto fault = [&](const std::string& bytes, const DebriefOptions& options = {}) {
    try {
      debrief_of(bytes, options);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  RecordedInputs none;
  none.yaml = "";
  EXPECT_NE(fault(bytes_of(none)).find("no inputs of an exercise"), std::string::npos);
  RecordedInputs wrong = recorded_;
  wrong.yaml = "name: 7\nown_ships: []\n";
  EXPECT_NE(fault(bytes_of(wrong)).find("scenario.yaml"), std::string::npos);
  RecordedInputs endless = recorded_;
  endless.length_s = 1e7;
  EXPECT_NE(fault(bytes_of(endless)).find("--until"), std::string::npos);
  DebriefOptions short_one;
  short_one.until_s = 5.0;
  EXPECT_EQ(fault(bytes_of(endless), short_one), "none");
  EXPECT_NE(fault(""), "none");
}

// An order that the world refuses: the rest is told, with a warning.
TEST_F(ObserverTest, SaysWhereTheRecordingIsNotOfThisScenario) {
  recorded_.helm(100, 7, 30.0);
  const Debrief debrief = debrief_of(bytes_of(recorded_));
  ASSERT_TRUE(debrief.differs);
  EXPECT_NE(debrief.differs->find("own ship 7"), std::string::npos);
  EXPECT_NE(debrief_page(debrief, {}).find("not what was sailed"), std::string::npos);
}

// Cut at every sort of place, and with octets changed: an error or a debrief, and the page of it.
TEST_F(ObserverTest, BearsRecordingsThatAreCutOrDamaged) {
  recorded_.helm(20, 0, 90.0);
  recorded_.length_s = 30.0;
  const std::string whole = bytes_of(recorded_);
  std::mt19937 random(8);
  int told = 0, refused = 0;
  DebriefOptions options;
  options.until_s = 40.0;
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    if (i % 3 != 1) bytes.resize(random() % (whole.size() + 1));
    if (i % 3 != 0) {
      for (int k = 0; k < 3 && !bytes.empty(); ++k) {
        bytes[random() % bytes.size()] = static_cast<char>(random());
      }
    }
    try {
      const Debrief debrief = debrief_of(bytes, options);
      EXPECT_GT(debrief_page(debrief, {}).size(), 1000u);
      EXPECT_EQ(csv_files(debrief).size(), 11u);
      ++told;
    } catch (const std::exception& error) {
      EXPECT_GT(std::string(error.what()).size(), 10u);
      ++refused;
    }
  }
  std::printf("of 300 damaged recordings %d were told, %d refused\n", told, refused);
  EXPECT_GT(refused, 50);
  EXPECT_GT(told, 10);
}

}  // namespace
}  // namespace skerry::server
