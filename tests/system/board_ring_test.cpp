// The ring of a board in shared memory: of a running server, of clients that die, and of a server
// that died before.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/system/board_kit.hpp"
#include "tests/system/receive.hpp"

namespace skerry::system_test {
namespace {

using client::BoardClient;

// Channel A is the ramp, so that every sample of every sweep can be checked.
const std::string kRamp = "{channel_a: {test: ramp}}";

// A server that the test may kill, on a port of the test's choice.
class MortalServer {
 public:
  MortalServer(const std::string& scenario, std::uint16_t port)
      : process_({skerryd_program(), "--tcp-port", std::to_string(port), "--http-port", "0",
                  "--print-ports", "--no-udp", "--no-cat240", "--scenario", scenario}) {
    unsigned tcp = 0;
    const auto line = process_.read_line();
    if (!line || std::sscanf(line->c_str(), "tcp %u", &tcp) != 1) {
      throw std::runtime_error("skerryd does not start: " + process_.wait().err);
    }
    tcp_port_ = static_cast<std::uint16_t>(tcp);
  }
  std::uint16_t tcp_port() const { return tcp_port_; }
  std::string ring_name() const { return "/skerry-board-" + std::to_string(tcp_port_) + "-0"; }
  Ending end(int with_signal) {
    process_.signal(with_signal);
    return process_.wait();
  }

 private:
  ChildProcess process_;
  std::uint16_t tcp_port_ = 0;
};

// The permissions of the memory of that name, or -1 where there is none.
int mode_of(const std::string& name) {
  const int file = ::shm_open(name.c_str(), O_RDONLY, 0);
  if (file < 0) return -1;
  struct stat found {};
  const int failed = ::fstat(file, &found);
  ::close(file);
  return failed != 0 ? -1 : static_cast<int>(found.st_mode & 0777);
}

void expect_ramps(BoardClient& board, int sweeps) {
  for (int i = 0; i < sweeps; ++i) ASSERT_TRUE(is_ramp(next_sweep(board))) << "sweep " << i;
}

// A process that reads the ring until it is killed; it says when it is in the middle of it.
class Victim {
 public:
  explicit Victim(std::uint16_t port) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(ends[0]);
      try {
        BoardClient board = board_at(port);
        map_ring(board);
        next_sweep(board);
        if (::write(ends[1], "x", 1) == 1) {
          while (true) next_sweep(board);
        }
      } catch (const std::exception&) {
      }
      ::_exit(1);
    }
    ::close(ends[1]);
    char byte = 0;
    reads_ = ::read(ends[0], &byte, 1) == 1;
    ::close(ends[0]);
  }
  bool reads() const { return reads_; }
  void kill() {
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  }

 private:
  pid_t pid_ = -1;
  bool reads_ = false;
};

TEST(BoardRing, ABoardThatNobodyReadsCountsItsPulsesAndMakesNoSweep) {
  TempFolder folder;
  RunningServer server({"--scenario", folder.write("boards.yaml", board_scenario(kRamp))});
  client::SpokeClient console = connected(server);
  const auto idle = [](const wire::Status& status) {
    return status.radars(0).board().triggers() > 500;
  };
  const wire::Status status = await_status(console, idle);
  for (const wire::RadarStatus& radar : status.radars()) {
    EXPECT_EQ(radar.board().sweeps(), 0u);
    EXPECT_EQ(radar.board().ring_name(), "");
  }
}

TEST(BoardRing, IsPrivateAndGoneWithTheServer) {
  TempFolder folder;
  MortalServer server(folder.write("boards.yaml", board_scenario(kRamp)), 0);
  EXPECT_EQ(mode_of(server.ring_name()), -1) << "made before anybody asked";
  BoardClient board = board_at(server.tcp_port());
  map_ring(board);
  EXPECT_EQ(mode_of(server.ring_name()), 0600);
  expect_ramps(board, 50);
  EXPECT_EQ(server.end(SIGTERM).code, 0);
  EXPECT_EQ(mode_of(server.ring_name()), -1) << "left behind";
}

TEST(BoardRing, SurvivesAClientThatDiesInTheMiddleAndRestsWhenTheLastHasGone) {
  TempFolder folder;
  RunningServer server({"--scenario", folder.write("boards.yaml", board_scenario(kRamp))});
  {
    Victim victim(server.tcp_port());
    ASSERT_TRUE(victim.reads());
    BoardClient survivor = board_of(server);
    map_ring(survivor);
    expect_ramps(survivor, 100);
    victim.kill();
    expect_ramps(survivor, 300);
  }
  client::SpokeClient console = connected(server);
  std::uint64_t sweeps = 0, triggers = 0;
  await_status(console, [&](const wire::Status& status) {
    const wire::BoardState& board = status.radars(0).board();
    if (board.sweeps() != sweeps) triggers = board.triggers();
    sweeps = board.sweeps();
    return board.triggers() > triggers + 500;
  });
  EXPECT_GT(sweeps, 400u);
  BoardClient later = board_of(server);
  map_ring(later);
  expect_ramps(later, 50);
}

TEST(BoardRing, OfADeadServerIsReplacedByTheNext) {
  TempFolder folder;
  const std::string scenario = folder.write("boards.yaml", board_scenario(kRamp));
  MortalServer dead(scenario, 0);
  BoardClient old = board_at(dead.tcp_port());
  map_ring(old);
  expect_ramps(old, 20);
  EXPECT_EQ(dead.end(SIGKILL).code, 128 + SIGKILL);
  EXPECT_EQ(mode_of(dead.ring_name()), 0600) << "a killed server cannot clean up";

  MortalServer server(scenario, dead.tcp_port());
  BoardClient board = board_at(server.tcp_port());
  map_ring(board);
  expect_ramps(board, 100);
  // Who still has the old memory gets what is left in it, and then an end.
  while (true) {
    const auto record = old.next(kAnswerTime);
    if (!record) break;
    ASSERT_TRUE(record->has_value()) << "the client was not told that its server has gone";
  }
  EXPECT_EQ(server.end(SIGTERM).code, 0);
  EXPECT_EQ(mode_of(server.ring_name()), -1);
}

}  // namespace
}  // namespace skerry::system_test
