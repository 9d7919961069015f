// What instructors are told of a recording that is played.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "protocol/wire/frame.hpp"
#include "server/playback/playback_host.hpp"
#include "server/relayed/relayed_exercise.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using recording::Kind;
using testing::HasSubstr;

// Until the playback's thread has brought it about; only what hangs is so late.
void expect_comes(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  while (!condition() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(condition());
}

constexpr PlayerOptions kStanding{.playing = false};

class PlayedExercise {
 public:
  explicit PlayedExercise(const RecordedScene& scene, double whole = 1.0)
      : file_(scene), host((cut(whole), file_.open()), kStanding, "test") {
    host.start();
  }
  explicit PlayedExercise(const std::function<void(recording::RecordingWriter&)>& write)
      : file_(write), host(file_.open(), kStanding, "test") {
    host.start();
  }
  wire::Reply seek(double seconds, const std::string& who = "console a") {
    wire::Playback request;
    request.set_position_s(seconds);
    return host.playback()->control(request, who);
  }
  wire::PlaybackState state() { return host.playback()->state(); }
  double latitude(int ship) const {
    const auto told = host.exercise_state();
    return told && told->ships_size() > ship ? told->ships(ship).latitude_deg() : 0.0;
  }
  // The target is where the recording had her at that second, or so long after it.
  void expect_at(double seconds) {
    const double wanted = 60.0 + seconds / 3600.0;
    expect_comes([&] { return std::fabs(latitude(1) - wanted) < 1e-9; });
    EXPECT_NEAR(host.exercise_state()->exercise_s(), 2.0 * seconds, 1e-6);
  }

 private:
  void cut(double whole) const {
    if (whole < 1.0) file_.cut(static_cast<std::size_t>(whole * static_cast<double>(file_.size())));
  }
  const RecordedFile file_;

 public:
  PlaybackHost host;
};

TEST(PlayedExercise, IsThatOfThePlayedInstantWhereverItIsSought) {
  PlayedExercise played({.turns = 20, .exercise = true});
  EXPECT_TRUE(played.state().truth());
  for (const double seconds : {30.0, 11.0, 11.5, 0.0, 37.25, 11.5}) {
    ASSERT_EQ(played.seek(seconds).code(), wire::Reply::OK);
    played.expect_at(seconds);
  }
  // Of a ship that lies still nothing moves between two states.
  EXPECT_NEAR(played.latitude(0), 60.011, 1e-12);
}

TEST(PlayedExercise, GoesOnAsItIsPlayed) {
  PlayedExercise played({.turns = 20, .exercise = true});
  played.seek(5.0);
  played.expect_at(5.0);
  wire::Playback request;
  request.set_playing(true);
  request.set_rate(100.0);
  played.host.playback()->control(request, "test");
  expect_comes([&] { return played.latitude(0) > 60.0305; });
  expect_comes([&] { return !played.state().playing(); });
  EXPECT_GE(played.latitude(1), 60.0 + 39.0 / 3600.0);
}

TEST(PlayedExercise, OffersNothingThatCouldBeOrdered) {
  PlayedExercise played({.turns = 2, .radars = {3, 5}, .exercise = true});
  const wire::ExerciseState state = *played.host.exercise_state();
  EXPECT_EQ(state.can_undo(), "");
  EXPECT_EQ(state.snapshots_size(), 0);
  EXPECT_EQ(state.last_order(), "put");
  ASSERT_EQ(state.ships(0).radars_size(), 1) << "those that the playback has";
  EXPECT_EQ(state.ships(0).radars(0), 1u) << "by its numbers";
  wire::Set set;
  set.set_instructor(true);
  set.mutable_exercise()->set_mark("now");
  const wire::Reply reply = played.host.apply(set, "test");
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_THAT(reply.text(), HasSubstr("a recording is played"));
}

TEST(PlayedExercise, MishapsAreForInstructorsAlone) {
  PlayedExercise played({.turns = 4,
                         .exercise = true,
                         .marks = {{1500ms, "Tern ran aground"}, {6s, "Tern and Plain"}},
                         .mark_kind = "grounding"});
  EXPECT_EQ(played.state().marks_size(), 0);
  const wire::ExerciseState state = *played.host.exercise_state();
  ASSERT_EQ(state.played_marks_size(), 2) << "those to come too";
  EXPECT_EQ(state.played_marks(0).position_s(), 1.5);
  EXPECT_EQ(state.played_marks(0).text(), "Tern ran aground");
  EXPECT_EQ(state.played_marks(1).kind(), "grounding");
}

TEST(PlayedExercise, OfTrafficAloneHasItsShipsAndMarks) {
  PlayedExercise played({.turns = 10, .marks = {{4s, "departure"}, {9s, "arrival"}}});
  EXPECT_TRUE(played.state().truth());
  EXPECT_EQ(played.state().marks_size(), 2);
  played.seek(5.0);
  expect_comes([&] {
    const auto told = played.host.exercise_state();
    return std::fabs(told->ships(0).longitude_deg() - 5.05) < 1e-9;
  });
  const wire::ExerciseState state = *played.host.exercise_state();
  EXPECT_EQ(state.exercise_s(), 5.0);
  EXPECT_TRUE(state.ships(0).own());
  EXPECT_EQ(state.ships(0).name(), "target");
  ASSERT_EQ(state.marks_size(), 1) << "so far";
  EXPECT_EQ(state.marks(0).text(), "departure");
  EXPECT_EQ(state.marks(0).kind(), "mark");
  EXPECT_EQ(state.played_marks_size(), 2);
}

TEST(PlayedExercise, WithoutTruthSaysSo) {
  PlayedExercise played({.turns = 2, .traffic = false});
  EXPECT_FALSE(played.host.holds_truth());
  EXPECT_FALSE(played.state().truth());
  EXPECT_FALSE(played.host.exercise_state());
  bool none = false;
  played.host.find_coastline({}, [&](const auto& coastline) { none = !coastline; });
  EXPECT_TRUE(none);
  EXPECT_FALSE(played.host.has_chart());
  none = false;
  played.host.find_chart_objects({}, [&](const auto& objects) { none = !objects; });
  EXPECT_TRUE(none);
}

TEST(PlayedExercise, OfACutFileIsToldAsFarAsItGoes) {
  PlayedExercise played({.turns = 20, .exercise = true}, 0.6);
  const double length = played.state().length_s();
  ASSERT_GT(length, 12.0);
  ASSERT_LT(length, 39.0);
  EXPECT_NE(played.state().problem(), "");
  played.seek(10.5);
  played.expect_at(10.5);
  const wire::Reply beyond = played.seek(39.0);
  EXPECT_EQ(beyond.code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(played.state().position_s(), 10.5);
  EXPECT_EQ(played.seek(length).code(), wire::Reply::OK);
  expect_comes([&] { return played.latitude(1) > 60.0 + (length - 1.0) / 3600.0; });
}

TEST(PlayedExercise, HostileStatesHarmNothing) {
  const RecordedScene scene{.turns = 1};
  PlayedExercise played([&](recording::RecordingWriter& writer) {
    writer.add(recorded_spoke(scene, 0, 0, 0));
    const std::string garbage(100, '\xff');
    writer.add({{Kind::exercise},
                kRecordedAt,
                {reinterpret_cast<const std::uint8_t*>(garbage.data()), garbage.size()}});
    wire::ExerciseState state;
    state.set_rate(1e9);
    state.set_exercise_s(-1.0);
    wire::ExerciseShip& ship = *state.add_ships();
    ship.set_latitude_deg(std::numeric_limits<double>::quiet_NaN());
    ship.set_longitude_deg(1e300);
    ship.set_speed_kn(std::numeric_limits<double>::infinity());
    ship.mutable_faults()->set_gyro_bias_deg(1e9);
    add(writer, {Kind::exercise}, kRecordedAt + 1ms, state);
    writer.add(recorded_spoke(scene, 0, 0, 255));
  });
  EXPECT_FALSE(played.host.exercise_state() && played.host.exercise_state()->ships_size() > 1);
  played.seek(1.9);
  expect_comes([&] {
    const auto told = played.host.exercise_state();
    return told && told->ships_size() == 1;
  });
  const wire::ExerciseState state = *played.host.exercise_state();
  EXPECT_LE(state.rate(), 20.0);
  EXPECT_TRUE(std::isfinite(state.ships(0).latitude_deg()));
  EXPECT_LE(state.ships(0).longitude_deg(), 180.0);
  EXPECT_LE(state.ships(0).faults().gyro_bias_deg(), 180.0);
}

TEST(PlayedExercise, OfTwoWhoSeekTheLastWinsAndIsNamed) {
  PlayedExercise played({.turns = 20, .exercise = true});
  const std::uint64_t version = played.host.playback()->version();
  EXPECT_EQ(played.state().orders(), 0u);
  played.seek(30.0, "console a");
  played.seek(7.0, "console b");
  EXPECT_GT(played.host.playback()->version(), version) << "so that both are told";
  EXPECT_EQ(played.state().position_s(), 7.0);
  EXPECT_EQ(played.state().last_by(), "console b");
  EXPECT_EQ(played.state().orders(), 2u);
  played.seek(1000.0, "console a");  // refused
  EXPECT_EQ(played.state().orders(), 2u);
  played.expect_at(7.0);
}

TEST(RelayedExercise, IsShortEnoughForAFrame) {
  wire::ExerciseState state;
  for (int i = 0; i < 1000; ++i) {
    wire::ExerciseShip& ship = *state.add_ships();
    ship.set_name("ship " + std::to_string(i));
    for (int w = 0; w < 100; ++w) ship.add_route()->set_lat(1.0);
  }
  make_tellable(state, {});
  EXPECT_EQ(state.ships_size(), 1000);
  EXPECT_EQ(state.ships(0).route_size(), 0);
  for (wire::ExerciseShip& ship : *state.mutable_ships()) ship.set_name(std::string(2000, 'x'));
  make_tellable(state, {});
  EXPECT_LT(state.ships_size(), 1000);
  EXPECT_GT(state.ships_size(), 400);
  EXPECT_LT(state.ByteSizeLong(), kMaxServerFrame);
}

TEST(RelayedExercise, OfAFrozenClockStandsStill) {
  wire::ExerciseState state = recorded_exercise({}, 10);
  const wire::ExerciseState before = state;
  state.set_frozen(true);
  sail_on(state, 2.0);
  EXPECT_EQ(state.exercise_s(), before.exercise_s());
  EXPECT_EQ(state.ships(1).latitude_deg(), before.ships(1).latitude_deg());
  state.set_frozen(false);
  sail_on(state, 2.0);
  EXPECT_EQ(state.exercise_s(), before.exercise_s() + 4.0);
  EXPECT_NEAR(state.ships(1).latitude_deg(), before.ships(1).latitude_deg() + 2.0 / 3600.0, 1e-12);
}

}  // namespace
}  // namespace skerry::server
