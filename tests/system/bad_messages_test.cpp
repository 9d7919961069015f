// Strangers send anything to the running server.  It answers with an error, or with a closed
// connection, and for everybody else the next spoke.
#include <gtest/gtest.h>
#include <signal.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

using server::TestClient;
using server::TestSocket;

// Each test ends by asking the server, and a console that was there all the time, whether they
// noticed anything.
class BadMessages : public testing::Test {
 protected:
  void TearDown() override {
    const Witness::Seen seen = witness_.finish(kSmallSpokes);
    EXPECT_EQ(seen.error, "");
    EXPECT_EQ(seen.lost, 0u);
    EXPECT_GE(seen.received, kSmallSpokes);
  }

  TestClient connect(bool websocket) const {
    TestClient client = websocket ? TestClient::over_websocket(server_.http_port())
                                  : TestClient(server_.tcp_port());
    client.receive_hello();
    return client;
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("small.yaml", small_scenario())}};
  Witness witness_{server_, 0};
};

TEST_F(BadMessages, GetAnErrorReplyAndTheConnectionIsClosed) {
  const std::vector<std::pair<const char*, Bytes>> cases = {
      {"no protobuf", {3, 0xff, 0xff, 0xff}},
      {"no kind", {0}},
      {"a kind of the future", {3, 0x7a, 1, 0}},
      {"a length above the limit", {0x81, 0x20}},
      {"a length beyond 32 bits", {0xff, 0xff, 0xff, 0xff, 0xff, 0xff}},
      {"a length that is no varint", Bytes(16, 0xff)},
  };
  for (const bool websocket : {false, true}) {
    for (const auto& [what, bytes] : cases) {
      SCOPED_TRACE(std::string(what) + (websocket ? " over WebSocket" : " over TCP"));
      TestClient client = connect(websocket);
      client.send_bytes(bytes);
      const wire::Reply reply = client.receive_reply();
      EXPECT_EQ(reply.code(), wire::Reply::MALFORMED);
      EXPECT_EQ(reply.request(), 0u);
      EXPECT_FALSE(reply.text().empty());
      EXPECT_FALSE(client.receive()) << "the server did not close";
    }
  }
  client::SpokeClient observer = connected(server_);
  const auto status = observer.get_status(kAnswerTime);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->errors().at("tcp malformed request"), cases.size());
  EXPECT_EQ(status->errors().at("websocket malformed request"), cases.size());
}

TEST_F(BadMessages, ThatStopHalfWayEndWithTheConnection) {
  for (const bool websocket : {false, true}) {
    TestClient client = connect(websocket);
    client.send_bytes({10, 0x08, 1});  // 2 of 10 bytes
    client.socket().finish_sending();
    while (client.receive()) {
    }
    TestClient hasty = connect(websocket);
    hasty.subscribe();
    hasty.send_bytes({10});
    hasty.socket().reset();
  }
  client::SpokeClient observer = connected(server_);
  await_status(observer, [](const wire::Status& status) { return status.clients_size() == 2; });
}

TEST_F(BadMessages, OfRandomBytesDoNoHarm) {
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    Bytes bytes(1 + random() % 300);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    TestClient client = connect(round % 2 == 1);
    client.send_bytes(bytes);
    client.socket().finish_sending();
    while (client.receive()) {
    }
  }
}

TEST_F(BadMessages, MayFollowASubscription) {
  TestClient client = connect(false);
  client.subscribe();
  client.send_bytes({0});
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::MALFORMED);
  EXPECT_FALSE(client.receive());
}

TEST_F(BadMessages, OfHttpGetAnHttpErrorAndThePageIsStillServed) {
  const std::uint16_t port = server_.http_port();
  const auto first_line = [](const std::string& answer) {
    return answer.substr(0, answer.find('\r'));
  };
  EXPECT_NE(first_line(server::http_exchange(port, "garbage\r\n\r\n")).find(" 400 "),
            std::string::npos);
  EXPECT_NE(first_line(server::http_exchange(port, "GET / HTTP/1.1\r\nHost: localhost\r\nX: " +
                                                       std::string(64 * 1024, 'x') + "\r\n\r\n"))
                .find(" 431 "),
            std::string::npos);
  EXPECT_NE(first_line(server::http_get(port, "/../../etc/passwd")).find(" 400 "),
            std::string::npos);
  EXPECT_NE(first_line(server::http_get(port, "/nothing")).find(" 404 "), std::string::npos);
  std::mt19937 random(6);
  for (int round = 0; round < 50; ++round) {
    std::string bytes(1 + random() % 300, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    TestSocket socket(port);
    socket.send(bytes);
    socket.finish_sending();
    socket.receive_all();
  }
  EXPECT_NE(first_line(server::http_get(port, "/")).find(" 200 "), std::string::npos);
}

TEST_F(BadMessages, AClientKilledInMidStreamIsForgotten) {
  client::SpokeClient observer = connected(server_);
  const auto clients = [](int count) {
    return [count](const wire::Status& status) { return status.clients_size() == count; };
  };
  await_status(observer, clients(2));  // the witness and the observer
  {
    ChildProcess dump({skerry_program(), "dump", "--port", std::to_string(server_.tcp_port())});
    for (int line = 0; line < 50; ++line) ASSERT_TRUE(dump.read_line());
    await_status(observer, clients(3));
    dump.signal(SIGKILL);
    EXPECT_EQ(dump.wait().code, 128 + SIGKILL);
  }
  await_status(observer, clients(2));
}

}  // namespace
}  // namespace skerry::system_test
