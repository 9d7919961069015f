// The C library and `skerry board` against a running server, over TCP and through shared memory;
// and either of them killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <skerry_board.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kPatienceMs = 60'000;

#define ASSERT_CALL(call) ASSERT_EQ(call, SKB_OK) << skb_last_error()

std::string place(const char* scheme, std::uint16_t port) {
  return std::string(scheme) + "://127.0.0.1:" + std::to_string(port) + "/0";
}

// A board that is closed at the end of a test.
class Board {
 public:
  explicit Board(const std::string& where) {
    EXPECT_EQ(skb_open(where.c_str(), nullptr, kPatienceMs, &board_), SKB_OK) << skb_last_error();
  }
  ~Board() { skb_close(board_); }
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  operator skb_board*() const { return board_; }

 private:
  skb_board* board_ = nullptr;
};

class BoardOfAServer : public testing::TestWithParam<const char*> {
 protected:
  std::string here(const ServerProcess& server) const {
    return place(GetParam(), server.tcp_port());
  }
  static std::int32_t read(skb_board* board, skb_sweep& sweep, std::vector<std::uint16_t>& a) {
    a.resize(16384);
    return skb_read_sweep(board, kPatienceMs, &sweep, sizeof sweep, a.data(), a.size(), nullptr, 0);
  }

  TempFolder folder_;
  std::vector<std::string> arguments_ = {"--scenario",
                                         folder_.write("small.yaml", small_scenario())};
};

TEST_P(BoardOfAServer, OpensSetsArmsReadsAndCloses) {
  RunningServer server(arguments_);
  Board board(here(server));
  std::uint32_t identity = 0;
  ASSERT_CALL(skb_read_register(board, 0, &identity));
  EXPECT_EQ(identity, 0x42524B53u);
  ASSERT_CALL(skb_write_named(board, "SAMPLES_A", 512));
  ASSERT_CALL(skb_write_named(board, "PRF_MILLIHERTZ", 1'000'000));
  ASSERT_CALL(skb_write_named(board, "ACP_PER_TURN", 450));
  ASSERT_CALL(skb_write_named(board, "TEST_MODE_A", 1));
  EXPECT_EQ(skb_write_named(board, "ACP_PER_TURN", 100), SKB_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(skb_write_named(board, "VERSION", 1), SKB_ERROR_READ_ONLY);

  ASSERT_CALL(skb_arm(board));
  skb_sweep sweep{};
  std::vector<std::uint16_t> a(16384);
  ASSERT_CALL(
      skb_read_fifo(board, kPatienceMs, &sweep, sizeof sweep, a.data(), a.size(), nullptr, 0));
  ASSERT_EQ(sweep.channel[0].samples, 512u);
  const std::uint64_t captured = sweep.trigger_count;
  std::int64_t latched = 0;
  ASSERT_CALL(skb_read_named(board, "LATCHED_TRIGGER_COUNT", &latched));
  EXPECT_GE(static_cast<std::uint64_t>(latched), captured);
  // The ramp: each sample one more than the one before, each trigger one more than the one before.
  for (std::size_t i = 0; i < 512; ++i) ASSERT_EQ(a[i], (a[0] + i) % 4096) << i;

  skb_event arp{};
  ASSERT_CALL(skb_wait_arp(board, kPatienceMs, &arp, sizeof arp));
  ASSERT_CALL(read(board, sweep, a));
  EXPECT_GE(sweep.trigger_tick, arp.tick);
  EXPECT_LT(sweep.azimuth_turns, 0.01) << "the first of the turn";
  EXPECT_EQ(sweep.acp_per_turn, 450u);
  const std::uint32_t turn = sweep.arp_count;
  std::uint64_t triggers = 0, lost = 0;
  for (skb_sweep last = sweep; sweep.arp_count == turn; last = sweep) {
    ++triggers;
    ASSERT_CALL(read(board, sweep, a));
    if (sweep.trigger_count != last.trigger_count + 1) continue;  // lost, which is counted
    EXPECT_EQ(sweep.trigger_tick - last.trigger_tick, sweep.sample_clock_hz / 1000);
    if (sweep.arp_count == turn) {
      EXPECT_GT(sweep.azimuth_turns, last.azimuth_turns);
    }
  }
  ASSERT_CALL(skb_lost(board, &lost));
  EXPECT_LE(triggers, 1000u);
  EXPECT_GE(triggers + lost, 999u) << "60 turns a minute, 1000 triggers a second";
}

TEST_P(BoardOfAServer, SaysThatItsServerWasKilledAndOpensTheNextOne) {
  std::vector<std::string> command = {
      skerryd_program(), "--tcp-port",   "0", "--http-port", "0", "--no-udp",
      "--no-cat240",     "--print-ports"};
  command.insert(command.end(), arguments_.begin(), arguments_.end());
  ChildProcess first(command);
  unsigned port = 0, http = 0;
  ASSERT_EQ(std::sscanf(first.read_line().value_or("").c_str(), "tcp %u http %u", &port, &http), 2);
  Board board(place(GetParam(), static_cast<std::uint16_t>(port)));
  skb_sweep sweep{};
  std::vector<std::uint16_t> a;
  ASSERT_CALL(read(board, sweep, a));
  first.signal(SIGKILL);
  first.wait();
  std::int32_t result = SKB_OK;
  while (result == SKB_OK) result = read(board, sweep, a);  // what had come before
  EXPECT_EQ(result, SKB_ERROR_CLOSED) << skb_last_error();
  EXPECT_EQ(read(board, sweep, a), SKB_ERROR_CLOSED);
  EXPECT_EQ(skb_arm(board), SKB_ERROR_CLOSED);

  // On the same port, where the ring of the dead one may still lie.
  command[2] = std::to_string(port);
  ChildProcess second(command);
  ASSERT_TRUE(second.read_line().has_value());
  Board again(place(GetParam(), static_cast<std::uint16_t>(port)));
  ASSERT_CALL(read(again, sweep, a));
  EXPECT_EQ(read(board, sweep, a), SKB_ERROR_CLOSED) << "the old one stays closed";
  second.signal(SIGTERM);
  EXPECT_EQ(second.wait().code, 0);
}

TEST_P(BoardOfAServer, BearsThatAReaderIsKilled) {
  RunningServer server(arguments_);
  const std::string port = std::to_string(server.tcp_port());
  Board board(here(server));
  for (int i = 0; i < 3; ++i) {
    ChildProcess reader(
        {skerry_program(), "board", "watch", "--sweeps", "--stream", GetParam(), "--port", port});
    ASSERT_TRUE(reader.read_line().has_value());
    reader.signal(SIGKILL);
    reader.wait();
    skb_sweep sweep{};
    std::vector<std::uint16_t> a;
    ASSERT_CALL(read(board, sweep, a));
  }
}

TEST(BoardCommands, ShowARunningBoard) {
  TempFolder folder;
  RunningServer server({"--scenario", folder.write("small.yaml", small_scenario())});
  const auto board = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {skerry_program(), "board"};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--port", std::to_string(server.tcp_port()), "--timeout", "60"});
    return run(all);
  };
  EXPECT_THAT(board({"registers"}).out, HasSubstr("PRF_MILLIHERTZ"));
  EXPECT_EQ(board({"set", "PRF_MILLIHERTZ=1000000", "SAMPLES_A=512"}).code, 0);
  const Ending high = board({"set", "SAMPLES_A=16384", "DECIMATION_A=4"});
  EXPECT_EQ(high.code, 1);
  EXPECT_THAT(high.err, HasSubstr("SAMPLES_A"));
  EXPECT_EQ(board({"set", "SAMPLES_A=512", "DECIMATION_A=1"}).code, 0);
  const Ending scope = board({"scope", "--azimuth", "10"});
  EXPECT_EQ(scope.code, 0) << scope.err;
  EXPECT_THAT(scope.out, HasSubstr("512 samples"));
  const Ending picture = board({"scope", "--stream", "shm", "-o", folder.path("s.png")});
  EXPECT_EQ(picture.code, 0) << picture.err;
  const Ending watch = board({"watch", "--count", "2"});
  EXPECT_EQ(watch.code, 0) << watch.err;
  EXPECT_THAT(watch.out, HasSubstr("arp"));
  const Ending ppi = board({"ppi", "--stream", "shm", "-o", folder.path("p.png")});
  EXPECT_EQ(ppi.code, 0) << ppi.err;
  // A machine too slow for the board is told so.
  EXPECT_THAT(ppi.out, testing::AnyOf(HasSubstr("512 spokes"), HasSubstr("LATE")));
  const Ending off = board({"ppi", "--channel", "B", "-o", folder.path("b.png")});
  EXPECT_EQ(off.code, 1);
  EXPECT_THAT(off.err, HasSubstr("channel B is off: SOURCE_B is 0"));
  const Ending elsewhere = board({"set", "SOURCE_B=7"});
  EXPECT_EQ(elsewhere.code, 1);
  EXPECT_THAT(elsewhere.err, HasSubstr("no radar 6 on this own ship"));
  EXPECT_EQ(board({"set", "FAULTS_LATCHED=0xFFFFFFFF"}).code, 0);
  for (const char* file : {"s.png", "p.png"}) {
    EXPECT_THAT(text_of_file(folder.path(file)), testing::StartsWith("\x89PNG"));
  }
}

INSTANTIATE_TEST_SUITE_P(EachWay, BoardOfAServer, testing::Values("tcp", "shm"));

TEST(BoardExample, PrintsTheAzimuthsOfOneTurn) {
  TempFolder folder;
  RunningServer server({"--scenario", folder.write("small.yaml", small_scenario())});
  const Ending ending = run({SKERRY_AZIMUTHS, place("tcp", server.tcp_port())});
  EXPECT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("4096 ACPs a turn"));
  std::istringstream lines(ending.out);
  std::string line;
  std::getline(lines, line);  // the heading
  unsigned long count = 0;
  for (double before = -1.0, azimuth = 0.0; std::getline(lines, line); before = azimuth, ++count) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf deg", &azimuth), 1) << line;
    EXPECT_GT(azimuth, before);
    EXPECT_LT(azimuth, count == 0 ? 1.0 : 360.0);
  }
  // How many depends on the machine: those that come too late are left out.
  EXPECT_GT(count, 10u);
  EXPECT_THAT(ending.err, HasSubstr(std::to_string(count) + " sweeps"));
}

}  // namespace
}  // namespace skerry::system_test
