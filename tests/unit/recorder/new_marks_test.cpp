// The marks of an exercise on their way into a recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/recorder/new_marks.hpp"
#include "server/recorder/recorder.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

wire::ExerciseState state_with(const std::vector<std::string>& marks) {
  wire::ExerciseState state;
  for (const std::string& text : marks) {
    wire::ExerciseMark& mark = *state.add_marks();
    mark.set_text(text);
    mark.set_kind("alarm");
  }
  return state;
}

std::vector<std::string> texts(const std::vector<wire::ExerciseMark>& marks) {
  std::vector<std::string> out;
  for (const wire::ExerciseMark& mark : marks) out.push_back(mark.text());
  return out;
}

TEST(NewMarks, AreThoseThatCameSinceTheLastLook) {
  NewMarks marks;
  EXPECT_THAT(texts(marks.take(state_with({"before"}))), IsEmpty())
      << "it came before the recording";
  EXPECT_THAT(texts(marks.take(state_with({"before"}))), IsEmpty());
  EXPECT_THAT(texts(marks.take(state_with({"before", "a", "b"}))), ElementsAre("a", "b"));
  EXPECT_THAT(texts(marks.take(state_with({"before", "a", "b", "b"}))), ElementsAre("b"));
}

TEST(NewMarks, AreKnownWhereOldOnesHaveNoRoomAnyMore) {
  NewMarks marks;
  marks.take(state_with({"a", "b", "c"}));
  EXPECT_THAT(texts(marks.take(state_with({"b", "c", "d"}))), ElementsAre("d"));
  EXPECT_THAT(texts(marks.take(state_with({"x", "y", "z"}))), ElementsAre("x", "y", "z"));
}

TEST(NewMarks, OfARestoredSnapshotAreThoseAfterIt) {
  NewMarks marks;
  marks.take(state_with({}));
  marks.take(state_with({"a", "b", "c"}));
  EXPECT_THAT(texts(marks.take(state_with({"a"}))), IsEmpty());
  EXPECT_THAT(texts(marks.take(state_with({"a", "b"}))), ElementsAre("b")) << "it happened again";
}

TEST(NewMarks, AreEventsOfTheRecordingAndTheExerciseIsInIt) {
  RecordedHost host;
  const ScratchFolder folder;
  wire::ExerciseState state = state_with({"before"});
  state.add_ships()->set_name("Tern");
  state.add_played_marks()->set_text("of another recording");
  host.tell(state);
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = 0;
  config.sync = Sync::none;
  {
    Recorder recorder(host, config);
    recorder.start();
    ASSERT_EQ(recorder.record(record_of(wire::Record::START, "a"), "test").code(), wire::Reply::OK);
    ASSERT_TRUE(reaches(recorder, wire::RecorderState::RECORDING));
    wire::ExerciseMark& mark = *state.add_marks();
    mark.set_text("Tern ran aground");
    mark.set_kind("grounding");
    host.tell(state);
    const int asked = host.asked;
    ASSERT_TRUE(comes_true([&] { return host.asked > asked; }));  // once a second
    recorder.record(record_of(wire::Record::STOP), "test");
    ASSERT_TRUE(reaches(recorder, wire::RecorderState::OFF));
    EXPECT_EQ(recorder.state().marks(), 0u) << "nobody asked the recorder for one";
    recorder.stop();
  }
  const Recorded file = recorded(folder.path("a.mcap"));
  wire::ExerciseState told;
  ASSERT_TRUE(told.ParseFromString(file.of(recording::Kind::exercise).at(0)));
  EXPECT_EQ(told.ships(0).name(), "Tern");
  EXPECT_EQ(told.played_marks_size(), 0);
  const auto events = file.events(recording::Event::MARK);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text(), "Tern ran aground");
  EXPECT_EQ(events[0].mark_kind(), "grounding");
}

}  // namespace
}  // namespace skerry::server
