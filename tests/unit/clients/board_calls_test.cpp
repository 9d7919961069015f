// The C library of the interface board, against fake servers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <skerry_board.h>

#include <array>
#include <cmath>
#include <future>
#include <thread>

#include "protocol/board/digdar_page.hpp"
#include "tests/unit/clients/fake_board.hpp"

extern "C" int32_t board_header_in_c(void);

namespace skerry::client {
namespace {

using board::address_of;
using board::Reg;
using testing::HasSubstr;

constexpr std::uint32_t kLong = 20'000;  // never reached by a test that passes
constexpr std::uint32_t kShort = 50;     // always reached

std::string place_of(const FakeServer& server, const char* scheme = "tcp") {
  return std::string(scheme) + "://127.0.0.1:" + std::to_string(server.port()) + "/3";
}

// Open for the length of a test.
class Board {
 public:
  explicit Board(const std::string& place) {
    EXPECT_EQ(skb_open(place.c_str(), nullptr, kLong, &board_), SKB_OK) << skb_last_error();
  }
  ~Board() { skb_close(board_); }
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  operator skb_board*() const { return board_; }

 private:
  skb_board* board_ = nullptr;
};

std::int32_t next_sweep(skb_board* board, skb_sweep& sweep, std::vector<std::uint16_t>& a,
                        std::uint32_t timeout = kLong) {
  a.assign(16, 0xFFFF);
  return skb_read_sweep(board, timeout, &sweep, sizeof sweep, a.data(), a.size(), nullptr, 0);
}

TEST(BoardCalls, HasTheBoardsOwnBitsInItsHeader) {
  EXPECT_EQ(SKB_CONTROL_RUN | SKB_CONTROL_RESET << 8 | SKB_CONTROL_ARM << 16,
            static_cast<int>(board::control::run | board::control::reset << 8 |
                             board::control::arm << 16));
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_CONTROL_FIFO), board::control::fifo);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_STATUS_FAULT), board::status::fault);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_STATUS_RADIATING), board::status::radiating);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_FAULT_CONFIG), board::fault::config);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_FAULT_STALLED), board::fault::stalled);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_FAULT_LATE), board::fault::late);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_EVENT_ARP), board::event::arp);
  EXPECT_EQ(static_cast<std::uint32_t>(SKB_EVENT_RESET), board::event::reset);
  EXPECT_EQ(skb_version(), static_cast<std::uint32_t>(SKB_VERSION_MAJOR << 16 |
                                                      SKB_VERSION_MINOR << 8 | SKB_VERSION_PATCH));
  EXPECT_THAT(skb_version_text(), testing::StartsWith("1.0.0 (skerry "));
  EXPECT_STREQ(skb_result_name(SKB_ERROR_MISALIGNED), "MISALIGNED");
  for (const std::int32_t code : {-1, 16, INT32_MAX, INT32_MIN}) {
    EXPECT_STREQ(skb_result_name(code), "UNKNOWN");
  }
}

TEST(BoardCalls, RefuseWhatIsNoBoard) {
  std::uint32_t value = 0;
  std::int64_t number = 0;
  std::uint64_t wide = 0;
  std::size_t size = 0;
  char text[8];
  skb_sweep sweep;
  int stranger = 0;
  for (skb_board* board :
       {static_cast<skb_board*>(nullptr), reinterpret_cast<skb_board*>(&stranger),
        reinterpret_cast<skb_board*>(~std::uintptr_t{0})}) {
    for (const std::int32_t result :
         {skb_close(board), skb_describe(board, text, sizeof text, &size),
          skb_read_register(board, 0, &value), skb_write_register(board, 0, 1),
          skb_read_register64(board, 0x104, &wide), skb_read_named(board, "FAULTS", &number),
          skb_write_named(board, "CONTROL", 1), skb_fault_reason(board, text, sizeof text, &size),
          skb_start(board), skb_arm(board),
          skb_read_sweep(board, 0, &sweep, sizeof sweep, nullptr, 0, nullptr, 0),
          skb_read_fifo(board, 0, &sweep, sizeof sweep, nullptr, 0, nullptr, 0),
          skb_wait_arp(board, 0, nullptr, 0), skb_lost(board, &wide),
          skb_overruns(board, 0, &value)}) {
      EXPECT_EQ(result, SKB_ERROR_HANDLE) << skb_last_error();
    }
  }
  EXPECT_EQ(board_header_in_c(), SKB_ERROR_HANDLE);
}

TEST(BoardCalls, RefusePlacesThatAreNone) {
  skb_board* board = nullptr;
  for (const char* place : {"", "127.0.0.1:7410", "udp://127.0.0.1/0", "tcp://", "tcp://:7410",
                            "tcp://h:0/0", "tcp://h:65536", "tcp://h:7410/x", "tcp://h:7410/-1",
                            "tcp://[::1/0", "tcp://[::1]x", "shm://h:1x"}) {
    EXPECT_EQ(skb_open(place, nullptr, kLong, &board), SKB_ERROR_ARGUMENT) << place;
    EXPECT_THAT(skb_last_error(), HasSubstr("tcp://host:port/radar"));
    EXPECT_EQ(board, nullptr);
  }
  const std::string endless(100'000, 'x');
  EXPECT_EQ(skb_open(endless.c_str(), nullptr, kLong, &board), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_open(nullptr, nullptr, kLong, &board), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_open("tcp://127.0.0.1", nullptr, kLong, nullptr), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_open("tcp://127.0.0.1", nullptr, 0, &board), SKB_ERROR_ARGUMENT);
  const std::string nobody = "tcp://127.0.0.1:" + std::to_string(unused_port());
  EXPECT_EQ(skb_open(nobody.c_str(), nullptr, kLong, &board), SKB_ERROR_UNREACHABLE);
  FakeServer server([](FakePeer& peer) { FakeBoard().serve(peer); });
  const std::string other = "tcp://127.0.0.1:" + std::to_string(server.port()) + "/1";
  EXPECT_EQ(skb_open(other.c_str(), nullptr, kLong, &board), SKB_ERROR_REJECTED);
}

TEST(BoardCalls, ReadAndWriteRegistersByAddressAndByName) {
  FakeBoard fake;
  fake.fault_reason = "FIFO_DEPTH 2";
  fake.registers[address_of(Reg::clocks_low)] = 0x89ABCDEF;
  fake.registers[address_of(Reg::clocks_high)] = 0x01234567;
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  char text[128];
  std::size_t size = 0;
  ASSERT_EQ(skb_describe(board, text, sizeof text, &size), SKB_OK);
  EXPECT_THAT(text, HasSubstr("radar 3 (Mast?[2J) of 127.0.0.1:"));
  EXPECT_EQ(size, std::strlen(text) + 1);
  EXPECT_EQ(skb_describe(board, text, 3, &size), SKB_ERROR_SIZE);

  ASSERT_EQ(skb_write_register(board, address_of(Reg::acp_per_turn), 450), SKB_OK);
  std::uint32_t value = 0;
  ASSERT_EQ(skb_read_register(board, address_of(Reg::acp_per_turn), &value), SKB_OK);
  EXPECT_EQ(value, 450u);
  ASSERT_EQ(skb_write_named(board, "gain_a", -300), SKB_OK) << skb_last_error();
  std::int64_t number = 0;
  ASSERT_EQ(skb_read_named(board, "GAIN_A", &number), SKB_OK);
  EXPECT_EQ(number, -300);
  ASSERT_EQ(skb_read_named(board, "CLOCKS", &number), SKB_OK);
  EXPECT_EQ(number, 0x0123456789ABCDEF);
  std::uint64_t wide = 0;
  ASSERT_EQ(skb_read_register64(board, address_of(Reg::clocks_low), &wide), SKB_OK);
  EXPECT_EQ(wide, 0x0123456789ABCDEFu);
  const std::uint32_t addresses[2] = {address_of(Reg::acp_per_turn), address_of(Reg::clocks_high)};
  std::uint32_t values[2] = {};
  ASSERT_EQ(skb_read_registers(board, addresses, values, 2), SKB_OK);
  EXPECT_EQ(values[0], 450u);
  EXPECT_EQ(values[1], 0x01234567u);
  EXPECT_EQ(skb_read_registers(board, addresses, values, 0), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_read_registers(board, addresses, values, 257), SKB_ERROR_ARGUMENT);
  ASSERT_EQ(skb_fault_reason(board, text, sizeof text, &size), SKB_OK);
  EXPECT_STREQ(text, "FIFO_DEPTH 2");
  std::uint32_t address = 0;
  ASSERT_EQ(skb_find_register("prf_millihertz", &address), SKB_OK);
  EXPECT_EQ(address, address_of(Reg::prf_millihertz));

  EXPECT_EQ(skb_write_register(board, address_of(Reg::acp_per_turn), 1), SKB_ERROR_OUT_OF_RANGE);
  EXPECT_THAT(skb_last_error(), HasSubstr("ACP_PER_TURN: 1 is out of range; allowed: 360"));
  for (const std::int64_t beyond : {std::int64_t{4'294'966'996}, std::int64_t{-6001}}) {
    EXPECT_EQ(skb_write_named(board, "GAIN_A", beyond), SKB_ERROR_OUT_OF_RANGE) << beyond;
    EXPECT_THAT(skb_last_error(), HasSubstr(std::to_string(beyond) + " is out of range"));
  }
  ASSERT_EQ(skb_read_named(board, "GAIN_A", &number), SKB_OK);
  EXPECT_EQ(number, -300) << "as it was";
  EXPECT_EQ(skb_write_named(board, "PRF_MILLIHERTZ", 0), SKB_OK) << "0 has a meaning of its own";
  EXPECT_EQ(skb_read_register64(board, 0xFFFFFFFC, &wide), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_write_named(board, "SAMPLES_A", -1), SKB_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(skb_write_named(board, "SAMPLES_A", std::int64_t{1} << 40), SKB_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(skb_write_named(board, "IDENTITY", 1), SKB_ERROR_READ_ONLY);
  EXPECT_EQ(skb_read_register(board, 3, &value), SKB_ERROR_MISALIGNED);
  EXPECT_EQ(skb_read_register(board, 0xFFC, &value), SKB_ERROR_UNKNOWN_REGISTER);
  EXPECT_EQ(skb_read_named(board, "WARP", &number), SKB_ERROR_UNKNOWN_REGISTER);
  EXPECT_EQ(skb_read_named(board, nullptr, &number), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_overruns(board, 2, &value), SKB_ERROR_ARGUMENT);
}

TEST(BoardCalls, GiveSweepsWithWhatWasLatched) {
  FakeBoard fake;
  fake.on_stream = [](FakePeer& peer) {
    send_record(peer, 40, fake_sweep(40));
    send_record(peer, 43, fake_sweep(41));
  };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  skb_sweep sweep;
  std::vector<std::uint16_t> a(16);
  EXPECT_EQ(skb_read_sweep(board, kLong, &sweep, sizeof sweep, a.data(), 7, nullptr, 0),
            SKB_ERROR_SIZE);
  EXPECT_THAT(skb_last_error(), HasSubstr("a has room for 7 of 8 samples"));
  EXPECT_EQ(sweep.channel[0].samples, 8u) << "what is needed can be seen";
  ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK) << "it stays the next one";
  EXPECT_EQ(sweep.trigger_count, 40u);
  EXPECT_EQ(sweep.sequence, 40u);
  EXPECT_EQ(sweep.acp_count, 320u);
  EXPECT_EQ(sweep.utc_ns, fake_sweep(40).meta.utc_ns);
  EXPECT_EQ(sweep.channel[0].largest_code, 4095u);
  EXPECT_EQ(sweep.channel[1].samples, 0u);
  EXPECT_NEAR(sweep.azimuth_turns, 40.0 / 512.0, 1.0 / 4096.0);
  EXPECT_NEAR(sweep.channel[0].range_step_m, 299'792'458.0 / 2.0 / 6'710'886.0, 1e-6);
  EXPECT_EQ(a[0], 40);
  EXPECT_EQ(a[7], 47);
  EXPECT_EQ(a[8], 0xFFFF) << "nothing behind the samples";
  ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK);
  std::uint64_t lost = 0;
  ASSERT_EQ(skb_lost(board, &lost), SKB_OK);
  EXPECT_EQ(lost, 2u);
  EXPECT_EQ(next_sweep(board, sweep, a, kShort), SKB_ERROR_TIMEOUT);

  EXPECT_EQ(skb_read_sweep(board, 0, nullptr, sizeof sweep, nullptr, 0, nullptr, 0),
            SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_read_sweep(board, 0, &sweep, 8, nullptr, 0, nullptr, 0), SKB_ERROR_SIZE);
  EXPECT_EQ(skb_read_sweep(board, 0, &sweep, sizeof sweep, nullptr, 4, nullptr, 0),
            SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_read_sweep(board, SKB_LONGEST_TIMEOUT_MS + 1, &sweep, sizeof sweep, a.data(), 16,
                           nullptr, 0),
            SKB_ERROR_ARGUMENT);
}

// BOARD.md 5, of what a program has of a sweep alone.
double azimuth_from(const skb_sweep& sweep) {
  double acp = sweep.acp_period;
  const double mean = static_cast<double>(sweep.turn_ticks) / sweep.acp_per_turn;
  if (sweep.turn_ticks != 0 && std::abs(mean - acp) <= 1.0) acp = mean;
  const auto fraction = [&](double ticks) { return acp > 0 ? std::min(1.0, ticks / acp) : 0.0; };
  const double turns =
      (sweep.acp_count + fraction(sweep.ticks_since_acp) - fraction(sweep.arp_ticks)) /
      sweep.acp_per_turn;
  return turns - std::floor(turns);
}

TEST(BoardCalls, GiveAllThatAnAzimuthIsWorkedOutOf) {
  const board::Sweep sent = [] {
    board::Sweep sweep = fake_sweep(40);
    sweep.meta.acp_period = 5;  // whole ticks of 4.75
    sweep.meta.turn_ticks = 4096 * 19 / 4;
    sweep.meta.ticks_since_acp = 4;
    sweep.meta.arp_ticks = 1;
    return sweep;
  }();
  FakeBoard fake;
  fake.on_stream = [&](FakePeer& peer) { send_record(peer, 1, sent); };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK);
  EXPECT_EQ(sweep.turn_ticks, 4096u * 19 / 4);
  EXPECT_NEAR(azimuth_from(sweep), sweep.azimuth_turns, 1e-12);
  EXPECT_NEAR(azimuth_from(sweep), board::azimuth_turns(sent.meta), 1e-12);
}

TEST(BoardCalls, GoOnWhenTheSampleClockIsLowered) {
  const auto of_clock = [](std::uint64_t n, std::uint32_t clock_hz, std::uint64_t tick) {
    board::Sweep sweep = fake_sweep(n);
    sweep.meta.sample_clock_hz = clock_hz;
    sweep.meta.trigger_tick = tick;
    return sweep;
  };
  FakeBoard fake;
  fake.on_stream = [&](FakePeer& peer) {
    send_record(peer, 1, of_clock(1, 20'000'000, 2'000'000'000));
    send_record(peer, 2,
                board::Event{.radar = 3, .tick = 2'000'000'500, .event = board::event::arp});
    send_record(peer, 3, of_clock(2, 20'000'000, 2'000'000'400));
    send_record(peer, 4, of_clock(3, 1'000'000, 100'000'030));
    send_record(peer, 5,
                edges_of(100'000'000, 100'100'000, {{100'050'000, board::Line::arp}}, 1'000'000));
    send_record(peer, 6, of_clock(4, 1'000'000, 100'050'010));
  };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  skb_event event{};
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  ASSERT_EQ(skb_wait_arp(board, kLong, &event, sizeof event), SKB_OK);
  EXPECT_EQ(event.tick, 2'000'000'500u);
  ASSERT_EQ(next_sweep(board, sweep, a, 2000), SKB_OK) << skb_last_error();
  EXPECT_EQ(sweep.trigger_count, 3u) << "of the turn of the old clock there was none";
  ASSERT_EQ(skb_wait_arp(board, 2000, &event, sizeof event), SKB_OK) << skb_last_error();
  EXPECT_EQ(event.tick, 100'050'000u);
  ASSERT_EQ(next_sweep(board, sweep, a, 2000), SKB_OK) << skb_last_error();
  EXPECT_EQ(sweep.trigger_count, 4u);
}

TEST(BoardCalls, EndInTimeWhateverAServerFloodsThemWith) {
  FakeBoard fake;
  fake.on_stream = [](FakePeer& peer) {
    while (send_records(peer, {}, 0)) {
    }
  };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  EXPECT_EQ(next_sweep(board, sweep, a, kShort), SKB_ERROR_TIMEOUT);
  EXPECT_EQ(skb_wait_arp(board, kShort, nullptr, 0), SKB_ERROR_TIMEOUT);
}

TEST(BoardCalls, FillTheLargerStructureOfANewerProgram) {
  FakeBoard fake;
  fake.on_stream = [](FakePeer& peer) { send_record(peer, 1, fake_sweep(9)); };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  struct Newer {
    skb_sweep known;
    std::uint64_t unknown;
  } newer{};
  newer.unknown = 5;
  ASSERT_EQ(skb_read_sweep(board, kLong, &newer.known, sizeof newer, nullptr, 0, nullptr, 0),
            SKB_OK);
  EXPECT_EQ(newer.known.trigger_count, 9u);
  EXPECT_EQ(newer.unknown, 0u);
}

TEST(BoardCalls, WaitForTheArpAndGoOnWithItsTurn) {
  FakeBoard fake;
  fake.on_stream = [](FakePeer& peer) {
    std::uint64_t sequence = 0;
    for (const std::uint64_t n : {510, 511, 512, 513}) send_record(peer, sequence++, fake_sweep(n));
    const std::uint64_t tick = fake_sweep(512).meta.trigger_tick - 16;
    send_record(peer, sequence++,
                board::Event{.radar = 3, .tick = tick, .event = board::event::heading});
    send_record(peer, sequence++,
                board::Event{.radar = 3, .tick = tick, .event = board::event::arp, .value = 1});
    send_record(peer, sequence++, edges_of(0, 2 * tick, {{tick, board::Line::arp}}));
    send_record(peer, sequence++, fake_sweep(514));
    const std::uint64_t next = tick + 4096 * 4096;
    send_record(peer, sequence++, edges_of(2 * tick, 2 * next, {{next, board::Line::arp}}));
  };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  skb_event event{};
  ASSERT_EQ(skb_wait_arp(board, kLong, &event, sizeof event), SKB_OK) << skb_last_error();
  EXPECT_EQ(event.event, static_cast<std::uint32_t>(SKB_EVENT_ARP));
  EXPECT_EQ(event.value, 1u);
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  for (const std::uint64_t n : {512, 513, 514}) {
    ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK);
    EXPECT_EQ(sweep.trigger_count, n);
  }
  const std::uint64_t first = event.tick;
  ASSERT_EQ(skb_wait_arp(board, kLong, &event, sizeof event), SKB_OK);
  EXPECT_EQ(event.tick, first + 4096 * 4096) << "the edges alone say so; one ARP counts once";
  EXPECT_EQ(skb_wait_event(board, SKB_EVENT_RESET, kShort, nullptr, 0), SKB_ERROR_TIMEOUT);
  EXPECT_EQ(skb_wait_event(board, 0, kShort, nullptr, 0), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_wait_event(board, 128, kShort, nullptr, 0), SKB_ERROR_ARGUMENT);
  EXPECT_EQ(skb_wait_arp(board, kShort, &event, 4), SKB_ERROR_SIZE);
}

TEST(BoardCalls, ArmAndTakeTheSweepOutOfTheFifo) {
  FakeBoard fake;
  fake.registers[address_of(Reg::control)] = board::control::run;
  fake.fifo = {fake_sweep(1), fake_sweep(2)};
  std::vector<wire::BoardAccess> accesses;
  fake.on_access = [&](const wire::BoardAccess& access) { accesses.push_back(access); };
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server));
  ASSERT_EQ(skb_arm(board), SKB_OK) << skb_last_error();
  ASSERT_EQ(accesses.size(), 1u) << "nothing can come between";
  ASSERT_EQ(accesses[0].operations_size(), 2);
  EXPECT_EQ(accesses[0].operations(0).address(), address_of(board::Digdar::trig_source));
  EXPECT_GT(accesses[0].operations(0).write(), 0u) << "without one COMMAND arms nothing";
  EXPECT_EQ(accesses[0].operations(1).address(), address_of(board::Digdar::command));
  EXPECT_EQ(accesses[0].operations(1).write(), board::digdar_command::arm);
  skb_sweep sweep;
  std::array<std::uint16_t, 8> a{};
  EXPECT_EQ(skb_read_fifo(board, kLong, &sweep, sizeof sweep, a.data(), 1, nullptr, 0),
            SKB_ERROR_SIZE);
  for (const std::uint64_t n : {1, 2}) {
    ASSERT_EQ(skb_read_fifo(board, kLong, &sweep, sizeof sweep, a.data(), 8, nullptr, 0), SKB_OK);
    EXPECT_EQ(sweep.trigger_count, n) << "a buffer too small loses none";
  }
  EXPECT_EQ(skb_read_fifo(board, kShort, &sweep, sizeof sweep, a.data(), 8, nullptr, 0),
            SKB_ERROR_TIMEOUT);
}

TEST(BoardCalls, ReadSharedMemory) {
  FakeRing ring;
  FakeBoard fake;
  fake.ring_name = ring.name();
  fake.ring_bytes = ring.size();
  FakeServer server([&](FakePeer& peer) { fake.serve(peer); });
  Board board(place_of(server, "shm"));
  ring.write(0, fake_sweep(77));
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK) << skb_last_error();
  EXPECT_EQ(sweep.trigger_count, 77u);
  ring.writer().close();
  EXPECT_EQ(next_sweep(board, sweep, a), SKB_ERROR_CLOSED);
  FakeServer without([](FakePeer& peer) { FakeBoard().serve(peer); });
  skb_board* none = nullptr;
  EXPECT_EQ(skb_open(place_of(without, "shm").c_str(), nullptr, kLong, &none), SKB_ERROR_REJECTED);
  EXPECT_THAT(skb_last_error(), HasSubstr("no memory left"));
}

TEST(BoardCalls, SurviveServersThatDieOrTalkRubbish) {
  skb_sweep sweep;
  std::vector<std::uint16_t> a;
  FakeServer dying([](FakePeer& peer) {
    say_board_hello(peer);
    peer.answer(peer.receive()->request());
    send_record(peer, 1, fake_sweep(1));
  });
  Board board(place_of(dying));
  ASSERT_EQ(next_sweep(board, sweep, a), SKB_OK) << "what had come is given out first";
  for (int i = 0; i < 3; ++i) EXPECT_EQ(next_sweep(board, sweep, a), SKB_ERROR_CLOSED);
  EXPECT_EQ(skb_arm(board), SKB_ERROR_CLOSED);
  EXPECT_EQ(skb_start(board), SKB_ERROR_CLOSED);

  FakeBoard rubbish;
  rubbish.on_stream = [](FakePeer& peer) { send_records(peer, Bytes(4096, 0x13), 64); };
  FakeServer babbling([&](FakePeer& peer) { rubbish.serve(peer); });
  Board other(place_of(babbling));
  EXPECT_EQ(next_sweep(other, sweep, a), SKB_ERROR_PROTOCOL);
  EXPECT_EQ(skb_wait_arp(other, kShort, nullptr, 0), SKB_ERROR_PROTOCOL);
}

TEST(BoardCalls, LetInOneThreadAtATimeAndKeepTextsApart) {
  FakeServer server([](FakePeer& peer) { FakeBoard().serve(peer); });
  Board board(place_of(server));
  std::promise<void> begun;
  std::thread waiting([&] {
    begun.set_value();
    while (skb_wait_arp(board, 1000, nullptr, 0) == SKB_ERROR_BUSY) {
    }
  });
  begun.get_future().wait();
  std::uint32_t value = 0;
  std::int32_t result = SKB_OK;
  // Until the other thread is in its call, this one may be let in.
  while ((result = skb_read_register(board, 0, &value)) == SKB_OK) {
  }
  EXPECT_EQ(result, SKB_ERROR_BUSY);
  EXPECT_THAT(skb_last_error(), HasSubstr("another thread"));
  waiting.join();
  std::string theirs = "unset";
  std::thread([&] { theirs = skb_last_error(); }).join();
  EXPECT_EQ(theirs, "");
  EXPECT_EQ(skb_read_register(board, 0, &value), SKB_OK) << skb_last_error();
}

}  // namespace
}  // namespace skerry::client
