// What consoles here ask for and the other server decides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/core/chart_texts.hpp"
#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

wire::Set gain_of(double gain) {
  wire::Set set;
  set.set_gain(gain);
  return set;
}

// What was answered to one request.
struct Answer {
  std::optional<wire::Reply> now, later;
  int times = 0;
};
void ask(RelayUnderTest& relay, Answer& answer, const wire::Set& set, const std::string& who) {
  answer.now = relay.host.apply_or_ask(set, who, [&answer](const wire::Reply& reply) {
    answer.later = reply;
    ++answer.times;
  });
}

TEST(PassedUp, TheOthersAnswerReachesWhoAsked) {
  RelayUnderTest relay;
  relay.accept_all();
  Answer good, bad;
  ask(relay, good, gain_of(70), "console a");
  ask(relay, bad, gain_of(700), "console b");
  EXPECT_FALSE(good.now);
  const auto said = relay.said(1);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].set().gain(), 70);
  relay.reply(1, said[0].request());
  relay.reply(1, said[1].request(), wire::Reply::OUT_OF_RANGE, "gain: 700 is out of range");
  ASSERT_TRUE(good.later && bad.later);
  EXPECT_EQ(good.later->code(), wire::Reply::OK);
  EXPECT_EQ(bad.later->code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_THAT(bad.later->text(), HasSubstr("700"));
  EXPECT_EQ(relay.host.hops().at(0).requests(), 2u);
  EXPECT_EQ(relay.host.hops().at(0).requests_refused(), 1u);
}

TEST(PassedUp, NoTokenOfAConsoleGoesUp) {
  RelayUnderTest relay(hello_of(1), "the relay's token");
  relay.step();
  relay.talk.connected(1, relay.now);
  relay.say_hello(1);
  const auto first = relay.said(1);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].sign_in().token(), "the relay's token");
  relay.reply(1, first[0].request());
  relay.reply(1, relay.said(1).at(0).request());
  Answer answer;
  wire::Set set = gain_of(70);
  set.set_token("a console's");
  ask(relay, answer, set, "console a");
  EXPECT_TRUE(relay.said(1).at(0).set().token().empty());
}

// It would go up as the relay's own, which may do more than who asked.
TEST(PassedUp, WhatThisVersionDoesNotKnowDoesNotGoUp) {
  RelayUnderTest relay;
  relay.accept_all();
  constexpr int kOfANewerVersion = 900;
  wire::Set set = gain_of(70);
  set.GetReflection()->MutableUnknownFields(&set)->AddVarint(kOfANewerVersion, 1);
  wire::Set within = gain_of(70);
  wire::ExerciseOrder& order = *within.mutable_exercise();
  order.GetReflection()->MutableUnknownFields(&order)->AddVarint(kOfANewerVersion, 1);
  for (const wire::Set& asked : {set, within}) {
    Answer answer;
    ask(relay, answer, asked, "console a");
    ASSERT_TRUE(answer.now);
    EXPECT_EQ(answer.now->code(), wire::Reply::UNKNOWN);
  }
  EXPECT_TRUE(relay.said(1).empty());
}

TEST(PassedUp, WhatNamesNothingHereDoesNotGoUp) {
  RelayUnderTest relay;
  relay.accept_all();
  Answer answer;
  wire::Set set = gain_of(70);
  set.set_view(9);
  ask(relay, answer, set, "console a");
  ASSERT_TRUE(answer.now);
  EXPECT_EQ(answer.now->code(), wire::Reply::UNKNOWN);
  EXPECT_TRUE(relay.said(1).empty());
}

TEST(PassedUp, WithoutTheOtherServerItIsRefusedAtOnce) {
  RelayUnderTest relay;
  Answer answer;
  ask(relay, answer, gain_of(70), "console a");
  ASSERT_TRUE(answer.now);
  EXPECT_EQ(answer.now->code(), wire::Reply::REFUSED);
  EXPECT_THAT(answer.now->text(), HasSubstr("192.0.2.7:7410"));
}

TEST(PassedUp, WhatIsUnansweredWhenItGoesIsAnswered) {
  RelayUnderTest relay;
  relay.accept_all();
  Answer answer;
  ask(relay, answer, gain_of(70), "console a");
  relay.said(1);
  relay.cut(1, "192.0.2.7:7410 closed the connection");
  ASSERT_TRUE(answer.later);
  EXPECT_EQ(answer.later->code(), wire::Reply::REFUSED);
  EXPECT_THAT(answer.later->text(), HasSubstr("whether it was done is not known"));
  EXPECT_EQ(answer.times, 1);
}

TEST(PassedUp, WhatIsNotAnsweredInTimeIsRefused) {
  RelayUnderTest relay;
  relay.accept_all();
  Answer answer;
  ask(relay, answer, gain_of(70), "console a");
  const auto request = relay.said(1).at(0).request();
  relay.pass(std::chrono::milliseconds(4900));
  EXPECT_FALSE(answer.later);
  relay.settings_from(1, 0, 0, 50);  // it is alive
  relay.pass(std::chrono::milliseconds(200));
  ASSERT_TRUE(answer.later);
  EXPECT_THAT(answer.later->text(), HasSubstr("has not answered in time"));
  relay.reply(1, request);  // too late, for nobody
  EXPECT_EQ(answer.times, 1);
}

TEST(PassedUp, TheEndOfTheRelayAnswersAll) {
  RelayUnderTest relay;
  relay.accept_all();
  Answer sent, waiting;
  ask(relay, sent, gain_of(70), "console a");
  relay.said(1);
  ask(relay, waiting, gain_of(71), "console a");
  relay.talk.stop();
  EXPECT_EQ(sent.times, 1);
  EXPECT_EQ(waiting.times, 1);
  Answer after;
  ask(relay, after, gain_of(72), "console a");
  EXPECT_TRUE(after.now);
}

TEST(PassedUp, WhoCannotWaitIsToldWhatCanBeToldHere) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::ServerMessage message;
  message.mutable_settings()->set_range_nm(6);
  message.mutable_settings()->add_locked("sea");
  relay.say(1, message);
  EXPECT_EQ(relay.host.apply(gain_of(700), "display").code(), wire::Reply::OUT_OF_RANGE);
  wire::Set sea;
  sea.set_sea(3);
  EXPECT_EQ(relay.host.apply(sea, "display").code(), wire::Reply::REFUSED);
  EXPECT_TRUE(relay.said(1).empty());
  EXPECT_EQ(relay.host.apply(gain_of(70), "display").code(), wire::Reply::OK);
  const auto said = relay.said(1);
  ASSERT_EQ(said.size(), 1u);
  relay.reply(1, said[0].request(), wire::Reply::REFUSED, "no");
  EXPECT_EQ(relay.host.hops().at(0).requests_refused(), 1u);
}

TEST(PassedUp, OneConsoleHereHasTheCon) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::Set take;
  take.mutable_con()->set_take(true);
  Answer first;
  ask(relay, first, take, "console a");
  relay.reply(1, relay.said(1).at(0).request());
  wire::ServerMessage ship;
  ship.mutable_own_ship()->set_name("Tern");
  ship.mutable_own_ship()->mutable_con()->set_con("console 127.0.0.1:4711");  // the relay there
  relay.say(1, ship);
  EXPECT_EQ(relay.host.own_ship(0).con().con(), "console a");
  Answer second;
  ask(relay, second, take, "console b");
  ASSERT_TRUE(second.now);
  EXPECT_THAT(second.now->text(), HasSubstr("console a has the con of Tern"));
  wire::Set course;
  course.set_course_deg(10);
  ask(relay, second, course, "console b");
  EXPECT_TRUE(second.now);
  relay.host.leave("console a");
  const auto said = relay.said(1);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(said[0].set().con().release());
  ask(relay, second, take, "console b");
  EXPECT_FALSE(second.now);
}

// The other server grants it, when who asked has been told that it has not answered.
TEST(PassedUp, AConThatIsGrantedTooLateIsGivenBack) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::Set take;
  take.mutable_con()->set_take(true);
  for (const bool is_granted : {true, false}) {
    Answer answer;
    ask(relay, answer, take, "console a");
    const auto said = relay.said(1);
    ASSERT_EQ(said.size(), 1u);
    relay.pass(std::chrono::milliseconds(4900));
    relay.settings_from(1, 0, 0, 50);  // it is alive
    relay.pass(std::chrono::milliseconds(200));
    ASSERT_TRUE(answer.later);
    EXPECT_EQ(answer.later->code(), wire::Reply::REFUSED);
    relay.host.leave("console a");  // it may be gone
    relay.said(1);
    relay.reply(1, said[0].request(), is_granted ? wire::Reply::OK : wire::Reply::REFUSED);
    const auto after = relay.said(1);
    ASSERT_EQ(after.size(), is_granted ? 1u : 0u);
    if (is_granted) {
      EXPECT_TRUE(after[0].set().con().release());
      relay.reply(1, after[0].request());
    }
    EXPECT_EQ(answer.times, 1);
  }
  // Another console has asked for it meanwhile: it keeps it.
  Answer first, second;
  ask(relay, first, take, "console a");
  const auto late = relay.said(1);
  ASSERT_EQ(late.size(), 1u);
  relay.pass(std::chrono::milliseconds(4900));
  relay.settings_from(1, 0, 0, 50);
  relay.pass(std::chrono::milliseconds(200));
  relay.said(1);
  ask(relay, second, take, "console b");
  const auto next = relay.said(1);
  ASSERT_EQ(next.size(), 1u);
  relay.reply(1, late[0].request());
  relay.reply(1, next[0].request());
  EXPECT_EQ(second.later->code(), wire::Reply::OK);
  EXPECT_TRUE(relay.said(1).empty());
}

TEST(PassedUp, ChartsComeOneAfterAnother) {
  wire::Hello hello = hello_of(1);
  hello.set_has_chart(true);
  RelayUnderTest relay(hello);
  relay.accept_all();
  EXPECT_TRUE(relay.host.has_chart());
  std::vector<std::string> told;
  const auto done = [&told](ChartAnswer<wire::Coastline> chart) {
    told.push_back(chart ? (*chart).chart() : chart.why() == NoChart::busy ? "busy" : "none");
  };
  const auto objects_done = [&told](const ChartAnswer<wire::ChartObjects>& chart) {
    told.push_back(chart ? "objects" : chart.why() == NoChart::busy ? "busy" : "none");
  };
  relay.host.find_coastline({}, done);
  relay.host.find_coastline({}, done);
  auto said = relay.said(1);
  ASSERT_EQ(said.size(), 1u);
  wire::ServerMessage message;
  message.mutable_coastline()->set_chart("first");
  relay.say(1, message);
  relay.reply(1, said[0].request());
  relay.pass(std::chrono::milliseconds(100));
  said = relay.said(1);
  ASSERT_EQ(said.size(), 2u);  // and GetHops
  EXPECT_TRUE(said[0].has_get_coastline());
  relay.reply(1, said[0].request(), wire::Reply::REFUSED, "no chart here");
  EXPECT_THAT(told, testing::ElementsAre("first", "none"));
  // What is refused for now only.
  told.clear();
  for (const auto text : {kChartBusy, kCoastlineAsked, kNoChartHere}) {
    relay.host.find_coastline({}, done);
    relay.reply(1, relay.said(1).at(0).request(), wire::Reply::REFUSED, std::string(text));
    relay.pass(std::chrono::milliseconds(1));
  }
  relay.host.find_chart_objects({}, objects_done);
  relay.reply(1, relay.said(1).at(0).request(), wire::Reply::REFUSED, std::string(kChartBusy));
  EXPECT_THAT(told, testing::ElementsAre("busy", "busy", "none", "busy"));
  told.clear();
  relay.host.find_coastline({}, done);
  relay.said(1);
  for (int i = 0; i < 31; ++i) {
    relay.settings_from(1, 0, 0, 50);  // it is alive
    relay.pass(std::chrono::seconds(1));
  }
  EXPECT_THAT(told, testing::ElementsAre("busy")) << "not answered in time";
}

TEST(PassedUp, APlaybacksOrdersGoUp) {
  wire::Hello hello = hello_of(1);
  hello.set_playback(true);
  RelayUnderTest relay(hello);
  relay.accept_all();
  PlaybackPort* port = relay.host.playback();
  ASSERT_NE(port, nullptr);
  wire::ServerMessage message;
  message.mutable_playback()->set_file("exercise.mcap");
  message.mutable_playback()->set_playing(true);
  relay.say(1, message);
  EXPECT_EQ(port->state().file(), "exercise.mcap");
  const auto version = port->version();
  message.mutable_playback()->set_position_s(1);
  relay.say(1, message);
  EXPECT_EQ(port->version(), version);
  message.mutable_playback()->set_playing(false);
  relay.say(1, message);
  EXPECT_GT(port->version(), version);
  std::optional<wire::Reply> later;
  EXPECT_FALSE(port->control_or_ask({}, "console a", [&](const auto& reply) { later = reply; }));
  relay.reply(1, relay.said(1).at(0).request());
  EXPECT_TRUE(later);
}

}  // namespace
}  // namespace skerry::server
