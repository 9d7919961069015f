// Clients that send nonsense, vanish, flood or are too many.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "server/net/common/connection_table.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

class BadClients : public testing::Test {
 protected:
  void start(NetConfig config = test_config()) {
    server_ = std::make_unique<NetServer>(host_, std::move(config), std::span<const WebFile>());
    server_->start();
  }
  // Expects that the next reply says why, and that the server then closes.
  static void expect_farewell(TestClient& client, wire::Reply::Code code, const std::string& part) {
    const wire::Reply reply = client.receive_reply();
    EXPECT_EQ(reply.code(), code);
    EXPECT_NE(reply.text().find(part), std::string::npos) << reply.text();
    EXPECT_FALSE(client.receive());
  }
  void expect_server_goes_on() {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    client.subscribe();
    const std::uint64_t first = host_.published();
    host_.publish();
    const auto received = client.receive_spokes_until(first + FakeHost::kSectorSpokes - 1);
    EXPECT_EQ(received.spokes, FakeHost::kSectorSpokes);
  }

  FakeHost host_;
  std::unique_ptr<NetServer> server_;
};

TEST_F(BadClients, AMalformedMessageIsAnsweredAndTheConnectionClosed) {
  start();
  for (const bool websocket : {false, true}) {
    TestClient client = websocket ? TestClient::over_websocket(server_->http_port())
                                  : TestClient(server_->tcp_port());
    client.send_bytes({3, 0xff, 0xff, 0xff});
    expect_farewell(client, wire::Reply::MALFORMED, "no ClientMessage");
  }
  EXPECT_EQ(server_->status().errors().at("tcp malformed request"), 1u);
  EXPECT_EQ(server_->status().errors().at("websocket malformed request"), 1u);
  expect_server_goes_on();
}

TEST_F(BadClients, RequestsBeforeTheMalformedOneAreStillAnswered) {
  start();
  TestClient client(server_->tcp_port());
  Bytes bytes = frame_of(set_gain_message(5, 0, 20));
  bytes.insert(bytes.end(), {1, 0xff});
  client.send_bytes(bytes);
  EXPECT_EQ(client.receive_reply().request(), 5u);
  expect_farewell(client, wire::Reply::MALFORMED, "");
}

TEST_F(BadClients, AMessageThatIsTooLongIsRefusedBeforeItIsRead) {
  start();
  TestClient client(server_->tcp_port());
  client.send_bytes({0x81, 0x20});  // 4097 as a varint
  expect_farewell(client, wire::Reply::MALFORMED, "4097");
  TestClient greedy(server_->tcp_port());
  greedy.send_bytes({0xff, 0xff, 0xff, 0xff, 0xff, 0xff});
  expect_farewell(greedy, wire::Reply::MALFORMED, "");
  expect_server_goes_on();
}

TEST_F(BadClients, AMessageOfNoKnownKindIsMalformed) {
  start();
  TestClient client(server_->tcp_port());
  client.send_bytes({0});
  expect_farewell(client, wire::Reply::MALFORMED, "subscribe, set, get_status");
}

TEST_F(BadClients, ATextMessageOnAWebSocketIsMalformed) {
  start();
  TestClient client = TestClient::over_websocket(server_->http_port());
  client.socket().send(Bytes{0x81, 0x82, 0, 0, 0, 0, 'h', 'i'});
  expect_farewell(client, wire::Reply::MALFORMED, "text");
}

TEST_F(BadClients, GarbageEndsWithAReplyOrAClosedConnectionAndNeverWorse) {
  start();
  std::mt19937 random(20261121);
  for (int i = 0; i < 200; ++i) {
    Bytes garbage(1 + random() % 300);
    for (auto& byte : garbage) byte = static_cast<std::uint8_t>(random());
    TestClient client(server_->tcp_port());
    client.send_bytes(garbage);
    client.socket().finish_sending();
    while (client.receive()) continue;
  }
  expect_server_goes_on();
}

TEST_F(BadClients, TextThatIsNoUtf8IsMalformed) {
  start();
  wire::ClientMessage message = set_gain_message(1, 0, 5);
  message.mutable_set()->set_token("xx");
  Bytes bytes = frame_of(message);
  bytes[bytes.size() - 1] = bytes[bytes.size() - 2] = 0xff;
  TestClient client(server_->tcp_port());
  client.send_bytes(bytes);
  expect_farewell(client, wire::Reply::MALFORMED, "no ClientMessage");
}

// Every place within two requests at which a client can vanish, politely and by reset.
TEST_F(BadClients, ADisconnectAtEachByteLeavesNothingBehind) {
  start();
  Bytes bytes = frame_of(subscribe_message(1, 0));
  const Bytes second = frame_of(set_gain_message(2, 0, 33));
  bytes.insert(bytes.end(), second.begin(), second.end());
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    for (const bool websocket : {false, true}) {
      for (const bool with_reset : {false, true}) {
        TestClient client = websocket ? TestClient::over_websocket(server_->http_port())
                                      : TestClient(server_->tcp_port());
        if (cut > 0) client.send_bytes(Bytes(bytes.begin(), bytes.begin() + cut));
        if (with_reset) client.socket().reset();
      }
    }
    host_.publish();
  }
  EXPECT_TRUE(wait_until([this] { return server_->status().clients_size() == 0; }));
  expect_server_goes_on();
}

// Half a WebSocket handshake, or half a frame header, at each byte.
TEST_F(BadClients, ADisconnectWithinTheUpgradeLeavesNothingBehind) {
  start();
  const std::string request =
      "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n\x82\x85";
  for (std::size_t cut = 0; cut <= request.size(); ++cut) {
    TestSocket socket(server_->http_port());
    socket.send(request.substr(0, cut));
    if (cut % 2 == 0) socket.reset();
  }
  EXPECT_TRUE(wait_until([this] { return server_->status().clients_size() == 0; }));
  expect_server_goes_on();
}

TEST_F(BadClients, ManyRequestsAtOnceAreAllAnsweredInOrder) {
  start();
  TestClient client(server_->tcp_port());
  constexpr std::uint32_t kRequests = 1000;
  Bytes bytes;
  for (std::uint32_t i = 0; i < kRequests; ++i) {
    const Bytes one = frame_of(get_status_message(i));
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  client.send_bytes(bytes);
  for (std::uint32_t i = 0; i < kRequests; ++i) ASSERT_EQ(client.receive_reply().request(), i);
}

TEST_F(BadClients, AFloodWithoutReadingIsClosed) {
  NetConfig config = test_config();
  config.reply_timeout = std::chrono::milliseconds(100);
  start(config);
  TestClient client(server_->tcp_port(), 4096);
  Bytes flood;
  for (int i = 0; i < 1000; ++i) {
    const Bytes one = frame_of(get_status_message(1));
    flood.insert(flood.end(), one.begin(), one.end());
  }
  while (client.socket().send(flood)) continue;  // ends only because the server closes
  EXPECT_EQ(server_->status().errors().at("tcp replies not read"), 1u);
  expect_server_goes_on();
}

TEST_F(BadClients, OneConnectionTooManyIsToldSo) {
  NetConfig config = test_config();
  config.max_connections = 2;
  start(config);
  auto one = std::make_unique<TestClient>(server_->tcp_port());
  TestClient two = TestClient::over_websocket(server_->http_port());
  one->receive_hello();
  two.receive_hello();
  TestClient three(server_->tcp_port());
  expect_farewell(three, wire::Reply::REFUSED, "all 2 connections");
  EXPECT_TRUE(http_get(server_->http_port(), "/").starts_with("HTTP/1.1 503"));
  one.reset();
  EXPECT_TRUE(wait_until([this] {
    TestClient again(server_->tcp_port());
    return again.receive()->has_hello();
  }));
}

TEST_F(BadClients, AHundredRefusedConnectionsThatStayOpenDoNotPileUp) {
  NetConfig config = test_config();
  config.max_connections = 1;
  start(config);
  TestClient served(server_->tcp_port());
  served.receive_hello();
  std::vector<std::unique_ptr<TestClient>> refused;
  for (int i = 0; i < 100; ++i) {
    refused.push_back(std::make_unique<TestClient>(server_->tcp_port()));
  }
  // Beyond the refusals that are held open, told in one packet.
  expect_farewell(*refused.back(), wire::Reply::REFUSED, "all 1 connections");
  EXPECT_EQ(served.get_status().clients_size(), 1 + static_cast<int>(PeerLimits{}.refusals));
}

}  // namespace
}  // namespace skerry::server
