#include "server/relay/host_lookup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "server/relay/upstream_links.hpp"
#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

// A name server that says nothing until the test lets it.
class DeadNames {
 public:
  HostLookup::Resolve resolve() {
    return [state = state_](const std::string&, std::uint16_t port) {
      ++state->asked;
      state->released.wait();
      return HostAddresses{{}, {{boost::asio::ip::address_v4::loopback(), port}}};
    };
  }
  bool await_asked() const {
    for (int i = 0; i < 500 && state_->asked == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return state_->asked > 0;
  }
  int asked() const { return state_->asked; }
  void release() { state_->release.set_value(); }

 private:
  struct State {
    std::atomic<int> asked{0};
    std::promise<void> release;
    std::shared_future<void> released = release.get_future().share();
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

template <typename Do>
double seconds_of(const Do& act) {
  const auto began = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

TEST(HostLookup, AnAddressIsItself) {
  boost::asio::io_context io;
  for (const char* name : {"192.0.2.7", "2001:db8::7"}) {
    HostLookup lookup(io, name, 7410, [](const auto&, auto) -> HostAddresses {
      ADD_FAILURE() << "nobody is to be asked";
      return {};
    });
    int answers = 0;
    lookup.find([&](const HostAddresses& found) {
      ++answers;
      ASSERT_EQ(found.places.size(), 1u);
      EXPECT_EQ(found.places[0].address().to_string(), name);
      EXPECT_EQ(found.places[0].port(), 7410);
    });
    EXPECT_EQ(answers, 0);  // later
    io.restart();
    io.run();
    EXPECT_EQ(answers, 1);
  }
}

TEST(HostLookup, TheSystemKnowsThisHost) {
  const HostAddresses found = HostLookup::resolve_by_system("localhost", 7410);
  EXPECT_FALSE(found.error) << found.error.message();
  ASSERT_FALSE(found.places.empty());
  EXPECT_TRUE(found.places[0].address().is_loopback());
}

TEST(HostLookup, WhoAsksMeanwhileHasTheSameAnswer) {
  boost::asio::io_context io;
  DeadNames names;
  HostLookup lookup(io, "bridge", 7410, names.resolve());
  int answers = 0;
  for (int i = 0; i < 3; ++i) {
    lookup.find([&](const HostAddresses& found) {
      EXPECT_EQ(found.places.size(), 1u);
      ++answers;
    });
  }
  ASSERT_TRUE(names.await_asked());
  io.poll();
  EXPECT_EQ(answers, 0);
  names.release();
  for (int i = 0; i < 500 && answers < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    io.restart();
    io.poll();
  }
  EXPECT_EQ(answers, 3);
  EXPECT_EQ(names.asked(), 1);
}

TEST(HostLookup, AfterItsEndNobodyIsAnswered) {
  DeadNames names;
  {
    boost::asio::io_context io;
    HostLookup lookup(io, "bridge", 7410, names.resolve());
    lookup.find([](const HostAddresses&) { ADD_FAILURE() << "it has ended"; });
    ASSERT_TRUE(names.await_asked());
  }
  names.release();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // for sanitizers to see
}

TEST(HostLookup, TheEndOfARelayDoesNotWaitForADeadNameServer) {
  RelayUnderTest relay;
  DeadNames names;
  auto links = std::make_unique<UpstreamLinks>(relay.host, UpstreamPlace{"bridge", 7410}, "", 0,
                                               names.resolve());
  links->start();
  ASSERT_TRUE(names.await_asked());
  std::thread late([&] {
    std::this_thread::sleep_for(std::chrono::seconds(3));
    names.release();
  });
  EXPECT_LT(seconds_of([&] { links.reset(); }), 1.0);
  late.join();
}

TEST(HostLookup, TheWaitAtTheStartIsGivenUpAtOnceAndIsBounded) {
  DeadNames names;
  int pauses = 0;
  HostAddresses found;
  const auto pause = [](std::chrono::milliseconds time) { std::this_thread::sleep_for(time); };
  EXPECT_LT(seconds_of([&] {
              found = find_host(
                  "bridge", 7410, std::chrono::seconds(20),
                  [&](auto time) {
                    pause(time);
                    return ++pauses == 3;
                  },
                  names.resolve());
            }),
            1.0);
  EXPECT_EQ(found.error, boost::asio::error::operation_aborted);
  EXPECT_LT(seconds_of([&] {
              found = find_host(
                  "bridge", 7410, std::chrono::milliseconds(100),
                  [&](auto time) {
                    pause(time);
                    return false;
                  },
                  names.resolve());
            }),
            2.0);
  EXPECT_EQ(found.error, boost::asio::error::timed_out);
  names.release();
}

}  // namespace
}  // namespace skerry::server
