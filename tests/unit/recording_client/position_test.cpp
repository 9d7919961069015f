#include "clients/recording/position.hpp"

#include <gtest/gtest.h>

namespace skerry::client {
namespace {

double seconds_of(std::string_view text) {
  const auto position = recording::parse_position(text);
  EXPECT_TRUE(position.ok()) << text;
  return position && !position->is_mark() ? in_seconds(position->since_begin) : -1.0;
}

std::string mark_of(std::string_view text) {
  const auto position = recording::parse_position(text);
  return position ? position->mark : "error: " + position.error();
}

TEST(Position, ReadsSecondsMinutesAndHours) {
  EXPECT_EQ(seconds_of("0"), 0.0);
  EXPECT_EQ(seconds_of("90"), 90.0);
  EXPECT_EQ(seconds_of("90.25"), 90.25);
  EXPECT_EQ(seconds_of(".5"), 0.5);
  EXPECT_EQ(seconds_of("1:30"), 90.0);
  EXPECT_EQ(seconds_of("90:00"), 5400.0);
  EXPECT_EQ(seconds_of("0:01:30.5"), 90.5);
  EXPECT_EQ(seconds_of("25:59:59"), 93599.0);
}

TEST(Position, EverythingElseIsAMark) {
  EXPECT_EQ(mark_of("collision"), "collision");
  EXPECT_EQ(mark_of("mark 2"), "mark 2");
  EXPECT_EQ(mark_of("-5"), "-5");
  EXPECT_EQ(mark_of("1e3"), "1e3");
  EXPECT_EQ(mark_of("mark:1:30"), "1:30");
}

TEST(Position, SaysWhatIsWrong) {
  for (const char* text : {"", "1:", ":30", "1:60", "1:2:3:4", "1.5:30", "1:75:00", "1..2", ".",
                           "mark:", "99999999999", "40000000"}) {
    const auto position = recording::parse_position(text);
    ASSERT_FALSE(position.ok()) << text;
    EXPECT_NE(position.error().find("expected seconds"), std::string::npos);
  }
}

recording::Summary recorded() {
  recording::Summary summary;
  summary.file = "exercise.mcap";
  summary.begin = UtcTime(std::chrono::seconds(1000));
  summary.end = UtcTime(std::chrono::seconds(1100));
  summary.marks = {{summary.begin + std::chrono::seconds(5), "start", ""},
                   {summary.begin + std::chrono::seconds(50), "contact", ""},
                   {summary.begin + std::chrono::seconds(60), "contact", ""}};
  return summary;
}

TEST(Position, IsFoundInARecording) {
  const recording::Summary summary = recorded();
  EXPECT_EQ(*find_position("1:30.5", summary), summary.begin + std::chrono::milliseconds(90'500));
  EXPECT_EQ(*find_position("contact", summary), summary.begin + std::chrono::seconds(50));
  EXPECT_EQ(*find_position("100", summary), summary.end);
}

TEST(Position, BehindTheEndOrOfNoMarkIsToldWithWhatThereIs) {
  EXPECT_EQ(find_position("1:41", recorded()).error(),
            "position 1:41.000 lies behind the end of exercise.mcap, which is at 1:40.000");
  EXPECT_EQ(find_position("collision", recorded()).error(),
            "exercise.mcap has no mark \"collision\"; its marks are \"start\", \"contact\", "
            "\"contact\"");
  recording::Summary none = recorded();
  none.marks.clear();
  EXPECT_EQ(find_position("x\x1b", none).error(),
            "exercise.mcap has no mark \"x?\"; it has no marks");
}

TEST(Position, IsWrittenAsItIsRead) {
  EXPECT_EQ(playing_time_text(std::chrono::milliseconds(90'500)), "1:30.500");
  EXPECT_EQ(playing_time_text(std::chrono::milliseconds(3'723'004)), "1:02:03.004");
  EXPECT_EQ(playing_time_text(Duration{}), "0:00.000");
}

}  // namespace
}  // namespace skerry::client
