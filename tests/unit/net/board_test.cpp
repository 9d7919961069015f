// Interface boards as the network serves them, without a board.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "server/net/native/board_requests.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

class Boards : public testing::Test {
 protected:
  Boards() {
    host_.board = std::make_shared<FakeBoard>();
    server_.emplace(host_, test_config(), std::span<const WebFile>{});
    server_->start();
  }
  ~Boards() override { server_->stop(); }

  wire::ClientMessage fifo(std::uint32_t request, std::uint32_t count) {
    wire::ClientMessage message;
    message.set_request(request);
    message.mutable_board_fifo()->set_count(count);
    return message;
  }
  wire::ClientMessage stream(std::uint32_t request, wire::BoardStream::Kind kind) {
    wire::ClientMessage message;
    message.set_request(request);
    message.mutable_board_stream()->set_kind(kind);
    return message;
  }
  std::uint64_t lost() {
    std::uint64_t most = 0;
    const wire::Status status = server_->status();
    for (const auto& client : status.clients()) most = std::max(most, client.spokes_lost());
    return most;
  }

  FakeHost host_;
  FakeBoard& board() { return *host_.board; }
  std::optional<NetServer> server_;
};

TEST_F(Boards, AnswersStandRightBeforeTheirRepliesInTheOrderOfTheRequests) {
  for (const bool websocket : {false, true}) {
    TestClient asks = websocket ? TestClient::over_websocket(server_->http_port())
                                : TestClient(server_->tcp_port());
    asks.receive_hello();
    asks.send(stream(1, wire::BoardStream::RECORDS));
    ASSERT_EQ(asks.receive_reply().code(), wire::Reply::OK);
    Bytes requests;
    for (std::uint32_t i = 0; i < 20; ++i) {
      const Bytes frame = frame_of(fifo(100 + i, 1 + i));
      requests.insert(requests.end(), frame.begin(), frame.end());
    }
    asks.send_bytes(requests);
    for (std::uint32_t i = 0; i < 20; ++i) {
      board().publish(3);
      std::optional<wire::ServerMessage> before, message = asks.receive();
      while (message && !message->has_reply()) {
        before = std::move(message);
        message = asks.receive();
      }
      ASSERT_TRUE(before && message);
      EXPECT_EQ(message->reply().request(), 100 + i);
      EXPECT_EQ(before->board_records().count(), 1 + i);
      EXPECT_EQ(before->board_records().first_sequence(), 1'000'000u);
    }
  }
}

TEST_F(Boards, AClientHasOneStreamOfRecordsBesidesItsSpokes) {
  TestClient client(server_->tcp_port());
  client.receive_hello();
  client.subscribe();
  client.send(stream(1, wire::BoardStream::SIGNALS));
  client.receive_reply();
  client.send(stream(2, wire::BoardStream::RECORDS));
  client.receive_reply();
  EXPECT_FALSE(board().signals.has_readers());
  board().publish(5);
  host_.publish();
  std::uint64_t records = 0, spokes = 0;
  while (records < 5 || spokes < FakeHost::kSectorSpokes) {
    const auto message = client.receive();
    ASSERT_TRUE(message);
    records += message->board_records().count();
    if (message->has_spoke()) ++spokes;
  }
  client.send(stream(3, wire::BoardStream::NONE));
  client.receive_reply();
  EXPECT_FALSE(board().records.has_readers());
}

TEST_F(Boards, WhatASlowClientMissesIsCountedAndComesInWholeRecords) {
  TestClient client(server_->tcp_port(), 4096);
  client.receive_hello();
  client.send(stream(1, wire::BoardStream::RECORDS));
  client.receive_reply();
  // 16 MB, of which the ring holds one and the kernel a few.
  for (int i = 0; i < 250; ++i) board().publish(1000);
  std::uint64_t received = 0, missing = 0, next = 0;
  while (next < board().published) {
    const auto message = client.receive();
    ASSERT_TRUE(message);
    if (!message->has_board_records()) continue;
    const wire::BoardRecords& records = message->board_records();
    ASSERT_GE(records.first_sequence(), next);
    ASSERT_EQ(records.records().size(), records.count() * FakeBoard::kRecordBytes);
    missing += records.first_sequence() - next;
    next = records.first_sequence() + records.count();
    received += records.count();
  }
  EXPECT_EQ(received + missing, board().published);
  EXPECT_GT(missing, 0u);
  EXPECT_TRUE(wait_until([&] { return lost() == missing; }));
}

TEST_F(Boards, TheRingIsLentAsLongAsTheConnectionLives) {
  const auto borrowed = [&] { return board().lease.use_count() > 1; };
  wire::ClientMessage ask;
  ask.mutable_board_ring();
  {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    client.send(ask);
    EXPECT_EQ(client.receive()->board().ring_name(), "/ring");
    EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
    EXPECT_TRUE(borrowed());
    client.socket().reset();
  }
  EXPECT_TRUE(wait_until([&] { return !borrowed(); }));
  board().has_memory = false;
  TestClient refused(server_->tcp_port());
  refused.send(ask);
  const wire::Reply reply = refused.receive_reply();
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.text(), "no memory left");
}

TEST(BoardDatagrams, OfARadarWithoutABoardAreRefused) {
  FakeHost host;
  NetConfig config = test_config();
  config.streams = {{.to = {.port = 4000}, .shape = BoardRecords{}}};
  try {
    NetServer(host, config, {});
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "sweeps datagrams of radar 0 to 127.0.0.1 port 4000: that radar has no interface "
                 "board");
  }
}

}  // namespace
}  // namespace skerry::server
