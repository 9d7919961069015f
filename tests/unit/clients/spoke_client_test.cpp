#include "clients/common/spoke_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "tests/unit/clients/fake_server.hpp"
#include "tests/unit/clients/long_wait.hpp"
#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry::client {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto kShort = 50ms;  // always reached

ClientResult<SpokeClient> connect_to(const FakeServer& server, Duration timeout = kLong) {
  return SpokeClient::connect("127.0.0.1", server.port(), timeout);
}

std::string place(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

TEST(SpokeClient, SaysThatNobodyListens) {
  const std::uint16_t port = unused_port();
  const auto client = SpokeClient::connect("127.0.0.1", port, kLong);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::refused);
  EXPECT_THAT(client.error().text, HasSubstr(place(port)));
}

TEST(SpokeClient, NamesAnIpv6PlaceWithBrackets) {
  const std::uint16_t port = unused_port();
  const auto client = SpokeClient::connect("::1", port, kLong);
  ASSERT_FALSE(client);
  EXPECT_THAT(client.error().text, HasSubstr("[::1]:" + std::to_string(port)));
}

TEST(SpokeClient, SaysThatThereIsNoSuchHost) {
  const auto client = SpokeClient::connect("999.1.2.3.invalid", 7410, kLong);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::unreachable);
  EXPECT_THAT(client.error().text, HasSubstr("999.1.2.3.invalid:7410"));
}

TEST(SpokeClient, GivesUpOnAServerThatSaysNothing) {
  FakeServer server([](FakePeer& peer) { peer.wait_until_client_leaves(); });
  const auto client = connect_to(server, kShort);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::timed_out);
  EXPECT_THAT(client.error().text, HasSubstr("no Hello"));
}

TEST(SpokeClient, RefusesWhatIsNotASkerryServer) {
  FakeServer server([](FakePeer& peer) {
    const std::string text =
        "HTTP/1.1 400 Bad Request\r\nConnection: close\r\n\r\n" + std::string(100, 'x');
    peer.send_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    peer.wait_until_client_leaves();
  });
  const auto client = connect_to(server);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::malformed);
}

TEST(SpokeClient, RefusesAnotherProtocolVersion) {
  FakeServer server([](FakePeer& peer) { peer.say_hello(2); });
  const auto client = connect_to(server);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::malformed);
  EXPECT_THAT(client.error().text, HasSubstr("version 2"));
}

TEST(SpokeClient, RefusesAnEndlessFrame) {
  FakeServer server([](FakePeer& peer) {
    const Bytes length_of_4_gib = {0xff, 0xff, 0xff, 0xff, 0x0f};
    peer.send_bytes(length_of_4_gib);
    peer.wait_until_client_leaves();
  });
  const auto client = connect_to(server);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::malformed);
}

TEST(SpokeClient, TellsTheServersReasonForTurningItAway) {
  FakeServer server(
      [](FakePeer& peer) { peer.answer(0, wire::Reply::REFUSED, "no connection is left"); });
  const auto client = connect_to(server);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::rejected);
  EXPECT_THAT(client.error().text, HasSubstr("no connection is left"));
}

TEST(SpokeClient, GivesOutSpokesInOrderAndCountsTheMissingOnes) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    for (std::uint32_t i = 0; i < 100; ++i) {
      if (i < 40 || i >= 47) peer.send(spoke_of(kSmall, 2, i, 33.0));
    }
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client) << client.error().text;
  EXPECT_EQ(client->hello().server(), "fake 1");
  ASSERT_TRUE(client->subscribe(0, 0, kLong));
  for (std::uint32_t i = 0; i < 100; ++i) {
    if (i >= 40 && i < 47) continue;
    const auto event = client->receive(kLong);
    ASSERT_TRUE(event) << event.error().text;
    ASSERT_TRUE(*event);
    const auto& spoke = std::get<Spoke>(**event);
    EXPECT_EQ(spoke.header.index, i);
    EXPECT_NEAR(spoke.header.heading.in_degrees(), 33.0, 1e-6);
    EXPECT_EQ(spoke.cells.size(), 256u);
  }
  EXPECT_EQ(client->losses().received(), 93u);
  EXPECT_EQ(client->losses().lost(), 7u);
}

TEST(SpokeClient, GivesNothingWhenNothingComesAndGoesOnLater) {
  std::promise<void> go_on;
  FakeServer server([&](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    Bytes bytes;
    append_spoke_frame(bytes, spoke_of(kSmall, 0, 5));
    peer.send_bytes(std::span(bytes).first(bytes.size() / 2));  // stalls in the middle
    go_on.get_future().wait();
    peer.send_bytes(std::span(bytes).subspan(bytes.size() / 2));
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->subscribe(0, 0, kLong));
  for (const Duration timeout : {Duration(kShort), Duration(0)}) {
    const auto nothing = client->receive(timeout);
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(*nothing);
  }
  go_on.set_value();
  const auto event = client->receive(kLong);
  ASSERT_TRUE(event);
  ASSERT_TRUE(*event);
  EXPECT_EQ(std::get<Spoke>(**event).header.index, 5u);
}

TEST(SpokeClient, SaysThatTheServerClosedAndWhatItLastComplainedOf) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    peer.send(spoke_of(kSmall, 0, 0));
    peer.answer(9, wire::Reply::MALFORMED, "too long\x1b[31m");
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->subscribe(0, 0, kLong));
  EXPECT_TRUE(std::holds_alternative<Spoke>(*client->receive(kLong).value()));
  EXPECT_TRUE(std::holds_alternative<wire::Reply>(*client->receive(kLong).value()));
  for (int k = 0; k < 2; ++k) {  // and stays so
    const auto end = client->receive(kLong);
    ASSERT_FALSE(end);
    EXPECT_EQ(end.error().kind, ClientErrorKind::closed);
    EXPECT_THAT(end.error().text, HasSubstr(place(server.port())));
    EXPECT_THAT(end.error().text, HasSubstr("too long?[31m"));
  }
  EXPECT_FALSE(client->set({}, kLong));
}

TEST(SpokeClient, EndsOnASpokeThatCannotBe) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    wire::ServerMessage message;
    to_message(spoke_of(kSmall, 0, 0), *message.mutable_spoke());
    message.mutable_spoke()->set_index(256);
    peer.send(message);
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->subscribe(0, 0, kLong));
  const auto event = client->receive(kLong);
  ASSERT_FALSE(event);
  EXPECT_EQ(event.error().kind, ClientErrorKind::malformed);
}

TEST(SpokeClient, EndsOnAFrameThatIsNoMessage) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const Bytes frame = {4, 0x0a, 0x7f, 1, 2};  // a field that is longer than its frame
    peer.send_bytes(frame);
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  const auto event = client->receive(kLong);
  ASSERT_FALSE(event);
  EXPECT_EQ(event.error().kind, ClientErrorKind::malformed);
}

TEST(SpokeClient, TellsWhyASubscriptionWasRejected) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const auto message = peer.receive();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->subscribe().radar(), 7u);
    peer.answer(message->request(), wire::Reply::UNKNOWN, "there is no radar 7");
    peer.accept_subscription();
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  const auto rejected = client->subscribe(7, 0, kLong);
  ASSERT_FALSE(rejected);
  EXPECT_EQ(rejected.error().kind, ClientErrorKind::rejected);
  EXPECT_THAT(rejected.error().text, HasSubstr("there is no radar 7"));
  EXPECT_TRUE(client->subscribe(0, 0, kLong)) << "the connection lives on";
}

TEST(SpokeClient, SetsOnlyWhatItWasTold) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    const auto message = peer.receive();
    ASSERT_TRUE(message && message->has_set());
    EXPECT_EQ(message->set().radar(), 1u);
    EXPECT_DOUBLE_EQ(message->set().gain(), 60.0);
    EXPECT_FALSE(message->set().has_range_nm());
    EXPECT_FALSE(message->set().has_speed_kn());
    peer.answer(message->request(), wire::Reply::OK, "gain 60");
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  wire::Set request;
  request.set_radar(1);
  request.set_gain(60.0);
  const auto reply = client->set(request, kLong);
  ASSERT_TRUE(reply) << reply.error().text;
  EXPECT_EQ(reply->text(), "gain 60");
}

TEST(SpokeClient, KeepsWhatComesWhileItWaitsForAnAnswer) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    ASSERT_TRUE(peer.accept_subscription());
    for (int k = 0; k < 2; ++k) {
      const auto message = peer.receive();
      ASSERT_TRUE(message);
      peer.send(spoke_of(kSmall, 0, static_cast<std::uint32_t>(k)));
      if (message->has_set()) {
        peer.answer(message->request() + 1000);  // somebody else's
        peer.answer(message->request());
      } else {
        wire::ServerMessage status;
        status.mutable_status()->set_scenario("Bergen");
        peer.send(status);
        peer.answer(message->request());
      }
    }
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  ASSERT_TRUE(client->subscribe(0, 0, kLong));
  EXPECT_TRUE(client->set({}, kLong));
  const auto status = client->get_status(kLong);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->scenario(), "Bergen");
  EXPECT_EQ(std::get<Spoke>(*client->receive(kLong).value()).header.index, 0u);
  EXPECT_EQ(std::get<wire::Reply>(*client->receive(kLong).value()).request(), 1002u);
  EXPECT_EQ(std::get<Spoke>(*client->receive(kLong).value()).header.index, 1u);
  EXPECT_EQ(client->losses().lost(), 0u);
  const auto nothing = client->receive(kShort);
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(*nothing) << "the reply to the status request is no event";
}

TEST(SpokeClient, SaysThatARequestWasNotAnswered) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    peer.wait_until_client_leaves();
  });
  auto client = connect_to(server);
  ASSERT_TRUE(client);
  const auto status = client->get_status(kShort);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ClientErrorKind::timed_out);
  const auto set = client->set({}, kShort);
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().text, HasSubstr("did not answer the set request"));
}

TEST(SpokeClient, SurvivesRandomBytesAfterTheHello) {
  for (std::uint32_t seed = 0; seed < 64; ++seed) {
    FakeServer server([&](FakePeer& peer) {
      peer.say_hello();
      std::uint32_t state = seed * 2654435761u + 1;
      Bytes noise(4096);
      for (auto& byte : noise) {
        state = state * 1664525u + 1013904223u;
        byte = static_cast<std::uint8_t>(state >> 24);
      }
      peer.send_bytes(noise);
    });
    auto client = connect_to(server);
    ASSERT_TRUE(client);
    bool ended = false;
    for (int k = 0; k < 5000 && !ended; ++k) ended = !client->receive(kLong);
    EXPECT_TRUE(ended) << "seed " << seed;
  }
}

}  // namespace
}  // namespace skerry::client
