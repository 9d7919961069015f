// Records of a running server's boards as clients get them, over TCP and UDP.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/datagram.hpp"
#include "tests/system/board_kit.hpp"
#include "tests/system/receive.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::system_test {
namespace {

using board::Reg;
using client::BoardClient;
using client::BoardStreamKind;

class BoardStream : public testing::Test {
 protected:
  RunningServer& start(const std::string& board = "{}", const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"--scenario",
                                          folder_.write("boards.yaml", board_scenario(board))};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return server_.emplace(arguments);
  }
  TempFolder folder_;
  std::optional<RunningServer> server_;
};

TEST_F(BoardStream, SweepsComeInOrderWhileTheSpokesGoOn) {
  start();
  Witness console(*server_, 0);
  BoardClient board = board_of(*server_);
  begin_stream(board, BoardStreamKind::records);
  std::optional<board::Sweep> before;
  double turned = 0.0;
  for (int i = 0; i < 600; ++i) {
    board::Sweep sweep = next_sweep(board);
    ASSERT_EQ(sweep.samples[0].size(), 2048u);
    ASSERT_TRUE(sweep.samples[1].empty());
    ASSERT_EQ(sweep.meta.sample_clock_hz, 20'000'000u);
    // There is no azimuth until the first ACPs have come.
    if (before && before->meta.acp_period > 0 &&
        sweep.meta.trigger_count == before->meta.trigger_count + 1) {
      ASSERT_EQ(sweep.meta.trigger_tick - before->meta.trigger_tick,
                20'000'000'000u / sweep.meta.prf_millihertz);
      const double turn = board::azimuth_turns(sweep.meta) - board::azimuth_turns(before->meta);
      ASSERT_NEAR(turn - std::floor(turn), 0.2 / (sweep.meta.prf_millihertz * 1e-3), 1e-5)
          << "trigger " << sweep.meta.trigger_count;
      turned += turn - std::floor(turn);
    }
    before = std::move(sweep);
  }
  EXPECT_GT(turned, 0.02);
  const Witness::Seen seen = console.finish(64);
  EXPECT_EQ(seen.error, "");
  EXPECT_EQ(seen.lost, 0u);
}

TEST_F(BoardStream, TwoBoardsOfOneShipSendAtOnceEachItsOwn) {
  start();
  BoardClient first = board_of(*server_, 0), second = board_of(*server_, 1);
  begin_stream(first, BoardStreamKind::records);
  begin_stream(second, BoardStreamKind::records);
  std::optional<board::Sweep> a, b;
  for (int i = 0; i < 100; ++i) {
    a = next_sweep(first);
    b = next_sweep(second);
    ASSERT_EQ(a->meta.radar, 0u);
    ASSERT_EQ(b->meta.radar, 1u);
  }
  EXPECT_NE(a->samples[0], b->samples[0]) << "each has noise of its own";
}

TEST_F(BoardStream, InjectedFaultsAreSeenInStreamAndLogAndPass) {
  start("{acp_per_turn: 360, rotation_rpm: 60}");
  BoardClient board = board_of(*server_);
  begin_stream(board, BoardStreamKind::signals);
  const auto await_fault = [&](std::uint32_t kind, std::uint32_t fault) {
    await_record<board::Event>(board, [&](const board::Event& event) {
      return event.event == kind && (event.faults & fault) != 0;
    });
  };
  const std::vector<std::pair<Reg, std::uint32_t>> faults = {
      {Reg::inject_missing_acp, board::fault::acp_missing},
      {Reg::inject_extra_acp, board::fault::acp_extra},
      {Reg::inject_missing_arp, board::fault::arp_missing},
      {Reg::inject_stall_ms, board::fault::stalled}};
  // The first whole turn after the start is behind.
  for (int arps = 0; arps < 2; ++arps) {
    await_record<board::Event>(
        board, [](const board::Event& event) { return event.event == board::event::arp; });
  }
  for (const auto& [reg, fault] : faults) {
    ASSERT_EQ(write(board, reg, reg == Reg::inject_stall_ms ? 100 : 1), board::RegisterError::ok);
    await_fault(board::event::fault_raised, fault);
    await_fault(board::event::fault_cleared, fault);
  }
  EXPECT_EQ(board.records_lost(), 0u);
  const std::string log = server_->stop().err;
  for (const char* fault : {"acp_missing", "acp_extra", "arp_missing", "stalled"}) {
    for (const char* what : {"fault raised: ", "fault cleared: "}) {
      EXPECT_NE(log.find("board of X: " + std::string(what) + fault), std::string::npos)
          << what << fault << "\n"
          << log;
    }
  }
}

TEST_F(BoardStream, AClientThatReadsTooSlowlyLosesRecordsAndNeverGetsWrongOnes) {
  start(
      "{sample_clock_mhz: 125, pulse: 1, prf_hz: 4000, "
      "channel_a: {samples: 16384, bits: 14, test: ramp}}");
  // A small window, so that what is not read stays in the server.
  server::TestClient slow(server_->tcp_port(), 65536);
  wire::ClientMessage ask;
  ask.set_request(1);
  ask.mutable_board_stream()->set_kind(wire::BoardStream::RECORDS);
  slow.send(ask);
  ASSERT_EQ(slow.receive_reply().code(), wire::Reply::OK);
  // More than ring and kernel hold.
  client::SpokeClient observer = connected(*server_);
  await_status(observer,
               [](const wire::Status& s) { return s.radars(0).board().records() > 4000; });

  std::optional<std::uint64_t> next;
  std::uint64_t gaps = 0;
  for (int sweeps = 0; gaps == 0 || sweeps < 500;) {
    const auto message = slow.receive();
    ASSERT_TRUE(message);
    if (!message->has_board_records()) continue;
    const std::string& text = message->board_records().records();
    std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(text.data()),
                                        text.size());
    while (!bytes.empty()) {
      const auto record = board::decode_record(bytes);
      ASSERT_TRUE(record) << record.error().text;
      bytes = bytes.subspan(record->size);
      if (next) gaps += record->sequence - *next;
      next = record->sequence + 1;
      const auto* const sweep = std::get_if<board::Sweep>(&record->record);
      if (sweep == nullptr) continue;
      ++sweeps;
      ASSERT_TRUE(is_ramp(*sweep)) << "trigger " << sweep->meta.trigger_count;
    }
  }
  EXPECT_GT(gaps, 0u);
  await_status(observer, [](const wire::Status& s) {
    return std::any_of(s.clients().begin(), s.clients().end(),
                       [](const wire::ClientStatus& each) { return each.spokes_lost() > 0; });
  });
}

TEST_F(BoardStream, TheFifoIsReadSweepBySweepAndCountsWhatIsNotThere) {
  start("{fifo: 32768, channel_a: {test: ramp}}");
  BoardClient board = board_of(*server_);
  const std::uint32_t run = board::control::run;
  ASSERT_EQ(write(board, Reg::control, run | board::control::fifo), board::RegisterError::ok);
  await_register(board, Reg::overruns_a, [](std::uint32_t lost) { return lost > 0; });
  await_register(board, Reg::faults_latched,
                 [](std::uint32_t faults) { return (faults & board::fault::overrun) != 0; });
  ASSERT_EQ(write(board, Reg::control, run), board::RegisterError::ok);
  await_register(board, Reg::fifo_level, [](std::uint32_t level) { return level == 16; });

  std::uint64_t before = 0;
  for (const std::uint32_t ask : {10u, 10u}) {
    const auto sweeps = board.read_fifo(ask, kAnswerTime);
    ASSERT_TRUE(sweeps);
    ASSERT_EQ(sweeps->size(), before == 0 ? 10u : 6u);
    for (const board::Sweep& sweep : *sweeps) {
      EXPECT_TRUE(is_ramp(sweep));
      EXPECT_GT(sweep.meta.trigger_count, before);
      before = sweep.meta.trigger_count;
    }
  }
  EXPECT_EQ(read(board, Reg::underruns_a), 4u);
  EXPECT_EQ(read(board, Reg::fifo_level), 0u);

  ASSERT_EQ(write(board, Reg::control, board::control::arm), board::RegisterError::ok);
  await_register(board, Reg::status,
                 [](std::uint32_t status) { return (status & board::status::captured) != 0; });
  const auto armed = board.read_fifo(1, kAnswerTime);
  ASSERT_TRUE(armed);
  ASSERT_EQ(armed->size(), 1u);
  EXPECT_EQ(armed->front().meta.trigger_count, read(board, Reg::latched_trigger_count_low));
}

// A socket of loopback that waits for datagrams.
class Receiver {
 public:
  Receiver() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const int buffer = 4 << 20;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
    const timeval patience{60, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0) {
      throw std::runtime_error("cannot bind a UDP socket");
    }
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~Receiver() { ::close(socket_); }
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;
  std::uint16_t port() const { return port_; }
  Bytes receive() {
    Bytes bytes(kMaxDatagram);
    const auto size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size < 0) throw std::runtime_error("no datagram came");
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

TEST_F(BoardStream, DatagramsHoldOneRecordEachAndAreReassembled) {
  Receiver receiver;
  // The longest record there is; as many datagrams as an Ethernet would need.
  const std::string config = folder_.write(
      "server.yaml", "sweeps:\n  - {address: 127.0.0.1, port: " + std::to_string(receiver.port()) +
                         ", max_datagram: 1472}\n");
  start(
      "{sample_clock_mhz: 125, prf_hz: 50, channel_a: {samples: 16384, test: ramp}, "
      "channel_b: {source: X, samples: 16384}}",
      {"--config", config});
  DatagramReassembler reassembler(DatagramKind::records);
  std::optional<std::uint64_t> next;
  for (int sweeps = 0; sweeps < 20;) {
    const auto body = reassembler.feed(receiver.receive());
    ASSERT_TRUE(body) << body.error().text;
    if (!body->has_value()) continue;
    const auto record = board::decode_record(**body);
    ASSERT_TRUE(record) << record.error().text;
    ASSERT_EQ(record->size, (*body)->size());
    if (next) {
      ASSERT_GE(record->sequence, *next);
    }
    next = record->sequence + 1;
    const auto* const sweep = std::get_if<board::Sweep>(&record->record);
    if (sweep == nullptr) continue;
    ++sweeps;
    ASSERT_EQ(record->size, board::kMaxRecordBytes);
    ASSERT_TRUE(is_ramp(*sweep));
  }
}

}  // namespace
}  // namespace skerry::system_test
