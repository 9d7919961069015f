// `skerry exercise` at the running server: each order as an instructor gives it, and what it shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/wire/schema.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class ExerciseCommand : public testing::Test {
 protected:
  // `skerry exercise WORDS...`
  Ending ordered(std::vector<std::string> words) const {
    words.insert(words.begin(), {skerry_program(), "exercise"});
    words.insert(words.end(), {"--port", std::to_string(server_.tcp_port())});
    return run(std::move(words));
  }
  void order(const std::vector<std::string>& words) const {
    const Ending ending = ordered(words);
    EXPECT_EQ(ending.code, 0) << ending.err;
    EXPECT_EQ(ending.out, "OK\n") << ending.err;
  }
  // The first state that meets the condition.
  wire::ExerciseState state(const std::function<bool(const wire::ExerciseState&)>& condition =
                                [](const wire::ExerciseState&) { return true; }) const {
    client::SpokeClient client = connected(server_);
    if (auto watched = client.watch_exercise(4, kAnswerTime); !watched) {
      throw std::runtime_error(watched.error().text);
    }
    return await<wire::ExerciseState>(client, condition);
  }
  wire::ExerciseShip ship(const std::string& name) const {
    const wire::ExerciseState now = state();
    for (const auto& ship : now.ships()) {
      if (ship.name() == name) return ship;
    }
    throw std::runtime_error("there is no " + name);
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("small.yaml", small_scenario())}};
};

TEST_F(ExerciseCommand, TheClockIsStoppedHastenedAndLetRun) {
  order({"freeze"});
  const double at_s = state([](const auto& s) { return s.frozen(); }).exercise_s();
  EXPECT_EQ(state().exercise_s(), at_s);
  order({"pace", "12.5"});
  EXPECT_EQ(state([](const auto& s) { return s.rate() == 12.5; }).exercise_s(), at_s);
  order({"run"});
  state([&](const auto& s) { return s.exercise_s() > at_s + 5.0; });
}

TEST_F(ExerciseCommand, ASnapshotIsRestoredAndAChangeUndone) {
  order({"freeze"});
  order({"snapshot", "before it all"});
  order({"target", "remove", "Tanker"});
  EXPECT_TRUE(ship("Tanker").removed());
  order({"undo"});
  EXPECT_FALSE(ship("Tanker").removed());
  order({"put", "Tern", "--latitude", "-10.5", "--longitude", "-170.25", "--heading", "90",
         "--speed", "-3"});
  EXPECT_NEAR(ship("Tern").latitude_deg(), -10.5, 1e-9);
  EXPECT_NEAR(ship("Tern").longitude_deg(), -170.25, 1e-9);
  EXPECT_NEAR(ship("Tern").heading_deg(), 90.0, 1e-9);
  EXPECT_THAT(ordered({"show"}).out, HasSubstr("SNAPSHOTS  before it all\n"));
  order({"restore", "before it all"});
  EXPECT_NEAR(ship("Tern").latitude_deg(), 60.425, 0.1);
}

TEST_F(ExerciseCommand, TextsReachTheConAndMarksTheLog) {
  client::SpokeClient tern = subscribed(server_, 0), gannet = subscribed(server_, 2);
  order({"text", "Tern", "Reduce to 8 knots"});
  const auto has = [](const std::string& text) {
    return [text](const wire::OwnShip& ship) { return ship.text() == text; };
  };
  await<wire::OwnShip>(tern, has("Reduce to 8 knots"));
  order({"text", "all", "The exercise ends"});
  const auto told = await<wire::OwnShip>(tern, has("The exercise ends"));
  EXPECT_EQ(told.texts(), 2u);
  EXPECT_EQ(await<wire::OwnShip>(gannet, has("The exercise ends")).texts(), 1u);
  order({"mark", "late alteration"});
  const auto marked = state([](const auto& s) { return s.marks_size() == 3; });
  EXPECT_EQ(marked.marks(2).text(), "late alteration");
  EXPECT_EQ(marked.marks(2).kind(), "mark");
}

TEST_F(ExerciseCommand, ATargetIsAddedOrderedRemovedAndPutBack) {
  order({"freeze"});
  order({"target", "add", "--name", "Foe", "--ship-class", "coaster", "--latitude", "60.4",
         "--longitude", "-5.25", "--course", "270", "--speed", "11", "--gives-way", "early"});
  wire::ExerciseShip foe = ship("Foe");
  EXPECT_FALSE(foe.own());
  EXPECT_EQ(foe.ship_class(), "coaster");
  EXPECT_NEAR(foe.longitude_deg(), -5.25, 1e-9);
  EXPECT_EQ(foe.ordered_course_deg(), 270.0);
  EXPECT_NEAR(foe.ordered_speed_kn(), 11.0, 1e-9);
  EXPECT_EQ(foe.gives_way(), wire::GIVE_WAY_EARLY);

  order({"target", "order", std::to_string(foe.number()), "--course", "45", "--speed", "8",
         "--gives-way", "late", "--sart", "on", "--ais-off", "on", "--ais-heading-error", "-15"});
  foe = ship("Foe");
  EXPECT_EQ(foe.gives_way(), wire::GIVE_WAY_LATE);
  EXPECT_TRUE(foe.sart());
  EXPECT_TRUE(foe.ais_off());
  // A course and a speed act, and are told, with the exercise's next step.
  order({"run"});
  state([&](const auto& s) {
    const auto& now = s.ships(s.ships_size() - 1);
    return now.ordered_course_deg() == 45.0 && std::abs(now.ordered_speed_kn() - 8.0) < 1e-9;
  });
  order({"freeze"});

  order({"target", "order", "Foe", "--waypoint", "60.5,-5.25,speed=9.5", "--waypoint",
         "60.6,-5.5,stop-min=20", "--route-end", "back"});
  foe = ship("Foe");
  ASSERT_EQ(foe.route_size(), 2);
  EXPECT_EQ(foe.route(0).lat(), 60.5);
  EXPECT_EQ(foe.route(0).lon(), -5.25);
  EXPECT_EQ(foe.route(0).speed_kn(), 9.5);
  EXPECT_EQ(foe.route(1).stop_min(), 20.0);
  EXPECT_EQ(foe.route_end(), wire::END_BACK);

  order({"target", "remove", "Foe"});
  EXPECT_TRUE(ship("Foe").removed());
  order({"target", "order", "Foe", "--removed", "off"});
  EXPECT_FALSE(ship("Foe").removed());
}

// Each kind of the schema, at the greatest value it may have.
TEST_F(ExerciseCommand, EveryFaultIsSetAndCleared) {
  using wire::FieldDescriptor;
  std::vector<std::string> kinds = {"fault", "Gannet"};
  for (const FieldDescriptor* kind : wire::fields_of(*wire::Faults::descriptor())) {
    kinds.push_back(kind->cpp_type() == FieldDescriptor::CPPTYPE_BOOL
                        ? kind->name()
                        : fmt::format("{}={:g}", kind->name(), wire::rule_of(*kind).max()));
  }
  order(kinds);
  const wire::Faults all = ship("Gannet").faults();
  for (const FieldDescriptor* kind : wire::fields_of(*wire::Faults::descriptor())) {
    EXPECT_EQ(wire::value_of(all, *kind),
              kind->cpp_type() == FieldDescriptor::CPPTYPE_BOOL ? 1.0 : wire::rule_of(*kind).max())
        << kind->name();
  }
  EXPECT_EQ(ship("Tern").faults().ByteSizeLong(), 0u);

  order({"clear", "Gannet", "gyro-bias", "gnss-drift-deg", "blackout"});
  wire::Faults fewer = all;
  fewer.clear_gyro_bias_deg();
  fewer.clear_gnss_drift_deg();
  fewer.clear_blackout();
  EXPECT_EQ(ship("Gannet").faults().ShortDebugString(), fewer.ShortDebugString());
  order({"fault", "1", "gyro-bias=-2.5", "log-lost=off"});
  fewer.set_gyro_bias_deg(-2.5);
  fewer.clear_log_lost();
  EXPECT_EQ(ship("Gannet").faults().ShortDebugString(), fewer.ShortDebugString());
  order({"clear", "Gannet"});
  EXPECT_EQ(ship("Gannet").faults().ShortDebugString(), "");
}

TEST_F(ExerciseCommand, EveryFaultStandsInTheHelp) {
  const Ending help = run({skerry_program(), "exercise", "fault", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const auto* kind : wire::fields_of(*wire::Faults::descriptor())) {
    EXPECT_THAT(help.out, HasSubstr(wire::control_of(*kind).help()));
  }
}

TEST_F(ExerciseCommand, WhatIsWrongIsSaidAsTheServerSaysIt) {
  struct Case {
    std::vector<std::string> words;
    int code;
    std::vector<const char*> said;
  };
  const std::vector<Case> cases = {
      // By the server.
      {{"pace", "50"}, 1, {"rate", "50", "0.1 to 20"}},
      {{"restore", "never"}, 1, {"there is no snapshot \"never\""}},
      {{"undo"}, 1, {"undo"}},
      {{"mark", ""}, 1, {"mark", "1 to 200"}},
      {{"fault", "Tern", "gyro-bias=181"}, 1, {"gyro", "181", "-180 to 180"}},
      {{"put", "Tern", "--latitude", "10"}, 1, {"latitude and longitude"}},
      {{"target", "add", "--ship-class", "raft", "--latitude", "60", "--longitude", "5"},
       1,
       {"raft"}},
      // By the command.
      {{"put", "Albatross", "--heading", "10"}, 1, {"no own ship 'Albatross'", "0 Tern, 1 Gannet"}},
      {{"target", "remove", "Tern"}, 1, {"no target 'Tern'", "0 Tanker"}},
      {{"fault", "Tern", "gyro-bias"}, 2, {"gyro-bias", "-180 to 180"}},
      {{"fault", "Tern", "engine-on-fire"}, 2, {"engine-on-fire", "--help"}},
      {{"fault", "Tern", "gyro-lost=maybe"}, 2, {"gyro-lost", "maybe", "on nor off"}},
      {{"fault", "Tern"}, 2, {"KIND"}},
      {{"target", "order", "Tanker"}, 2, {"nothing is ordered"}},
      {{"target", "order", "Tanker", "--waypoint", "60.1"}, 2, {"LATITUDE,LONGITUDE"}},
      {{"target", "order", "Tanker", "--waypoint", "60.1,5,colour=2"}, 2, {"colour=2"}},
      {{"target", "order", "Tanker", "--course", "north"}, 2, {"north", "not a number"}},
      {{"target", "order", "Tanker", "--gives-way", "maybe"}, 2, {"maybe"}},
      {{"target", "add", "--latitude", "60"}, 2, {"--longitude"}},
      {{"pace"}, 2, {"RATE"}},
      {{"dance"}, 2, {"subcommand", "--help"}},
  };
  const std::string before = state().last_order();
  for (const Case& wrong : cases) {
    const Ending ending = ordered(wrong.words);
    SCOPED_TRACE(testing::PrintToString(wrong.words));
    EXPECT_EQ(ending.code, wrong.code) << ending.err;
    EXPECT_EQ(ending.out, "");
    for (const char* part : wrong.said) EXPECT_THAT(ending.err, HasSubstr(part));
  }
  EXPECT_EQ(state().last_order(), before) << "nothing was ordered";
  EXPECT_EQ(state().orders(), 0u);
}

TEST_F(ExerciseCommand, ShowsTheExerciseInWordsAndAsJson) {
  order({"freeze"});
  order({"fault", "Tern", "gyro-bias=5", "log-lost"});
  order({"mark", "begin"});
  const Ending shown = ordered({"show"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  for (const char* part : {"frozen, pace 1", "ORDERS     3, the last by ", "UNDO  ", "Tern",
                           "Gannet", "Tanker", "Coaster", "Ferry", "60\u00b0", "335.0\u00b0",
                           "Gyro bias 5 deg, Log lost", "mark      begin"}) {
    EXPECT_THAT(shown.out, HasSubstr(part));
  }
  const Ending as_json = ordered({"show", "--json"});
  EXPECT_EQ(as_json.code, 0) << as_json.err;
  wire::ExerciseState read;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(as_json.out, &read).ok());
  EXPECT_EQ(read.SerializeAsString(), state().SerializeAsString()) << "she stands";
}

TEST_F(ExerciseCommand, WatchWritesALineForEachChange) {
  ChildProcess watch({skerry_program(), "exercise", "watch", "--count", "9", "--port",
                      std::to_string(server_.tcp_port())});
  EXPECT_THAT(watch.read_line().value_or(""), HasSubstr("watching "));
  // The lines up to one that has all of it; between two orders a state may not have come.
  const auto await_line = [&](const char* text) {
    for (;;) {
      const auto line = watch.read_line();
      if (!line) throw std::runtime_error(std::string("never written: ") + text);
      if (line->find(text) != std::string::npos) return;
    }
  };
  order({"freeze"});
  await_line("frozen, pace 1");
  order({"mark", "late alteration"});
  await_line("mark      late alteration");
  order({"fault", "Tern", "gyro-bias=5"});
  await_line("Tern: faults: Gyro bias 5 deg");
  order({"target", "order", "Ferry", "--course", "123"});
  await_line("Ferry: ");
  order({"snapshot", "here"});
  EXPECT_EQ(watch.wait().code, 0);
}

// On a leg of a great circle the course to steer changes all the time.
TEST_F(ExerciseCommand, WatchIsSilentWhileShipsOnlyFollowTheirRoutes) {
  order({"target", "order", "Ferry", "--waypoint", "60.5,15.0"});
  // She steers for it from the next step of the exercise on; that is a change.
  state([](const auto& s) {
    return std::any_of(s.ships().begin(), s.ships().end(), [](const auto& ship) {
      return ship.name() == "Ferry" && ship.ordered_course_deg() > 85.0;
    });
  });
  order({"pace", "20"});
  ChildProcess watch({skerry_program(), "exercise", "watch", "--count", "3", "--port",
                      std::to_string(server_.tcp_port())});
  EXPECT_THAT(watch.read_line().value_or(""), HasSubstr("watching "));
  const double begin_s = state().exercise_s();
  state([&](const auto& s) { return s.exercise_s() > begin_s + 60.0; });
  order({"mark", "a minute later"});
  order({"freeze"});
  const Ending ending = watch.wait();
  EXPECT_THAT(ending.out, Not(HasSubstr("ordered course")));
  EXPECT_THAT(ending.out, HasSubstr("a minute later"));
}

}  // namespace
}  // namespace skerry::system_test
