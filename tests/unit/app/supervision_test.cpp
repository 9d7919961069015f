#include "server/app/supervision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/app/notify_socket.hpp"

namespace skerry::server {
namespace {

using std::chrono::microseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

using Steps = std::vector<std::uint64_t>;

TEST(Pulse, BeatsOnceEverybodyHasMadeTheFirstStep) {
  Pulse pulse;
  EXPECT_FALSE(pulse.beats(Steps{0, 0, 0}));
  EXPECT_FALSE(pulse.beats(Steps{5, 0, 7}));
  EXPECT_TRUE(pulse.beats(Steps{9, 1, 7}));
}

TEST(Pulse, BeatsAgainOnceAllHaveGoneOn) {
  Pulse pulse;
  EXPECT_TRUE(pulse.beats(Steps{1, 1}));
  EXPECT_FALSE(pulse.beats(Steps{1, 1}));
  EXPECT_FALSE(pulse.beats(Steps{900, 1}));  // the second hangs
  EXPECT_TRUE(pulse.beats(Steps{901, 2}));
}

// Two threads, whose server is supervised on a thread of its own.
class Supervised : public testing::Test {
 protected:
  Supervised() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~Supervised() override {
    if (thread_.joinable()) end();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  void begin(const ServiceManager& manager) {
    thread_ = std::jthread([this, &manager] {
      Supervision supervision(manager, [this] {
        ++looks_;
        return Steps{first_.load(), second_.load()};
      });
      supervision.on_reload([this] { ++reloads_; });
      signal_ = supervision.await(signals_, "2 radars on the air");
    });
  }
  // To that thread alone, as to a process of which it is the only one that waits.
  void signal(int number) { pthread_kill(thread_.native_handle(), number); }
  int end(int number = SIGTERM) {
    signal(number);
    thread_.join();
    return signal_;
  }
  void await_looks(int more) {
    for (const int until = looks_ + more; looks_ < until;) std::this_thread::yield();
  }

  test::NotifySocket socket_;
  std::atomic<std::uint64_t> first_{0}, second_{0};
  std::atomic<int> looks_{0}, reloads_{0};

 private:
  sigset_t signals_{}, before_{};
  int signal_ = 0;
  std::jthread thread_;
};

constexpr const char* kReady = "READY=1\nSTATUS=2 radars on the air\n";
constexpr const char* kAlive = "WATCHDOG=1\n";
constexpr const char* kStopping = "STOPPING=1\nSTATUS=stopping\n";

TEST_F(Supervised, IsReadyWhenAllHaveBegun) {
  const ServiceManager manager(socket_.path());
  begin(manager);
  await_looks(3);
  first_ = 1;
  await_looks(3);
  EXPECT_THAT(socket_.told(), IsEmpty());
  second_ = 1;
  EXPECT_EQ(socket_.next(), kReady);
  EXPECT_EQ(end(), SIGTERM);
  EXPECT_THAT(socket_.told(), ElementsAre(kStopping));
}

TEST_F(Supervised, FeedsTheWatchdogOnlyWhileAllGoOn) {
  const ServiceManager manager(socket_.path(), microseconds(4000));
  first_ = second_ = 1;
  begin(manager);
  EXPECT_EQ(socket_.next(), kReady);
  for (int i = 0; i < 3; ++i) {
    ++first_;
    ++second_;
    EXPECT_EQ(socket_.next(), kAlive);
  }
  for (int i = 0; i < 10; ++i) {  // the second one hangs
    ++first_;
    await_looks(2);
  }
  EXPECT_THAT(socket_.told(), IsEmpty());
  ++second_;
  EXPECT_EQ(socket_.next(), kAlive);
  EXPECT_EQ(end(SIGINT), SIGINT);
}

TEST_F(Supervised, ReadsFilesAgainOnSighup) {
  const ServiceManager manager(socket_.path());
  first_ = second_ = 1;
  begin(manager);
  EXPECT_EQ(socket_.next(), kReady);
  signal(SIGHUP);
  EXPECT_THAT(socket_.next(), StartsWith("RELOADING=1\nMONOTONIC_USEC="));
  EXPECT_EQ(socket_.next(), kReady);
  EXPECT_EQ(reloads_, 1);
  EXPECT_EQ(end(), SIGTERM);
}

TEST_F(Supervised, DoesNotSayReadyForAReloadBeforeItIs) {
  const ServiceManager manager(socket_.path());
  begin(manager);
  signal(SIGHUP);
  EXPECT_THAT(socket_.next(), StartsWith("RELOADING=1\n"));
  await_looks(3);
  EXPECT_THAT(socket_.told(), IsEmpty());
}

TEST_F(Supervised, LooksAtNothingWhereNobodyIsTold) {
  const ServiceManager manager("");
  begin(manager);
  signal(SIGHUP);
  while (reloads_ == 0) std::this_thread::yield();
  EXPECT_EQ(end(), SIGTERM);
  EXPECT_EQ(looks_, 0);
}

}  // namespace
}  // namespace skerry::server
