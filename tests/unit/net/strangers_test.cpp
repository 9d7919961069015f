// What clients on other hosts can take from the operator and from each other, over sockets.
// 127.0.0.2 and 127.0.0.3 stand for other hosts.
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

constexpr const char* kStranger = "127.0.0.2";
constexpr const char* kAnother = "127.0.0.3";
constexpr const char* kToken = "secret";

wire::ClientMessage show_token(std::uint32_t request) {
  wire::ClientMessage message = subscribe_message(request, 0);
  message.mutable_subscribe()->set_token(kToken);
  return message;
}

wire::ClientMessage open_view(std::uint32_t request) {
  wire::ClientMessage message = show_token(request);
  message.mutable_subscribe()->set_new_view(true);
  return message;
}

class Strangers : public testing::Test {
 protected:
  static NetConfig config() {
    NetConfig config = test_config();
    config.foreign_addresses = {kStranger, kAnother};
    config.control_token = kToken;
    return config;
  }
  void start(NetConfig of = config()) {
    server_ = std::make_unique<NetServer>(host_, std::move(of), std::span<const WebFile>());
    server_->start();
  }
  std::unique_ptr<TestClient> native(const char* from = nullptr) {
    return std::make_unique<TestClient>(server_->tcp_port(), TestClient::kDefaultBuffer, from);
  }
  // The next message is a refusal that says so, and the server then closes.
  static void expect_refused(TestClient& client, const std::string& part) {
    const auto message = client.receive();
    ASSERT_TRUE(message && message->has_reply()) << "closed without a word, or Hello";
    EXPECT_EQ(message->reply().code(), wire::Reply::REFUSED);
    EXPECT_NE(message->reply().text().find(part), std::string::npos) << message->reply().text();
    EXPECT_FALSE(client.receive());
  }
  std::string status_over_http(const char* from, const std::string& header = "") {
    return http_exchange(
        server_->http_port(),
        "GET /status HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + header + "\r\n", from);
  }

  FakeHost host_;
  std::unique_ptr<NetServer> server_;
};

TEST_F(Strangers, ManySilentConnectionsOfOneLockNobodyOut) {
  start();
  std::vector<std::unique_ptr<TestClient>> flood;
  for (int i = 0; i < 300; ++i) flood.push_back(native(kStranger));
  native()->receive_hello();
  EXPECT_TRUE(http_get(server_->http_port(), "/status").starts_with("HTTP/1.1 200 "));
  native(kAnother)->receive_hello();
  expect_refused(*flood.back(), "127.0.0.2 has 64 connections");
  const std::string answer = http_get(server_->http_port(), "/status", kStranger);
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503 ")) << answer;
  EXPECT_NE(answer.find("127.0.0.2 has 64 connections"), std::string::npos) << answer;
}

TEST_F(Strangers, WithTheTokenOneGetsInThoughThePlacesAreTaken) {
  NetConfig few = config();
  few.max_connections = 40;  // 4 in reserve, one lent at a time; 10 of a peer
  start(few);
  std::vector<std::unique_ptr<TestClient>> flood;
  for (int i = 0; i < 10; ++i) {
    flood.push_back(native(kStranger));
    flood.back()->receive_hello();
  }
  const std::string authorization = std::string("Authorization: Bearer ") + kToken + "\r\n";
  EXPECT_TRUE(status_over_http(kStranger).starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(status_over_http(kStranger, authorization).starts_with("HTTP/1.1 200 "));
  const auto trusted = native(kStranger);
  trusted->receive_hello();
  trusted->send(show_token(1));
  EXPECT_EQ(trusted->receive_reply().code(), wire::Reply::OK);
  const auto without = native(kStranger);
  without->receive_hello();
  without->send(subscribe_message(1, 0));
  expect_refused(*without, "without the control token");
}

TEST_F(Strangers, ANativeConnectionThatAsksForNothingIsToldSoAndEnds) {
  NetConfig hasty = config();
  hasty.limits.silent_time = std::chrono::milliseconds(1000);
  start(hasty);
  const auto asks = native(), silent = native(), half = native(kStranger),
             looks = native(kStranger);
  TestClient browser = TestClient::over_websocket(server_->http_port(), kStranger);
  asks->subscribe();
  looks->get_status();
  half->send_bytes({0x20, 0x08});
  for (TestClient* client : {silent.get(), half.get(), &browser}) {
    client->receive_hello();
    expect_refused(*client, "nothing was asked for in 1 s");
  }
  EXPECT_GE(asks->get_status().clients_size(), 2) << "those who asked for something stay";
  looks->get_status();
}

TEST_F(Strangers, APeerThatNeverReadsEndsAndOthersGoOn) {
  NetConfig hasty = config();
  hasty.limits.unread_time = std::chrono::milliseconds(300);
  start(hasty);
  TestClient deaf(server_->tcp_port(), 4096, kStranger);
  deaf.subscribe();
  const auto reads = native();
  reads->subscribe();
  EXPECT_TRUE(wait_until([&] {
    host_.publish();
    reads->receive_spokes_until(host_.published() - 1);
    return server_->status().errors().contains("tcp does not read");
  }));
  EXPECT_EQ(reads->get_status().clients_size(), 1);
}

TEST_F(Strangers, AreNotToldOfFoldersAndOfOthersAddresses) {
  start();
  const auto known = native();
  known->receive_hello();
  const auto stranger = native(kStranger);
  stranger->receive_hello();
  const wire::Status told = stranger->get_status();
  EXPECT_EQ(told.clients_size(), 2);
  for (const wire::ClientStatus& client : told.clients()) EXPECT_EQ(client.peer(), "");
  EXPECT_TRUE(known->get_status().clients(0).peer().starts_with("127.0.0.1:"));
  EXPECT_EQ(status_over_http(kStranger).find("127.0.0."), std::string::npos);
  EXPECT_NE(status_over_http(nullptr).find("127.0.0.1:"), std::string::npos);
  const std::string authorization = std::string("Authorization: Bearer ") + kToken + "\r\n";
  EXPECT_NE(status_over_http(kStranger, authorization).find("127.0.0.1:"), std::string::npos);
  stranger->send(show_token(1));
  EXPECT_EQ(stranger->receive_reply().code(), wire::Reply::OK);
  EXPECT_TRUE(stranger->get_status().clients(0).peer().starts_with("127.0.0.1:"));
}

TEST_F(Strangers, StartABoardsStreamOnlyAfterTheTokenWasShown) {
  host_.board = std::make_shared<FakeBoard>();
  start();
  wire::ClientMessage stream;
  stream.set_request(5);
  stream.mutable_board_stream()->set_kind(wire::BoardStream::RECORDS);
  const auto own = native();
  own->send(stream);
  EXPECT_EQ(own->receive_reply().code(), wire::Reply::OK);
  const auto stranger = native(kStranger);
  stranger->send(stream);
  const wire::Reply refused = stranger->receive_reply();
  EXPECT_EQ(refused.code(), wire::Reply::REFUSED);
  EXPECT_NE(refused.text().find("control token"), std::string::npos) << refused.text();
  wire::ClientMessage sign_in;
  sign_in.mutable_sign_in()->set_token(kToken);
  stranger->send(sign_in);
  EXPECT_EQ(stranger->receive_reply().code(), wire::Reply::OK);
  stranger->send(stream);
  EXPECT_EQ(stranger->receive_reply().code(), wire::Reply::OK);
}

TEST_F(Strangers, OneLeavesAViewOfARadarForOthers) {
  NetConfig few = config();
  few.limits.views_of_peer = 1;  // FakeHost has two besides the shared one
  start(few);
  const auto first = native(kStranger), second = native(kStranger), other = native(kAnother);
  first->send(open_view(1));
  EXPECT_EQ(first->receive_reply().code(), wire::Reply::OK);
  second->send(open_view(1));
  const wire::Reply refused = second->receive_reply();
  EXPECT_EQ(refused.code(), wire::Reply::REFUSED);
  EXPECT_NE(refused.text().find("127.0.0.2 has opened 1 views of radar 0"), std::string::npos)
      << refused.text();
  other->send(open_view(1));
  EXPECT_EQ(other->receive_reply().code(), wire::Reply::OK);
}

TEST_F(Strangers, TogetherTheyLeaveAViewForTheOwnHost) {
  NetConfig few = config();
  few.limits.views_of_token = 1;
  start(few);
  const auto first = native(kStranger), other = native(kAnother), own = native();
  first->send(open_view(1));
  EXPECT_EQ(first->receive_reply().code(), wire::Reply::OK);
  other->send(open_view(1));
  EXPECT_EQ(other->receive_reply().code(), wire::Reply::REFUSED);
  own->send(open_view(1));
  EXPECT_EQ(own->receive_reply().code(), wire::Reply::OK);
}

TEST_F(Strangers, OnesFloodOfChangesIsRefusedAndTheOperatorsPass) {
  NetConfig few = config();
  few.limits.changes_per_second = 0.001;
  few.limits.changes_burst = 50;
  start(few);
  const auto flood = native(kStranger);
  Bytes bytes;
  for (std::uint32_t i = 0; i < 200; ++i) {
    wire::ClientMessage message = set_gain_message(i, 0, 20);
    message.mutable_set()->set_token(kToken);
    const Bytes one = frame_of(message);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  flood->send_bytes(bytes);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const wire::Reply reply = flood->receive_reply();
    ASSERT_EQ(reply.request(), i);
    ASSERT_EQ(reply.code(), i < 50 ? wire::Reply::OK : wire::Reply::REFUSED) << i;
    if (i < 50) continue;
    ASSERT_NE(reply.text().find("too many changes from 127.0.0.2: the limit is 0.001 a second"),
              std::string::npos)
        << reply.text();
  }
  EXPECT_EQ(server_->status().errors().at("too many changes"), 150u);
  const auto own = native();
  own->send(set_gain_message(1, 0, 30));
  EXPECT_EQ(own->receive_reply().code(), wire::Reply::OK);
  own->get_status();
  EXPECT_EQ(host_.settings(0, 0).gain(), 30);
}

}  // namespace
}  // namespace skerry::server
