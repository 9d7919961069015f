// What comes from the other server and goes on to consoles here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PassedOn, SpokesAreTheBytesThatCame) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  Bytes sent;
  for (std::uint64_t i = 0; i < 40; ++i) append_spoke_frame(sent, spoke_of(0, 0, 9000 + i));
  relay.say(1, sent);
  EXPECT_EQ(console.take(), sent);
}

TEST(PassedOn, WhatThisVersionDoesNotKnowStaysInASpoke) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  wire::ServerMessage message;
  to_message(spoke_of(0, 0, 1), *message.mutable_spoke());
  message.mutable_spoke()
      ->GetReflection()
      ->MutableUnknownFields(message.mutable_spoke())
      ->AddVarint(900, 7);
  Bytes sent;
  append_frame(sent, message);
  relay.say(1, sent);
  EXPECT_EQ(console.take(), sent);
}

TEST(PassedOn, AGapStaysAGapAndIsCounted) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  relay.send_spokes(1, 0, 0, 100, 10);
  relay.send_spokes(1, 0, 0, 115, 10);
  const auto spokes = spokes_in(console.take());
  ASSERT_EQ(spokes.size(), 20u);
  EXPECT_EQ(spokes[9].sequence(), 109u);
  EXPECT_EQ(spokes[10].sequence(), 115u);
  relay.pass(std::chrono::seconds(1));
  EXPECT_EQ(relay.host.hops().at(0).spokes(), 20u);
  EXPECT_EQ(relay.host.hops().at(0).spokes_lost(), 5u);
}

TEST(PassedOn, SpokesInDisorderArePassedOnAndCountedOnce) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  for (const std::uint64_t sequence : {10u, 13u, 11u, 12u, 12u}) {
    relay.send_spokes(1, 0, 0, sequence, 1);
    relay.pass(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(spokes_in(console.take()).size(), 5u);
  EXPECT_EQ(relay.host.hops().at(0).spokes(), 4u);
  EXPECT_EQ(relay.host.hops().at(0).spokes_lost(), 2u);  // told before they came
}

TEST(PassedOn, WhatWasMissedWhileTheLineWasDownIsAGapToo) {
  RelayUnderTest relay;
  relay.accept_all();
  Console console(relay.host.find_channel(0, 0));
  relay.send_spokes(1, 0, 0, 0, 10);
  relay.cut(1, "cut");
  relay.pass(std::chrono::seconds(5));
  relay.accept(1);
  relay.send_spokes(1, 0, 0, 3000, 10);
  relay.pass(std::chrono::seconds(1));
  EXPECT_EQ(relay.host.hops().at(0).spokes_lost(), 2990u);
  EXPECT_EQ(relay.host.hops().at(0).reconnects(), 1u);
}

TEST(PassedOn, AServerThatHasStartedAgainCountsAnew) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.send_spokes(1, 0, 0, 500, 10);
  relay.cut(1, "cut");
  relay.pass(std::chrono::seconds(5));
  relay.greeting.set_identity("second run");
  relay.accept(1);
  Console console(relay.host.find_channel(0, 0));
  relay.send_spokes(1, 0, 0, 0, 10);
  relay.send_spokes(1, 0, 0, 800, 10);
  relay.pass(std::chrono::seconds(1));
  EXPECT_EQ(spokes_in(console.take()).front().sequence(), 0u);
  EXPECT_EQ(relay.host.hops().at(0).spokes(), 30u);
  EXPECT_EQ(relay.host.hops().at(0).spokes_lost(), 790u);
}

TEST(PassedOn, OtherFormatsAreMadeOfTheSameSpokes) {
  RelayUnderTest relay;
  std::vector<std::uint64_t> made;
  auto channel = relay.host.find_channel(0, 0);
  channel->add_format("other", [&made](const Sector& sector) {
    for (const SpokePtr& spoke : sector.spokes) made.push_back(spoke->header.sequence);
    auto encoded = std::make_shared<EncodedSector>();
    encoded->spoke_ends.assign(sector.spokes.size(), 0);
    return encoded;
  });
  const auto registered = channel->format("other").on_publish([] {});
  relay.accept_all();
  relay.send_spokes(1, 0, 0, 5, 3);
  EXPECT_THAT(made, ElementsAre(5, 6, 7));
}

TEST(PassedOn, AnOutputsViewIsMadeHereAndNumberedHere) {
  RelayUnderTest relay;
  const auto view = relay.host.open_view(0, 0, true, RelayUnderTest::prepare);
  ASSERT_TRUE(view);
  EXPECT_GE(*view, 65'000u);
  relay.accept_all();
  Console console(relay.host.find_channel(0, *view));
  relay.send_spokes(1, 0, 0, 5, 3);
  const auto spokes = spokes_in(console.take());
  ASSERT_EQ(spokes.size(), 3u);
  EXPECT_EQ(spokes[0].view(), *view);
  wire::Set reach;
  reach.set_view(*view);
  reach.set_instrumented_range_m(5000);
  EXPECT_EQ(relay.host.apply(reach, "display").code(), wire::Reply::OK);
  EXPECT_TRUE(relay.said(1).empty());
}

TEST(PassedOn, SettingsShipsAndWorldAreTheOthers) {
  RelayUnderTest relay(hello_of(2));
  relay.accept_all();
  const auto settings_before = relay.host.settings_version(),
             world_before = relay.host.world_version();
  relay.settings_from(2, 1, 0, 42);
  wire::ServerMessage ship;
  ship.mutable_own_ship()->set_name("Tern");
  ship.mutable_own_ship()->set_latitude_deg(60.5);
  ship.mutable_own_ship()->set_utc_ns(77);
  relay.say(1, ship);
  wire::ServerMessage world;
  world.mutable_world()->set_sea_state(3);
  relay.say(1, world);
  EXPECT_EQ(relay.host.settings(1, 0).gain(), 42);
  EXPECT_EQ(relay.host.settings(1, 0).radar(), 1u);
  EXPECT_GT(relay.host.settings_version(), settings_before);
  EXPECT_EQ(relay.host.own_ship(0).latitude_deg(), 60.5);
  EXPECT_EQ(relay.host.own_ship(0).utc_ns(), 77u);
  EXPECT_FALSE(relay.host.own_ship(0).no_position());
  EXPECT_EQ(relay.host.world().sea_state(), 3);
  EXPECT_GT(relay.host.world_version(), world_before);
  const auto world_then = relay.host.world_version();
  relay.say(1, world);
  EXPECT_EQ(relay.host.world_version(), world_then);  // nothing has changed
}

TEST(PassedOn, TheWorldsClocksGoOnUntilTheOtherServerIsGone) {
  RelayUnderTest relay;
  relay.accept_all();
  EXPECT_EQ(relay.host.world().scenario_s(), 0);
  wire::ServerMessage world;
  world.mutable_world()->set_scenario_s(100);
  world.mutable_world()->set_exercise_s(50);
  world.mutable_world()->set_rate(2);
  relay.say(1, world);
  const wire::World now = relay.host.world();
  EXPECT_GE(now.scenario_s(), 100);
  EXPECT_NEAR(now.exercise_s() - 50, 2 * (now.scenario_s() - 100), 1e-6);
  relay.cut(1, "gone");
  EXPECT_EQ(relay.host.world().scenario_s(), relay.host.world().scenario_s());
  EXPECT_GE(relay.host.world().scenario_s(), now.scenario_s());
}

TEST(PassedOn, WithoutTheOtherServerNobodyIsToSteerByWhatIsOld) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::ServerMessage ship;
  ship.mutable_own_ship()->set_latitude_deg(60.5);
  relay.say(1, ship);
  relay.cut(1, "192.0.2.7:7410 closed the connection");
  const wire::OwnShip told = relay.host.own_ship(0);
  EXPECT_TRUE(told.no_position());
  EXPECT_TRUE(told.no_heading());
  EXPECT_THAT(told.text(), HasSubstr("No picture: 192.0.2.7:7410 closed the connection"));
  EXPECT_EQ(told.texts(), 1u);
  const wire::HopStatus hop = relay.host.hops().at(0);
  EXPECT_FALSE(hop.connected());
  EXPECT_THAT(hop.problem(), HasSubstr("closed the connection"));
}

TEST(PassedOn, NumbersOutOfRangeAreBroughtIntoIt) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.settings_from(1, 0, 0, 1e300);
  EXPECT_LE(relay.host.settings(0, 0).gain(), 100);
  wire::ServerMessage ship;
  ship.mutable_own_ship()->set_latitude_deg(-1000);
  relay.say(1, ship);
  EXPECT_EQ(relay.host.own_ship(0).latitude_deg(), -90);
}

TEST(PassedOn, TruthComesWhileSomebodyWantsIt) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.pass(std::chrono::milliseconds(100));
  EXPECT_EQ(relay.begun.size(), 1u);
  EXPECT_FALSE(relay.host.exercise_state());
  relay.pass(std::chrono::milliseconds(1));
  relay.pass(std::chrono::milliseconds(1));
  ASSERT_EQ(relay.begun.size(), 2u);
  const auto subscribed = relay.accept(2);
  EXPECT_EQ(subscribed.exercise_hz(), 4u);
  EXPECT_TRUE(subscribed.no_spokes());
  wire::ServerMessage message;
  auto* ship = message.mutable_exercise()->add_ships();
  ship->set_number(3);
  ship->set_name("Ferry");
  ship->set_speed_kn(10);
  ship->set_ais_off(true);
  auto* own = message.mutable_exercise()->add_ships();
  own->set_number(0);
  own->set_own(true);
  message.mutable_exercise()->set_can_undo("course of Ferry");
  relay.say(2, message);
  ASSERT_TRUE(relay.host.exercise_state());
  EXPECT_EQ(relay.host.exercise_state()->can_undo(), "course of Ferry");
  const auto traffic = relay.host.traffic();
  ASSERT_EQ(traffic.size(), 2u);
  EXPECT_EQ(traffic[0].name, "Ferry");
  EXPECT_TRUE(said_by_ais(traffic[0]).silent);
  EXPECT_EQ(traffic[0].number, 5u);
  EXPECT_EQ(traffic[1].number, 1u);
  relay.now += std::chrono::seconds(11);
  relay.pass(std::chrono::milliseconds(1));
  EXPECT_EQ(relay.begun.count(2), 0u);
}

TEST(PassedOn, TruthThatIsRefusedIsNotAskedForAtOnceAgain) {
  RelayUnderTest relay;
  relay.accept_all();
  relay.host.exercise_state();
  relay.pass(std::chrono::milliseconds(1));
  relay.pass(std::chrono::milliseconds(1));
  ASSERT_EQ(relay.begun.count(2), 1u);
  relay.talk.connected(2, relay.now);
  relay.say_hello(2);
  relay.reply(2, relay.said(2).at(0).request(), wire::Reply::REFUSED,
              "is for instructor and admin");
  EXPECT_EQ(relay.begun.count(2), 0u);
  relay.pass(std::chrono::milliseconds(100));
  relay.pass(std::chrono::milliseconds(100));
  EXPECT_EQ(relay.begun.size(), 1u);
}

// They would go into every console's stream, however many there are.
TEST(PassedOn, WhatThisVersionDoesNotKnowOfAShipIsLeftOut) {
  RelayUnderTest relay;
  relay.accept_all();
  wire::ServerMessage message;
  wire::OwnShip& ship = *message.mutable_own_ship();
  ship.set_ordered_course_deg(17);
  ship.GetReflection()->MutableUnknownFields(&ship)->AddLengthDelimited(900,
                                                                        std::string(1000, 'x'));
  relay.say(1, message);
  const wire::OwnShip told = relay.host.own_ship(0);
  EXPECT_EQ(told.ordered_course_deg(), 17);
  EXPECT_LT(told.ByteSizeLong(), 500u);
}

}  // namespace
}  // namespace skerry::server
