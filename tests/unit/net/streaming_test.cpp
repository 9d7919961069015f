// Spokes to many clients, over TCP and WebSocket alike.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"
#include "server/net/signalk/signalk_encoder.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

class Streaming : public testing::TestWithParam<const char*> {
 protected:
  static TestClient connect(const NetServer& server) {
    return GetParam() == std::string("tcp") ? TestClient(server.tcp_port())
                                            : TestClient::over_websocket(server.http_port());
  }
};
INSTANTIATE_TEST_SUITE_P(Transports, Streaming, testing::Values("tcp", "websocket"),
                         [](const auto& transport) { return transport.param; });

TEST_P(Streaming, SaysHelloBeforeAnythingIsAsked) {
  FakeHost host(2);
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  const wire::Hello hello = client.receive_hello();
  EXPECT_EQ(hello.server(), "fake");
  EXPECT_EQ(hello.radars_size(), 2);
}

TEST_P(Streaming, EverySpokeComesOnceInOrderWithItsCells) {
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  client.subscribe();
  std::uint64_t checked = 0;
  client.on_message = [&](const wire::ServerMessage& message) {
    if (!message.has_spoke()) return;
    const auto spoke = from_message(message.spoke());
    ASSERT_TRUE(spoke.ok()) << spoke.error().text;
    const Spoke expected = host.spoke(0, checked);
    EXPECT_EQ(spoke->header.sequence, checked);
    EXPECT_EQ(spoke->header.index, expected.header.index);
    EXPECT_EQ(spoke->cells, expected.cells);
    ++checked;
  };
  for (int i = 0; i < 100; ++i) {
    host.publish();
    client.receive_spokes_until(host.published() - 1);
  }
  EXPECT_EQ(checked, 100 * FakeHost::kSectorSpokes);
}

TEST_P(Streaming, SettingsAndOwnShipComeOnSubscription) {
  FakeHost host(2);
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  client.subscribe(1);
  const auto settings = client.receive();
  ASSERT_TRUE(settings && settings->has_settings());
  EXPECT_EQ(settings->settings().radar(), 1u);
  EXPECT_EQ(settings->settings().gain(), 50);
  const auto ship = client.receive();
  ASSERT_TRUE(ship && ship->has_own_ship());
  EXPECT_EQ(ship->own_ship().name(), "ship of radar 1");
}

TEST_P(Streaming, OwnShipKeepsComingWithoutSpokes) {
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  client.subscribe();
  for (int ships = 0; ships < 2;) {
    const auto message = client.receive();
    ASSERT_TRUE(message);
    if (message->has_own_ship()) ++ships;
  }
}

TEST_P(Streaming, OwnShipAloneComesTenTimesASecond) {
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  wire::ClientMessage ask = subscribe_message(1, 0);
  ask.mutable_subscribe()->set_no_spokes(true);
  ask.mutable_subscribe()->set_own_ship_hz(10);
  client.send(ask);
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  const auto begin = std::chrono::steady_clock::now();
  for (int ships = 0; ships < 12;) {
    host.publish();
    const auto message = client.receive();
    ASSERT_TRUE(message);
    EXPECT_FALSE(message->has_spoke());
    if (message->has_own_ship()) ++ships;
  }
  const auto passed = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(passed, std::chrono::milliseconds(900)) << "a bounded rate";
  EXPECT_LT(passed, std::chrono::seconds(9)) << "and not one a second";
}

TEST_P(Streaming, AllConsolesHearOfAChangeByOneOfThem) {
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient one = connect(server);
  TestClient other = connect(server);
  one.subscribe();
  other.subscribe();
  one.send(set_gain_message(3, 0, 62));
  EXPECT_EQ(one.receive_reply().code(), wire::Reply::OK);
  for (double gain = 0; gain != 62;) {
    const auto message = other.receive();
    ASSERT_TRUE(message);
    if (message->has_settings()) gain = message->settings().gain();
  }
}

TEST_P(Streaming, RequestsAreAnsweredInOrderWithTheirNumber) {
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  client.send(set_gain_message(11, 0, 101));
  client.send(set_gain_message(12, 0, 10));
  client.send(subscribe_message(13, 99));
  wire::Reply reply = client.receive_reply();
  EXPECT_EQ(reply.request(), 11u);
  EXPECT_EQ(reply.code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(reply.text(), "gain must be 0 to 100");
  reply = client.receive_reply();
  EXPECT_EQ(reply.request(), 12u);
  EXPECT_EQ(reply.code(), wire::Reply::OK);
  reply = client.receive_reply();
  EXPECT_EQ(reply.request(), 13u);
  EXPECT_EQ(reply.code(), wire::Reply::UNKNOWN);
  EXPECT_NE(reply.text().find("radar 99"), std::string::npos);
}

TEST_P(Streaming, EachRadarGoesToItsOwnSubscribersAndASecondSubscriptionReplacesTheFirst) {
  FakeHost host(2);
  NetServer server(host, test_config(), {});
  server.start();
  TestClient client = connect(server);
  client.subscribe(0);
  host.publish(1);
  host.publish(0);
  std::vector<std::uint32_t> radars;
  client.on_message = [&](const wire::ServerMessage& message) {
    if (message.has_spoke()) radars.push_back(message.spoke().radar());
  };
  client.receive_spokes_until(15);
  EXPECT_EQ(radars, std::vector<std::uint32_t>(16, 0));
  client.subscribe(1);
  radars.clear();
  host.publish(0);
  host.publish(1);
  client.receive_spokes_until(31);
  EXPECT_EQ(radars, std::vector<std::uint32_t>(16, 1));
}

TEST(StreamingToMany, SixteenSessionsCostOneEncoding) {
  constexpr int kSectors = 50;
  FakeHost host;
  NetServer server(host, test_config(), {});
  server.start();
  host.publish();
  EXPECT_EQ(host.encoded(kNativeFormat), 0u) << "nobody is there";
  std::vector<TestClient> clients;
  for (int i = 0; i < 8; ++i) {
    clients.emplace_back(server.tcp_port());
    clients.push_back(TestClient::over_websocket(server.http_port()));
  }
  for (TestClient& client : clients) client.subscribe();
  const std::uint64_t first = host.published();
  for (int i = 0; i < kSectors; ++i) {
    host.publish();
    for (TestClient& client : clients) client.receive_spokes_until(host.published() - 1);
  }
  EXPECT_EQ(host.encoded(kNativeFormat), host.published() - first);
  EXPECT_EQ(host.encoded(kSignalkFormat), 0u);
  const wire::Status status = clients.front().get_status();
  ASSERT_EQ(status.clients_size(), 16);
  for (const wire::ClientStatus& client : status.clients()) {
    EXPECT_EQ(client.spokes_lost(), 0u) << client.transport();
  }
}

// One console stops reading; the publisher never waits for it, the other console loses nothing, and
// what the stalled one gets and what the server says it lost are all that was published.
TEST(StreamingToMany, AStalledReaderLosesExactlyWhatItIsToldItLost) {
  constexpr int kSectors = 1000;  // 16 MB: many times what sockets and ring hold
  FakeHost host(1, 8);
  NetServer server(host, test_config(), {});
  server.start();
  TestClient stalled(server.tcp_port(), 4096);
  TestClient reading(server.tcp_port());
  stalled.subscribe();
  reading.subscribe();
  TestClient::Received others;
  for (int i = 0; i < kSectors; ++i) {
    host.publish();
    const auto part = reading.receive_spokes_until(host.published() - 1);
    others.spokes += part.spokes;
    others.missing += part.missing;
  }
  EXPECT_EQ(others.spokes, host.published());
  EXPECT_EQ(others.missing, 0u);

  const auto received = stalled.receive_spokes_until(host.published() - 1);
  EXPECT_GT(received.missing, 0u);
  EXPECT_EQ(received.spokes + received.missing, host.published());
  const wire::Status status = stalled.get_status();
  ASSERT_EQ(status.clients_size(), 2);
  EXPECT_EQ(status.clients(0).spokes_lost(), received.missing);
  EXPECT_EQ(status.clients(0).spokes_sent(), received.spokes);
  EXPECT_EQ(status.clients(1).spokes_lost(), 0u);
  std::printf("stalled: %lu of %lu spokes received, %lu lost\n",
              static_cast<unsigned long>(received.spokes),
              static_cast<unsigned long>(host.published()),
              static_cast<unsigned long>(received.missing));
}

TEST(StreamingToMany, StopsWhileARadarPublishesAndClientsRead) {
  FakeHost host;
  auto server = std::make_unique<NetServer>(host, test_config(), std::span<const WebFile>());
  server->start();
  TestClient tcp(server->tcp_port());
  TestClient ws = TestClient::over_websocket(server->http_port());
  TestSocket idle_http(server->http_port());
  tcp.subscribe();
  ws.subscribe();
  std::atomic<bool> stop{false};
  std::thread radar([&] {
    while (!stop) host.publish();
  });
  ws.receive_spokes_until(0);
  server->stop();
  while (tcp.receive()) continue;
  EXPECT_TRUE(idle_http.receive().empty());
  server.reset();
  stop = true;
  radar.join();
}

}  // namespace
}  // namespace skerry::server
