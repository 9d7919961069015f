#include "server/app/service_manager.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "server/app/journal_lines.hpp"
#include "server/app/supervision.hpp"
#include "tests/unit/app/notify_socket.hpp"

namespace skerry::server {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::MatchesRegex;

// A variable of the environment, as it was before at the end.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

TEST(ServiceManager, IsToldEachStateInADatagram) {
  test::NotifySocket socket;
  const ServiceManager manager(socket.path());
  manager.starting("waits for bridge:7410");
  manager.ready("3 radars on the air");
  manager.alive();
  manager.reloading();
  manager.ready("one line\nSTOPPING=1");
  manager.stopping();
  EXPECT_THAT(socket.told(),
              ElementsAre("STATUS=waits for bridge:7410\nEXTEND_TIMEOUT_USEC=30000000\n",
                          "READY=1\nSTATUS=3 radars on the air\n", "WATCHDOG=1\n",
                          MatchesRegex("RELOADING=1\nMONOTONIC_USEC=[0-9]+\n"),
                          "READY=1\nSTATUS=one line\n", "STOPPING=1\nSTATUS=stopping\n"));
}

TEST(ServiceManager, MayHaveASocketWithoutAFile) {
  test::NotifySocket socket(test::NotifySocket::Kind::abstract);
  const ServiceManager manager(socket.path());
  ASSERT_TRUE(manager.is_there());
  manager.alive();
  EXPECT_THAT(socket.told(), ElementsAre("WATCHDOG=1\n"));
}

TEST(ServiceManager, ThatDoesNotReadBlocksNobody) {
  test::NotifySocket socket;
  const ServiceManager manager(socket.path());
  for (int i = 0; i < 100'000; ++i) manager.alive();
  EXPECT_FALSE(socket.told().empty());
}

TEST(ServiceManager, IsNoneWhereNobodyOrNothingUsableIsNamed) {
  for (const std::string& socket :
       {std::string(), std::string("/nowhere/notify"), std::string("vsock:2:1234"),
        std::string("/"), std::string("@"), "/" + std::string(200, 'a')}) {
    const ServiceManager manager(socket, microseconds(1'000'000));
    EXPECT_FALSE(manager.is_there()) << socket;
    EXPECT_FALSE(manager.watchdog()) << socket;
    manager.ready("nobody hears");
  }
}

TEST(ServiceManager, IsThatOfTheEnvironment) {
  test::NotifySocket socket;
  EXPECT_FALSE(ServiceManager::of_environment().is_there());
  const Variable named("NOTIFY_SOCKET", socket.path());
  EXPECT_TRUE(ServiceManager::of_environment().is_there());
  EXPECT_FALSE(ServiceManager::of_environment().watchdog());
  const Variable time("WATCHDOG_USEC", "30000000");
  EXPECT_EQ(ServiceManager::of_environment().watchdog(), microseconds(30'000'000));
  {
    const Variable mine("WATCHDOG_PID", std::to_string(::getpid()));
    EXPECT_EQ(ServiceManager::of_environment().watchdog(), microseconds(30'000'000));
  }
  const Variable another("WATCHDOG_PID", std::to_string(::getpid() + 1));
  EXPECT_FALSE(ServiceManager::of_environment().watchdog());
}

TEST(ServiceManager, HasNoWatchdogOfANonsensicalTime) {
  test::NotifySocket socket;
  const Variable named("NOTIFY_SOCKET", socket.path());
  for (const char* text : {"", "0", "-1", "soon", "30s", "99999999999999999999"}) {
    const Variable time("WATCHDOG_USEC", text);
    EXPECT_FALSE(ServiceManager::of_environment().watchdog()) << text;
  }
}

TEST(JournalLines, BearTheirPriority) {
  const auto lines = journal_formatter();
  const auto line = [&](spdlog::level::level_enum level) {
    spdlog::memory_buf_t out;
    lines->format(spdlog::details::log_msg("skerryd", level, "radar 0 stands still"), out);
    return std::string(out.data(), out.size());
  };
  EXPECT_EQ(line(spdlog::level::debug), "<7>[skerryd] radar 0 stands still\n");
  EXPECT_EQ(line(spdlog::level::info), "<6>[skerryd] radar 0 stands still\n");
  EXPECT_EQ(line(spdlog::level::warn), "<4>[skerryd] radar 0 stands still\n");
  EXPECT_EQ(line(spdlog::level::err), "<3>[skerryd] radar 0 stands still\n");
}

TEST(JournalLines, AreForStandardErrorThatIsTheJournal) {
  struct stat found {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &found), 0);
  EXPECT_FALSE(stderr_is_journal());
  {
    const Variable inherited("JOURNAL_STREAM", "1:2");
    EXPECT_FALSE(stderr_is_journal());
  }
  const Variable own("JOURNAL_STREAM",
                     std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino));
  EXPECT_TRUE(stderr_is_journal());
}

}  // namespace
}  // namespace skerry::server
