#include "clients/board/board_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/board/record_layout.hpp"
#include "tests/unit/clients/fake_board.hpp"

namespace skerry::client {
namespace {

using namespace std::chrono_literals;
using board::address_of;
using board::Reg;
using testing::HasSubstr;

constexpr auto kLong = 20s;    // never reached by a test that passes
constexpr auto kShort = 50ms;  // always reached

ClientResult<BoardClient> connect_to(const FakeServer& server, std::uint32_t radar = kBoardRadar) {
  return BoardClient::connect("127.0.0.1", server.port(), radar, kLong);
}
BoardClient connected(const FakeServer& server) {
  auto client = connect_to(server);
  if (!client) throw std::runtime_error(client.error().text);
  return std::move(client).value();
}
std::uint64_t trigger_of(const board::DecodedRecord& record) {
  const auto* sweep = std::get_if<board::Sweep>(&record.record);
  return sweep ? sweep->meta.trigger_count : ~std::uint64_t{0};
}

TEST(BoardClient, RefusesRadarsWithoutABoardAndNamesThoseWithOne) {
  FakeServer server([](FakePeer& peer) { FakeBoard().serve(peer); });
  const auto client = connect_to(server, 0);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().kind, ClientErrorKind::rejected);
  EXPECT_THAT(client.error().text, HasSubstr("radars 3"));
  FakeServer old([](FakePeer& peer) {
    peer.say_hello();
    peer.wait_until_client_leaves();
  });
  const auto none = connect_to(old, 0);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().text, HasSubstr("no radar of 127.0.0.1"));
}

TEST(BoardClient, ReadsAndWritesRegistersInTheirOrder) {
  FakeServer server([](FakePeer& peer) { FakeBoard().serve(peer); });
  BoardClient client = connected(server);
  const auto values = client.access({{.address = address_of(Reg::acp_per_turn), .write = 2048},
                                     {.address = address_of(Reg::acp_per_turn)},
                                     {.address = address_of(Reg::identity), .write = 1},
                                     {.address = address_of(Reg::acp_per_turn), .write = 1},
                                     {.address = 2},
                                     {.address = 0xFFC}},
                                    kLong);
  ASSERT_TRUE(values) << values.error().text;
  EXPECT_EQ((*values)[1].value, 2048u);
  std::vector<board::RegisterError> errors;
  for (const auto& value : *values) errors.push_back(value.error);
  using enum board::RegisterError;
  EXPECT_EQ(errors, (std::vector{ok, ok, read_only, out_of_range, misaligned, unknown_register}));
  const std::vector<BoardClient::Operation> too_many(BoardClient::kMaxOperations + 1);
  EXPECT_EQ(client.access(too_many, kLong).error().kind, ClientErrorKind::rejected);
  EXPECT_TRUE(client.access({{.address = 0}}, kLong)) << "the connection is as it was";
}

TEST(BoardClient, GivesTheRecordsOfTheStreamAndCountsWhatIsMissing) {
  FakeBoard board;
  board.on_stream = [](FakePeer& peer) {
    Bytes bytes;
    for (const std::uint64_t n : {10, 11, 14}) board::append_record(bytes, n, fake_sweep(n));
    send_records(peer, bytes, 3);
    send_record(peer, 20, board::Event{.radar = 3, .tick = 5, .event = board::event::arp});
  };
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
  for (const std::uint64_t n : {10, 11, 14}) {
    const auto record = client.next(kLong);
    ASSERT_TRUE(record && *record);
    EXPECT_EQ(std::get<board::Sweep>((*record)->record), fake_sweep(n));
    EXPECT_EQ((*record)->sequence, n);
  }
  EXPECT_EQ(client.records_lost(), 2u);
  const auto event = client.next(kLong);
  ASSERT_TRUE(event && *event);
  EXPECT_EQ(std::get<board::Event>((*event)->record).tick, 5u);
  EXPECT_EQ(client.records_lost(), 7u);
  const auto nothing = client.next(kShort);
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(*nothing);
}

TEST(BoardClient, KeepsTheStreamApartFromTheFifoWhileItAsks) {
  FakeServer server([](FakePeer& peer) {
    say_board_hello(peer);
    const auto stream = peer.receive();
    peer.answer(stream->request());
    const auto fifo = peer.receive();
    send_record(peer, 1, fake_sweep(1));
    send_record(peer, 2, fake_sweep(2));
    send_record(peer, 77, fake_sweep(7));
    peer.answer(fifo->request());
    peer.wait_until_client_leaves();
  });
  BoardClient client = connected(server);
  ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
  const auto sweeps = client.read_fifo(1, kLong);
  ASSERT_TRUE(sweeps) << sweeps.error().text;
  ASSERT_EQ(sweeps->size(), 1u);
  EXPECT_EQ(sweeps->front(), fake_sweep(7));
  EXPECT_EQ(trigger_of(**client.next(kLong)), 1u);
  EXPECT_EQ(trigger_of(**client.next(kLong)), 2u);
  EXPECT_EQ(client.records_lost(), 0u);
  EXPECT_EQ(client.read_fifo(65, kLong).error().kind, ClientErrorKind::rejected);
}

TEST(BoardClient, PassesOverRecordsOfALaterKind) {
  FakeBoard board;
  board.on_stream = [](FakePeer& peer) {
    Bytes bytes;
    board::append_record(bytes, 1, fake_sweep(1));
    const std::size_t second = bytes.size();
    board::append_record(bytes, 2, fake_sweep(2));
    board::append_record(bytes, 3, fake_sweep(3));
    bytes[second + board::layout::kKind] = 200;
    send_records(peer, bytes, 3);
  };
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
  EXPECT_EQ(trigger_of(**client.next(kLong)), 1u);
  EXPECT_EQ(trigger_of(**client.next(kLong)), 3u);
  EXPECT_EQ(client.records_lost(), 0u) << "it came, it is only not understood";
}

TEST(BoardClient, EndsTheConnectionOnRubbishAndSaysSoEveryTime) {
  const std::vector<std::function<void(FakePeer&)>> rubbish = {
      [](FakePeer& peer) { send_records(peer, Bytes(100, 0xEE), 1); },
      [](FakePeer& peer) {
        Bytes cut;
        board::append_record(cut, 1, fake_sweep(1));
        cut.resize(cut.size() - 64);
        send_records(peer, cut, 1);
      },
      [](FakePeer& peer) { peer.send_bytes(Bytes(1000, 0xFF)); }};
  for (const auto& send : rubbish) {
    FakeBoard board;
    board.on_stream = send;
    FakeServer server([&](FakePeer& peer) { board.serve(peer); });
    BoardClient client = connected(server);
    ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
    for (int i = 0; i < 2; ++i) {
      const auto record = client.next(kLong);
      ASSERT_FALSE(record);
      EXPECT_EQ(record.error().kind, ClientErrorKind::malformed) << record.error().text;
    }
    EXPECT_EQ(client.access({{.address = 0}}, kLong).error().kind, ClientErrorKind::malformed);
  }
}

TEST(BoardClient, RefusesAnswersWithTooFewResults) {
  FakeServer server([](FakePeer& peer) {
    say_board_hello(peer);
    const auto access = peer.receive();
    wire::ServerMessage answer;
    answer.mutable_board()->add_results();
    peer.send(answer);
    peer.answer(access->request());
    peer.wait_until_client_leaves();
  });
  BoardClient client = connected(server);
  const auto values = client.access({{.address = 0}, {.address = 4}}, kLong);
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, ClientErrorKind::malformed);
}

TEST(BoardClient, ReadsTheRingAndCountsWhatItMissed) {
  FakeRing ring;
  ring.write(5, fake_sweep(5));
  FakeBoard board;
  board.ring_name = ring.name();
  board.ring_bytes = ring.size();
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  const auto mapped = client.map_ring(kLong);
  ASSERT_TRUE(mapped) << mapped.error().text;
  const auto nothing = client.next(kShort);
  ASSERT_TRUE(nothing && !*nothing) << "it begins behind the newest";
  ring.write(6, fake_sweep(6));
  ring.write(9, fake_sweep(9));
  EXPECT_EQ(trigger_of(**client.next(kLong)), 6u);
  EXPECT_EQ(trigger_of(**client.next(kLong)), 9u);
  EXPECT_EQ(client.records_lost(), 2u);
  EXPECT_TRUE(client.access({{.address = 0}}, kLong)) << "registers go on over TCP";
  ring.writer().close();
  for (int i = 0; i < 2; ++i) {
    const auto record = client.next(kLong);
    ASSERT_FALSE(record);
    EXPECT_EQ(record.error().kind, ClientErrorKind::closed);
  }
}

TEST(BoardClient, NoticesThatTheServerOfARingHasDied) {
  FakeRing ring;
  FakeServer server([&](FakePeer& peer) {
    say_board_hello(peer);
    const auto request = peer.receive();
    wire::ServerMessage answer;
    answer.mutable_board()->set_ring_name(ring.name());
    answer.mutable_board()->set_ring_bytes(ring.size());
    peer.send(answer);
    peer.answer(request->request());
  });
  BoardClient client = connected(server);
  ASSERT_TRUE(client.map_ring(kLong));
  const auto record = client.next(kLong);
  ASSERT_FALSE(record);
  EXPECT_EQ(record.error().kind, ClientErrorKind::closed);
}

TEST(BoardClient, MapsNoMemoryThatIsNotABoardsRing) {
  FakeRing ring;
  struct Case {
    std::string name;
    std::uint64_t bytes;
    ClientErrorKind kind;
  };
  const std::vector<Case> cases = {
      {"/etc/passwd", ring.size(), ClientErrorKind::malformed},
      {"/skerry-board-../x", ring.size(), ClientErrorKind::malformed},
      {"/skerry-board-", ring.size(), ClientErrorKind::malformed},
      {"/skerry-board-" + std::string(300, '1'), ring.size(), ClientErrorKind::malformed},
      {ring.name(), 0, ClientErrorKind::malformed},
      {ring.name(), ~std::uint64_t{0}, ClientErrorKind::malformed},
      {ring.name(), ring.size() * 2, ClientErrorKind::unreachable},
      {"/skerry-board-99999999-9", ring.size(), ClientErrorKind::unreachable}};
  for (const Case& each : cases) {
    FakeBoard board;
    board.ring_name = each.name;
    board.ring_bytes = each.bytes;
    FakeServer server([&](FakePeer& peer) { board.serve(peer); });
    BoardClient client = connected(server);
    const auto mapped = client.map_ring(kLong);
    ASSERT_FALSE(mapped) << each.name;
    EXPECT_EQ(mapped.error().kind, each.kind) << mapped.error().text;
    EXPECT_TRUE(client.access({{.address = 0}}, kLong)) << "the connection is as it was";
  }
  std::fill(ring.memory().begin(), ring.memory().end(), std::uint8_t{0x5A});
  FakeBoard board;
  board.ring_name = ring.name();
  board.ring_bytes = ring.size();
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  EXPECT_EQ(client.map_ring(kLong).error().kind, ClientErrorKind::malformed);
}

TEST(BoardClient, LooksAtTheClockWhileAServerFloodsIt) {
  const wire::ServerMessage empty = [] {
    wire::ServerMessage message;
    message.mutable_board_records()->set_radar(kBoardRadar);
    return message;
  }();
  Bytes later;
  board::append_record(later, 1, fake_sweep(1));
  later[board::layout::kKind] = 200;
  for (const bool of_no_records : {true, false}) {
    FakeBoard board;
    board.on_stream = [&](FakePeer& peer) {
      while (of_no_records ? peer.send(empty) : send_records(peer, later, 1)) {
      }
    };
    FakeServer server([&](FakePeer& peer) { board.serve(peer); });
    BoardClient client = connected(server);
    ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
    for (const auto timeout : {0ms, 0ms, kShort}) {
      const auto nothing = client.next(timeout);
      ASSERT_TRUE(nothing && !*nothing);
    }
    EXPECT_EQ(client.access({{.address = 0}}, kShort).error().kind, ClientErrorKind::timed_out);
  }
}

TEST(BoardClient, CountsWhatWaitsWithWhatItTakesBesidesItsBytes) {
  FakeBoard board;
  board.on_stream = [](FakePeer& peer) {
    send_record(peer, 0, board::Event{.radar = 3, .event = board::event::arp});
    const auto access = peer.receive();
    // 10 MiB of records, a message each: less than may wait, if that were all they took.
    for (std::uint64_t n = 1; n <= 160'000;) {
      Bytes frames;
      for (int i = 0; i < 1000; ++i, ++n) {
        Bytes record;
        board::append_record(record, n, board::Event{.radar = 3, .event = board::event::arp});
        wire::ServerMessage message;
        message.mutable_board_records()->set_records(std::string(record.begin(), record.end()));
        append_frame(frames, message);
      }
      if (!peer.send_bytes(frames)) return;
    }
    wire::ServerMessage answer;
    answer.mutable_board()->add_results();
    peer.send(answer);
    peer.answer(access->request());
  };
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  ASSERT_TRUE(client.stream(BoardStreamKind::records, kLong));
  ASSERT_TRUE(*client.next(kLong)) << "the first one";
  ASSERT_TRUE(client.access({{.address = 0}}, kLong));
  const auto oldest = client.next(kLong);
  ASSERT_TRUE(oldest && *oldest);
  EXPECT_GT(client.records_lost(), 20'000u);
  EXPECT_EQ((*oldest)->sequence, client.records_lost() + 1);
}

TEST(BoardClient, MapsNoMemoryOfAnotherUserNotEvenAsRoot) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give memory to another user";
  FakeRing ring;
  const int file = ::shm_open(ring.name().c_str(), O_RDWR, 0);
  ASSERT_EQ(::fchown(file, 65534, 65534), 0);
  ::close(file);
  FakeBoard board;
  board.ring_name = ring.name();
  board.ring_bytes = ring.size();
  FakeServer server([&](FakePeer& peer) { board.serve(peer); });
  BoardClient client = connected(server);
  const auto mapped = client.map_ring(kLong);
  ASSERT_FALSE(mapped);
  EXPECT_EQ(mapped.error().kind, ClientErrorKind::unreachable);
  EXPECT_THAT(mapped.error().text, HasSubstr("it belongs to user 65534"));
}

TEST(BoardClient, GivesUpWaitingAndGoesOn) {
  FakeServer server([](FakePeer& peer) {
    say_board_hello(peer);
    peer.receive();  // never answered
    FakeBoard rest;
    while (const auto message = peer.receive()) peer.answer(message->request());
  });
  BoardClient client = connected(server);
  const auto values = client.access({{.address = 0}}, kShort);
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, ClientErrorKind::timed_out);
  EXPECT_TRUE(client.stream(BoardStreamKind::signals, kLong));
}

}  // namespace
}  // namespace skerry::client
