// The words that control a playback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "clients/cli/recording/play_words.hpp"

namespace skerry::client {
namespace {

using testing::HasSubstr;
using What = PlayWords::What;

wire::Playback asked(const std::string& line) {
  const auto words = parse_play_words(line);
  EXPECT_TRUE(words.ok()) << line;
  EXPECT_EQ(words->what, What::ask) << line;
  return words->request;
}
std::string refusal(const std::string& line) {
  const auto words = parse_play_words(line);
  EXPECT_FALSE(words.ok()) << line;
  return words.ok() ? "" : words.error();
}

TEST(PlayWords, AskForOneThingEach) {
  EXPECT_TRUE(asked("play").playing());
  EXPECT_TRUE(asked(" pause \r\n").has_playing());
  EXPECT_FALSE(asked("pause").playing());
  EXPECT_EQ(asked("seek 1:30").position_s(), 90.0);
  EXPECT_EQ(asked("seek collision course").mark(), "collision course");
  EXPECT_EQ(asked("mark 12").mark(), "12") << "a mark that looks like a time";
  EXPECT_EQ(asked("rate 0.5").rate(), 0.5);
  EXPECT_EQ(asked("rate 20x").rate(), 20.0);
  EXPECT_TRUE(asked("loop on").loop());
  EXPECT_FALSE(asked("loop off").loop());
  EXPECT_EQ(asked("step").step_turns(), 1);
  EXPECT_EQ(asked("step 7").step_turns(), 7);
  EXPECT_EQ(asked("back").step_turns(), -1);
  EXPECT_EQ(asked("back 3").step_turns(), -3);
}

TEST(PlayWords, OrToKnowOrToEnd) {
  EXPECT_EQ(parse_play_words("")->what, What::state);
  EXPECT_EQ(parse_play_words("state")->what, What::state);
  EXPECT_EQ(parse_play_words("marks")->what, What::marks);
  EXPECT_EQ(parse_play_words("?")->what, What::help);
  EXPECT_EQ(parse_play_words("quit")->what, What::quit);
}

TEST(PlayWords, WhatIsNotUnderstoodIsSaidWithWhatWasExpected) {
  EXPECT_THAT(refusal("fly"), HasSubstr("help"));
  EXPECT_THAT(refusal("play backwards"), HasSubstr("nothing behind it"));
  EXPECT_THAT(refusal("seek"), HasSubstr("empty"));
  EXPECT_THAT(refusal("seek 1:75"), HasSubstr("59"));
  EXPECT_THAT(refusal("rate fast"), HasSubstr("a number"));
  EXPECT_THAT(refusal("rate"), HasSubstr("a number"));
  EXPECT_THAT(refusal("loop"), HasSubstr("loop on"));
  EXPECT_THAT(refusal("step 1.5"), HasSubstr("turns"));
  EXPECT_THAT(refusal("step 99999999999999999999"), HasSubstr("turns"));
}

TEST(PlayWords, AStateIsOneLineWhateverAServerSays) {
  wire::PlaybackState state;
  state.set_position_s(90.04);
  state.set_length_s(3723.0);
  state.set_playing(true);
  state.set_rate(2.0);
  state.set_loop(true);
  EXPECT_EQ(playback_line(state), "0:01:30.0 of 1:02:03.0  plays  2x  in a loop");
  state.set_position_s(std::numeric_limits<double>::quiet_NaN());
  state.set_length_s(1e300);
  state.set_problem("\x1b[31m bad\n");
  EXPECT_THAT(playback_line(state), HasSubstr("?[31m bad?"));
}

}  // namespace
}  // namespace skerry::client
