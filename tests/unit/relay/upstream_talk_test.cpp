// When a relay connects, and what it makes of a server that is not as it should be.
#include "server/relay/upstream_talk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

std::string problem_of(const RelayUnderTest& relay) { return relay.host.hops().at(0).problem(); }

TEST(UpstreamTalk, HasALineForEachRadarTheFirstBeforeTheOthers) {
  RelayUnderTest relay(hello_of(3));
  relay.step();
  EXPECT_EQ(relay.begun.size(), 1u);
  EXPECT_EQ(relay.accept(1).radar(), 0u);
  relay.step();
  ASSERT_EQ(relay.begun.size(), 3u);
  EXPECT_EQ(relay.accept(2).radar(), 1u);
  EXPECT_EQ(relay.accept(3).radar(), 2u);
  EXPECT_TRUE(relay.host.hops().at(0).connected());
}

TEST(UpstreamTalk, TriesAgainForEverLaterAndLater) {
  RelayUnderTest relay;
  relay.step();
  for (int i = 0; i < 300; ++i) {
    if (relay.begun.count(1) != 0) {
      relay.cut(1, "192.0.2.7:7410 refused the connection");
    }
    relay.pass(std::chrono::milliseconds(100));
  }
  ASSERT_GE(relay.attempts.size(), 8u);
  EXPECT_LT(relay.attempts[1] - relay.attempts[0], std::chrono::milliseconds(500));
  for (std::size_t i = 1; i < relay.attempts.size(); ++i) {
    EXPECT_LE(relay.attempts[i] - relay.attempts[i - 1],
              UpstreamTalk::kLastRetry + std::chrono::milliseconds(200));
  }
  EXPECT_GE(relay.attempts.back() - *(relay.attempts.rbegin() + 1), std::chrono::seconds(3));
  // And at once, when it has been there.
  relay.pass(std::chrono::seconds(5));
  relay.accept(1);
  relay.cut(1, "gone");
  const std::size_t before = relay.attempts.size();
  relay.pass(std::chrono::milliseconds(300));
  EXPECT_EQ(relay.attempts.size(), before + 1);
}

TEST(UpstreamTalk, GivesUpALineOnWhichNothingComes) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.pass(std::chrono::seconds(4));
  EXPECT_TRUE(relay.ended.empty());
  relay.pass(std::chrono::seconds(2));
  EXPECT_THAT(relay.ended, testing::ElementsAre(1));
  EXPECT_THAT(problem_of(relay), HasSubstr("nothing has come from 192.0.2.7:7410 for 5 s"));
}

TEST(UpstreamTalk, AServerThatIsSilentFromTheStartIsGivenUpToo) {
  RelayUnderTest relay;
  relay.step();
  relay.talk.connected(1, relay.now);
  relay.pass(std::chrono::seconds(6));
  EXPECT_THAT(relay.ended, testing::ElementsAre(1));
}

TEST(UpstreamTalk, GarbageEndsTheLineAndIsTold) {
  const Bytes kinds[] = {
      {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff},  // no length
      {0xff, 0xff, 0xff, 0x7f},                    // too long
      {3, 0xff, 0xff, 0xff},                       // no message
  };
  for (const Bytes& garbage : kinds) {
    RelayUnderTest relay;
    relay.accept_all();
    relay.say(1, garbage);
    EXPECT_THAT(relay.ended, testing::ElementsAre(1));
    EXPECT_THAT(problem_of(relay), HasSubstr("not the native protocol"));
    relay.pass(std::chrono::seconds(1));
    relay.accept(1);
    EXPECT_EQ(problem_of(relay), "");
  }
}

TEST(UpstreamTalk, ASpokeThatIsNoneEndsTheLine) {
  const auto spoiled = [](auto spoil) {
    wire::ServerMessage message;
    to_message(spoke_of(0, 0, 1), *message.mutable_spoke());
    spoil(*message.mutable_spoke());
    RelayUnderTest relay;
    relay.accept_all();
    Console console(relay.host.find_channel(0, 0));
    relay.say(1, message);
    EXPECT_TRUE(console.take().empty());
    EXPECT_EQ(relay.ended.size(), 1u);
    return problem_of(relay);
  };
  EXPECT_THAT(spoiled([](auto& spoke) { spoke.set_radar(3); }), HasSubstr("radar 3"));
  EXPECT_THAT(spoiled([](auto& spoke) { spoke.set_view(3); }), HasSubstr("view 3"));
  EXPECT_THAT(spoiled([](auto& spoke) { spoke.set_index(9999); }), HasSubstr("index"));
  EXPECT_THAT(spoiled([](auto& spoke) { spoke.set_cells("x"); }), HasSubstr("cells"));
  EXPECT_THAT(spoiled([](auto& spoke) { spoke.set_latitude_deg(99); }), HasSubstr("latitude"));
}

TEST(UpstreamTalk, BytesInAnyPiecesAreTheSame) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  Bytes sent;
  for (std::uint64_t i = 0; i < 5; ++i) append_spoke_frame(sent, spoke_of(0, 0, i));
  for (const std::uint8_t byte : sent) relay.talk.take(1, {&byte, 1}, relay.now);
  relay.talk.flush(1, relay.now);
  EXPECT_EQ(console.take(), sent);
}

TEST(UpstreamTalk, WhoSpeaksBeforeTheHelloIsNoServer) {
  RelayUnderTest relay;
  relay.step();
  relay.talk.connected(1, relay.now);
  relay.settings_from(1, 0, 0, 4);
  EXPECT_THAT(problem_of(relay), HasSubstr("did not begin with a Hello"));
}

TEST(UpstreamTalk, ARefusedConnectionIsToldWithItsReason) {
  RelayUnderTest relay;
  relay.step();
  relay.talk.connected(1, relay.now);
  relay.reply(1, 0, wire::Reply::REFUSED, "no connection is left");
  EXPECT_THAT(problem_of(relay), HasSubstr("no connection is left"));
}

TEST(UpstreamTalk, ALoopThatComesAboutLaterIsRefused) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.cut(1, "gone");
  relay.greeting.set_identity("another relay");
  relay.greeting.add_relays()->set_identity("the relay");
  relay.pass(std::chrono::seconds(1));
  relay.talk.connected(1, relay.now);
  relay.say_hello(1);
  EXPECT_EQ(relay.ended.size(), 1u);
  EXPECT_THAT(problem_of(relay), HasSubstr("a loop"));
}

TEST(UpstreamTalk, OtherRadarsAreToldAndNotRelayed) {
  RelayUnderTest relay(hello_of(3));
  relay.accept_all();
  for (UpstreamTalk::LineId id = 1; id <= 3; ++id) relay.cut(id, "gone");
  relay.greeting = hello_of(2, "second run");
  relay.greeting.mutable_radars(1)->set_own_ship("Gannet");
  relay.pass(std::chrono::seconds(1));
  relay.accept(1);
  relay.step();
  EXPECT_EQ(relay.begun.size(), 1u);
  EXPECT_THAT(problem_of(relay),
              HasSubstr("radar 1, 'radar 1' on Tern, is now 'radar 1' on Gannet"));
  EXPECT_THAT(problem_of(relay), HasSubstr("radar 2, 'radar 2' on Tern, is gone"));
  EXPECT_THAT(relay.host.own_ship(1).text(), HasSubstr("No picture"));
  EXPECT_FALSE(relay.host.own_ship(0).text().starts_with("No picture"));
  wire::Set set;
  set.set_radar(1);
  set.set_gain(7);
  const auto answer = relay.host.apply_or_ask(set, "console a", [](const auto&) {});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->code(), wire::Reply::REFUSED);
}

TEST(UpstreamTalk, MeasuresTheRoundTripAndKnowsTheHopsBefore) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.pass(std::chrono::milliseconds(1));
  const auto said = relay.said(1);
  ASSERT_EQ(said.size(), 1u);
  ASSERT_TRUE(said[0].has_get_hops());
  relay.now += std::chrono::milliseconds(12);
  wire::ServerMessage message;
  message.mutable_hops()->add_hops()->set_upstream("198.51.100.1:7410");
  relay.say(1, message);
  relay.reply(1, said[0].request());
  const auto hops = relay.host.hops();
  ASSERT_EQ(hops.size(), 2u);
  EXPECT_NEAR(hops[0].round_trip_ms(), 12, 1e-6);
  EXPECT_EQ(hops[1].upstream(), "198.51.100.1:7410");
  relay.pass(std::chrono::milliseconds(100));
  EXPECT_TRUE(relay.said(1).empty());
  relay.pass(std::chrono::seconds(2));
  EXPECT_EQ(relay.said(1).size(), 1u);
}

TEST(UpstreamTalk, AnOlderServerIsNotAskedForHops) {
  RelayUnderTest relay(hello_of(1, ""));
  relay.accept_all();
  relay.pass(std::chrono::seconds(3));
  EXPECT_TRUE(relay.said(1).empty());
  EXPECT_FALSE(relay.host.hops().at(0).has_round_trip_ms());
}

TEST(UpstreamTalk, LinesToAnotherRunOfTheServerAreEnded) {
  RelayUnderTest relay(hello_of(2));
  relay.accept_all();
  // Radar 0's line is with a server that has started again, the other still with the one before.
  relay.cut(1, "gone");
  relay.greeting = hello_of(2, "second run");
  relay.pass(std::chrono::seconds(1));
  relay.accept(1);
  EXPECT_THAT(relay.ended, testing::ElementsAre(2));
  // It may come back to that one.
  relay.pass(std::chrono::seconds(1));
  ASSERT_EQ(relay.begun.count(2), 1u);
  relay.greeting = hello_of(2, "first run");
  relay.talk.connected(2, relay.now);
  relay.say_hello(2);
  EXPECT_THAT(relay.ended, testing::ElementsAre(2, 2));
}

TEST(UpstreamTalk, ALineThatFailsOnceItIsThereIsTriedLaterEachTime) {
  RelayUnderTest relay;
  relay.accept_all();
  const auto tries_in_half_a_minute = [&] {
    const std::size_t before = relay.attempts.size();
    for (const auto until = relay.now + std::chrono::seconds(30); relay.now < until;) {
      relay.pass(std::chrono::milliseconds(50));
      if (relay.begun.count(1) == 0) continue;
      relay.accept(1);
      relay.cut(1, "what came is no message");
    }
    return relay.attempts.size() - before;
  };
  relay.cut(1, "what came is no message");
  EXPECT_LT(tries_in_half_a_minute(), 16u);
  // One that has lasted is as good as new.
  while (relay.begun.count(1) == 0) relay.pass(std::chrono::milliseconds(50));
  relay.accept(1);
  for (int i = 0; i < 30; ++i) {
    relay.settings_from(1, 0, 0, i);
    relay.pass(std::chrono::milliseconds(500));
  }
  relay.cut(1, "gone");
  relay.pass(std::chrono::milliseconds(300));
  EXPECT_EQ(relay.begun.count(1), 1u);
}

// It sends, so that it is not silent, but takes nothing.
TEST(UpstreamTalk, AServerThatDoesNotReadIsAskedNoMoreAndLeft) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::Set set;
  set.add_lock(std::string(3'500, 'x'));  // a long one
  std::size_t asked = 0;
  std::string refused;
  constexpr std::size_t kEnough = 2 * UpstreamLine::kMostOutput / 3'500;
  while (relay.ended.empty() && asked < kEnough) {
    for (int i = 0; i < 500; ++i, ++asked) {
      relay.host.apply_or_ask(set, "console a", [&](const wire::Reply& reply) {
        if (reply.text().find("has not answered in time") == std::string::npos) {
          refused = reply.text();
        }
      });
    }
    relay.talk.take_orders(relay.now);
    relay.settings_from(1, 0, 0, 50);
    relay.pass(std::chrono::milliseconds(4900));  // less than silence
    relay.settings_from(1, 0, 0, 50);
    relay.pass(std::chrono::milliseconds(200));  // more than patience
  }
  EXPECT_THAT(refused, HasSubstr("192.0.2.7:7410 does not read"));
  EXPECT_THAT(relay.ended, testing::ElementsAre(1));
  EXPECT_LE(asked, UpstreamLine::kMostOutput / 3'500 + 500);
  EXPECT_THAT(problem_of(relay), HasSubstr("does not read"));
  relay.pass(std::chrono::seconds(1));
  relay.accept(1);
  EXPECT_EQ(problem_of(relay), "");
}

}  // namespace
}  // namespace skerry::server
