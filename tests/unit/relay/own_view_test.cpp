// Views that consoles here have for themselves, which are views of the other server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

struct Opened {
  std::optional<RadarHost::OpenedView> now, later;
};
void open(RelayUnderTest& relay, Opened& opened, std::uint32_t like = 0) {
  opened.now = relay.host.open_view_or_ask(0, like, RelayUnderTest::prepare,
                                           [&opened](const auto& view) { opened.later = view; });
  relay.step();
}

TEST(OwnView, HasTheNumberThatItHasThere) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.settings_from(1, 0, 0, 21);
  Opened opened;
  open(relay, opened);
  EXPECT_FALSE(opened.now);
  ASSERT_EQ(relay.begun.count(2), 1u);
  const auto subscribed = relay.accept(2, 5);
  EXPECT_TRUE(subscribed.new_view());
  ASSERT_TRUE(opened.later && opened.later->ok());
  EXPECT_EQ(**opened.later, 5u);
  EXPECT_EQ(relay.host.settings(0, 5).gain(), 21);  // like view 0, until its own come
  Console console(relay.host.find_channel(0, 5));
  Bytes sent;
  append_spoke_frame(sent, spoke_of(0, 5, 77));
  relay.say(2, sent);
  EXPECT_EQ(console.take(), sent);
  relay.settings_from(2, 0, 5, 33);
  EXPECT_EQ(relay.host.settings(0, 5).gain(), 33);
  EXPECT_EQ(relay.host.settings(0, 5).view(), 5u);
  // Changed there, by its number.
  wire::Set set;
  set.set_view(5);
  set.set_gain(34);
  EXPECT_FALSE(relay.host.apply_or_ask(set, "console a", [](const auto&) {}));
  EXPECT_EQ(relay.said(1).at(0).set().view(), 5u);
  // A further one like it.
  Opened further;
  open(relay, further, 5);
  EXPECT_EQ(relay.accept(3, 6).view(), 5u);
}

TEST(OwnView, EndsThereWhenTheConsoleHasLeft) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.accept(2, 5);
  const auto version = relay.host.views_version();
  relay.host.close_view(0, 5);
  relay.step();
  EXPECT_THAT(relay.ended, testing::ElementsAre(2));
  EXPECT_EQ(relay.host.find_channel(0, 5), nullptr);
  EXPECT_GT(relay.host.views_version(), version);
}

TEST(OwnView, ARefusalIsToldWithItsReason) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.talk.connected(2, relay.now);
  relay.say_hello(2);
  relay.reply(2, relay.said(2).at(0).request(), wire::Reply::REFUSED, "as many as one address may");
  ASSERT_TRUE(opened.later);
  EXPECT_THAT(opened.later->error(), HasSubstr("as many as one address may"));
  EXPECT_EQ(relay.begun.size(), 1u);
  relay.pass(std::chrono::seconds(2));
  EXPECT_EQ(relay.begun.size(), 1u);
}

TEST(OwnView, IsNotWaitedForLong) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.settings_from(1, 0, 0, 1);
  relay.pass(std::chrono::milliseconds(4900));
  relay.settings_from(1, 0, 0, 2);
  EXPECT_FALSE(opened.later);
  relay.pass(std::chrono::milliseconds(200));
  ASSERT_TRUE(opened.later);
  EXPECT_THAT(opened.later->error(), HasSubstr("has not opened a view in time"));
  EXPECT_EQ(relay.begun.size(), 1u);
}

TEST(OwnView, WithoutTheOtherServerItIsRefusedAtOnce) {
  RelayUnderTest relay;
  Opened opened;
  open(relay, opened);
  ASSERT_TRUE(opened.now);
  EXPECT_FALSE(opened.now->ok());
}

TEST(OwnView, GoesOnWithTheSameOneAfterACut) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.accept(2, 5);
  relay.cut(2, "cut");
  relay.pass(std::chrono::seconds(1));
  const auto again = relay.accept(2);
  EXPECT_FALSE(again.new_view());
  EXPECT_EQ(again.view(), 5u);
}

// Its number may be somebody else's by now; and the console keeps the one it knows.
TEST(OwnView, IsOpenedAgainWithItsSettingsAtAServerThatHasStartedAgain) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.accept(2, 5);
  relay.settings_from(2, 0, 5, 33);
  relay.cut(1, "gone");
  relay.cut(2, "gone");
  relay.greeting.set_identity("second run");
  relay.pass(std::chrono::seconds(1));
  relay.accept(1);
  relay.step();
  // Until it is there, its number is nobody's or somebody else's.
  wire::Set early;
  early.set_view(5);
  early.set_gain(1);
  const auto refused = relay.host.apply_or_ask(early, "console a", [](const auto&) {});
  ASSERT_TRUE(refused);
  EXPECT_THAT(refused->text(), HasSubstr("being opened again"));
  Opened like;
  open(relay, like, 5);
  ASSERT_TRUE(like.now);
  EXPECT_THAT(like.now->error(), HasSubstr("being opened again"));
  EXPECT_TRUE(relay.said(1).empty());
  const auto again = relay.accept(2, 1);
  EXPECT_TRUE(again.new_view());
  EXPECT_EQ(again.view(), 0u);
  const auto said = relay.said(2);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].set().view(), 1u);
  EXPECT_EQ(said[0].set().gain(), 33);
  EXPECT_FALSE(said[0].set().has_rotation_rpm());  // the radar's
  Console console(relay.host.find_channel(0, 5));
  relay.send_spokes(2, 0, 1, 7, 2);
  const auto spokes = spokes_in(console.take());
  ASSERT_EQ(spokes.size(), 2u);
  EXPECT_EQ(spokes[0].view(), 5u);
  EXPECT_EQ(spokes[0].sequence(), 7u);
  EXPECT_EQ(spokes[0].cells(), [] {
    wire::Spoke sent;
    to_message(spoke_of(0, 1, 7), sent);
    return sent.cells();
  }());
  wire::Set set;
  set.set_view(5);
  set.set_gain(34);
  EXPECT_FALSE(relay.host.apply_or_ask(set, "console a", [](const auto&) {}));
  EXPECT_EQ(relay.said(1).at(0).set().view(), 1u);
  // A number that is taken here.
  Opened further;
  open(relay, further);
  relay.accept(3, 5);
  ASSERT_TRUE(further.later && further.later->ok());
  EXPECT_NE(**further.later, 5u);
}

TEST(OwnView, ThatHasEndedThereIsOpenedAnew) {
  RelayUnderTest relay;
  relay.accept_all();
  Opened opened;
  open(relay, opened);
  relay.accept(2, 5);
  relay.cut(2, "cut");
  relay.pass(std::chrono::seconds(1));
  relay.talk.connected(2, relay.now);
  relay.say_hello(2);
  relay.reply(2, relay.said(2).at(0).request(), wire::Reply::UNKNOWN, "no radar 0 with view 5");
  relay.step();
  EXPECT_TRUE(relay.accept(2, 8).new_view());
}

}  // namespace
}  // namespace skerry::server
