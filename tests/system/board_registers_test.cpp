// The registers of a running server's boards over TCP: what they say, and what they refuse.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "protocol/board/registers.hpp"
#include "tests/system/board_kit.hpp"
#include "tests/system/receive.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

using board::Reg;
using server::TestClient;

wire::ClientMessage access_message(std::uint32_t radar,
                                   const std::vector<std::pair<std::uint32_t, int>>& operations) {
  wire::ClientMessage message;
  message.set_request(7);
  message.mutable_board_access()->set_radar(radar);
  for (const auto& [address, value] : operations) {
    wire::BoardOperation* const operation = message.mutable_board_access()->add_operations();
    operation->set_address(address);
    if (value >= 0) operation->set_write(static_cast<std::uint32_t>(value));
  }
  return message;
}

class BoardRegisters : public testing::Test {
 protected:
  // The board's answer; the reply after it must be OK.
  wire::BoardReply answer(const wire::ClientMessage& message) {
    wire::BoardReply board;
    client_.send(message);
    while (true) {
      const auto got = client_.receive();
      if (!got) throw std::runtime_error("the server closed");
      if (got->has_board()) board = got->board();
      if (!got->has_reply()) continue;
      EXPECT_EQ(got->reply().code(), wire::Reply::OK) << got->reply().text();
      EXPECT_EQ(got->reply().request(), 7u);
      return board;
    }
  }
  wire::Reply refusal(const wire::ClientMessage& message) {
    client_.send(message);
    return client_.receive_reply();
  }
  std::uint32_t value(Reg reg) {
    return answer(access_message(0, {{board::address_of(reg), -1}})).results(0).value();
  }

  TempFolder folder_;
  RunningServer server_{
      {"--scenario",
       folder_.write("boards.yaml", board_scenario("{sample_clock_mhz: 40, acp_per_turn: 2048, "
                                                   "channel_b: {source: S, detector: linear}}"))}};
  TestClient client_{server_.tcp_port()};
};

TEST_F(BoardRegisters, SayWhatTheBoardIsAndWhatTheScenarioGaveIt) {
  const wire::Hello hello = client_.receive_hello();
  for (const wire::RadarInfo& radar : hello.radars()) EXPECT_TRUE(radar.board());
  EXPECT_EQ(value(Reg::identity), board::kIdentity);
  EXPECT_EQ(value(Reg::version), board::kMapVersion);
  EXPECT_EQ(value(Reg::radar), 0u);
  EXPECT_EQ(value(Reg::sample_clock_hz), 40'000'000u);
  EXPECT_EQ(value(Reg::acp_per_turn), 2048u);
  EXPECT_EQ(value(Reg::source_a), 1u);
  EXPECT_EQ(value(Reg::source_b), 2u);
  const auto other = answer(access_message(
      2, {{board::address_of(Reg::radar), -1}, {board::address_of(Reg::source_a), -1}}));
  EXPECT_EQ(other.radar(), 2u);
  EXPECT_EQ(other.results(0).value(), 2u);
  EXPECT_EQ(other.results(1).value(), 3u);
}

TEST_F(BoardRegisters, AnswerWithTheBoardsErrorAndStayAsTheyWere) {
  const std::uint32_t prf = board::address_of(Reg::prf_millihertz);
  const auto reply =
      answer(access_message(0, {{prf, 900'000},                         // taken
                                {prf, 9},                               // out of range
                                {prf + 1, 1000},                        // misaligned
                                {board::address_of(Reg::identity), 1},  // read only
                                {0xFFC, 1},                             // there is none
                                {0xFFC, -1},
                                {prf + 2, -1},
                                {board::address_of(Reg::source_a), 3},  // the radar of another ship
                                {board::address_of(Reg::source_a), 40},  // no radar at all
                                {prf, -1},
                                {board::address_of(Reg::identity), -1},
                                {board::address_of(Reg::source_a), -1}}));
  const std::vector<wire::BoardError> errors = {wire::BOARD_OK,
                                                wire::BOARD_OUT_OF_RANGE,
                                                wire::BOARD_MISALIGNED,
                                                wire::BOARD_READ_ONLY,
                                                wire::BOARD_UNKNOWN_REGISTER,
                                                wire::BOARD_UNKNOWN_REGISTER,
                                                wire::BOARD_MISALIGNED,
                                                wire::BOARD_OUT_OF_RANGE,
                                                wire::BOARD_OUT_OF_RANGE,
                                                wire::BOARD_OK,
                                                wire::BOARD_OK,
                                                wire::BOARD_OK};
  ASSERT_EQ(reply.results_size(), static_cast<int>(errors.size()));
  for (int i = 0; i < reply.results_size(); ++i) {
    EXPECT_EQ(reply.results(i).error(), errors[static_cast<std::size_t>(i)]) << "operation " << i;
  }
  EXPECT_EQ(reply.results(9).value(), 900'000u);
  EXPECT_EQ(reply.results(10).value(), board::kIdentity);
  EXPECT_EQ(reply.results(11).value(), 1u);
}

TEST_F(BoardRegisters, RefuseRequestsThatMakeNoSense) {
  EXPECT_EQ(refusal(access_message(9, {{0, -1}})).code(), wire::Reply::UNKNOWN);
  const wire::Reply many =
      refusal(access_message(0, std::vector<std::pair<std::uint32_t, int>>(257, {0, -1})));
  EXPECT_EQ(many.code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(many.text(), "operations: 257 of them; allowed: at most 256");
  for (const std::uint32_t count : {0u, 65u}) {
    wire::ClientMessage fifo;
    fifo.mutable_board_fifo()->set_count(count);
    EXPECT_EQ(refusal(fifo).code(), wire::Reply::OUT_OF_RANGE) << count;
  }
  wire::ClientMessage stream;
  stream.mutable_board_stream()->set_kind(static_cast<wire::BoardStream::Kind>(9));
  EXPECT_EQ(refusal(stream).code(), wire::Reply::OUT_OF_RANGE);
  stream.mutable_board_stream()->set_kind(wire::BoardStream::RECORDS);
  stream.mutable_board_stream()->set_radar(3);
  EXPECT_EQ(refusal(stream).code(), wire::Reply::UNKNOWN);
  wire::ClientMessage ring;
  ring.mutable_board_ring()->set_radar(3);
  EXPECT_EQ(refusal(ring).code(), wire::Reply::UNKNOWN);
  EXPECT_EQ(value(Reg::identity), board::kIdentity) << "the connection lives";
}

TEST_F(BoardRegisters, GarbageInABoardsMessageClosesThatConnectionAlone) {
  Witness witness(server_, 0);
  const std::vector<Bytes> cases = {
      {4, 0x2a, 2, 0xff, 0xff},        // board_access of no protobuf
      {6, 0x2a, 4, 0x12, 2, 0xff, 1},  // an operation of no protobuf
      {4, 0x32, 9, 8, 0},              // board_stream longer than its frame
      {3, 0x3a, 1, 0x08},              // board_fifo that ends in a field
      {4, 0x42, 2, 0x12, 9},           // board_ring with a token longer than itself
  };
  for (const Bytes& bytes : cases) {
    TestClient stranger(server_.tcp_port());
    stranger.receive_hello();
    stranger.send_bytes(bytes);
    EXPECT_EQ(stranger.receive_reply().code(), wire::Reply::MALFORMED);
    EXPECT_FALSE(stranger.receive()) << "the server did not close";
  }
  EXPECT_EQ(value(Reg::identity), board::kIdentity);
  const Witness::Seen seen = witness.finish(32);
  EXPECT_EQ(seen.error, "");
  EXPECT_EQ(seen.lost, 0u);
}

TEST_F(BoardRegisters, ThatContradictEachOtherSetTheFaultWithItsReasonUntilTheyDoNot) {
  client::BoardClient board = board_of(server_);
  begin_stream(board, client::BoardStreamKind::signals);
  const auto await_fault = [&](std::uint32_t kind) {
    await_record<board::Event>(board, [&](const board::Event& event) {
      return event.event == kind && event.faults == board::fault::config;
    });
  };
  EXPECT_EQ(write(board, Reg::decimation_a, 64), board::RegisterError::ok);
  EXPECT_EQ(read(board, Reg::faults) & board::fault::config, board::fault::config);
  await_fault(board::event::fault_raised);
  EXPECT_EQ(write(board, Reg::decimation_a, 1), board::RegisterError::ok);
  EXPECT_EQ(read(board, Reg::faults) & board::fault::config, 0u);
  await_fault(board::event::fault_cleared);

  EXPECT_EQ(write(board, Reg::fifo_depth, 1000), board::RegisterError::ok);
  await_fault(board::event::fault_raised);
  client::SpokeClient console = connected(server_);
  const auto status = console.get_status(kAnswerTime);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->radars(0).board().faults(), board::fault::config);
  EXPECT_EQ(status->radars(0).board().fault_reason(),
            "FIFO_DEPTH 1000 is below one sweep of 4096: SAMPLES_A 2048 + SAMPLES_B 2048");
  EXPECT_EQ(write(board, Reg::fifo_depth, 100'000), board::RegisterError::ok);
  await_fault(board::event::fault_cleared);
  const std::string log = server_.stop().err;
  EXPECT_NE(log.find("board of X: fault raised: config: FIFO_DEPTH 1000"), std::string::npos)
      << log;
  EXPECT_NE(log.find("board of X: fault cleared: config"), std::string::npos) << log;
}

}  // namespace
}  // namespace skerry::system_test
