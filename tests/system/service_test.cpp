// skerryd under a service manager: what it tells of itself, and how it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/app/notify_socket.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

// Server programs started meanwhile have it as their service manager.
class Manager {
 public:
  Manager() {
    ::setenv("NOTIFY_SOCKET", socket.path().c_str(), 1);
    ::setenv("WATCHDOG_USEC", "200000", 1);
  }
  ~Manager() {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
  }
  // The next that is not WATCHDOG=1.
  std::string next_state() const {
    std::string state;
    do state = socket.next();
    while (state == kAlive);
    return state;
  }

  static constexpr const char* kAlive = "WATCHDOG=1\n";
  test::NotifySocket socket;
};

std::vector<std::string> server_command(const TempFolder& folder) {
  return {skerryd_program(),
          "--scenario",
          folder.write("small.yaml", small_scenario()),
          "--tcp-port",
          "0",
          "--http-port",
          "0",
          "--no-udp",
          "--no-cat240",
          "--record",
          "--record-folder",
          folder.path("recordings"),
          "--print-ports",
          "--record-reserve-mib",
          "0"};
}

TEST(Service, TellsItsManagerOfItsWholeLife) {
  const Manager manager;
  const TempFolder folder;
  ChildProcess server(server_command(folder));
  EXPECT_THAT(manager.socket.next(), MatchesRegex("READY=1\nSTATUS=[0-9]+ radars on the air\n"));
  EXPECT_EQ(manager.socket.next(), Manager::kAlive);
  server.signal(SIGHUP);
  EXPECT_THAT(manager.next_state(), StartsWith("RELOADING=1\n"));
  EXPECT_THAT(manager.next_state(), StartsWith("READY=1\n"));
  EXPECT_EQ(manager.socket.next(), Manager::kAlive);
  server.signal(SIGTERM);
  EXPECT_THAT(manager.next_state(), StartsWith("STOPPING=1\n"));
  const Ending ending = server.wait();
  EXPECT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("stopping on signal 15"));
  // And its recording is whole.
  int recordings = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path("recordings"))) {
    if (file.path().extension() != ".mcap") continue;
    ++recordings;
    const Ending info = run({skerry_program(), "recording", "info", "--check", file.path()});
    EXPECT_EQ(info.code, 0) << info.out << info.err;
    EXPECT_THAT(info.out, Not(HasSubstr("unfinished"))) << info.out;
  }
  EXPECT_EQ(recordings, 1);
}

// What a manager that waits for READY=1 would wait for in vain.
TEST(Service, IsNotReadyIfItDoesNotStart) {
  const Manager manager;
  const TempFolder folder;
  const Ending ending = run({skerryd_program(), "--scenario", folder.path("none.yaml")});
  EXPECT_EQ(ending.code, 2) << ending.err;
  EXPECT_TRUE(manager.socket.told().empty());
}

TEST(Service, IsNoOneWithoutAManager) {
  const TempFolder folder;
  ChildProcess server(server_command(folder));
  ASSERT_TRUE(server.read_line());
  server.signal(SIGHUP);
  server.await_error_text("SIGHUP");
  server.signal(SIGTERM);
  EXPECT_EQ(server.wait().code, 0);
}

}  // namespace
}  // namespace skerry::system_test
