// Hosts that have to ask somebody else: what a client sees until they have the answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <utility>

#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

// Answers when the test says so, from the test's thread.
class AskingHost final : public FakeHost {
 public:
  std::optional<wire::Reply> apply_or_ask(const wire::Set&, const std::string&,
                                          const Answered& later) override {
    const std::lock_guard lock(mutex_);
    asked_.push_back(later);
    return std::nullopt;
  }
  std::optional<OpenedView> open_view_or_ask(std::uint32_t radar, std::uint32_t like,
                                             const std::function<void(VideoChannel&)>& prepare,
                                             const ViewOpened& later) override {
    const auto view = open_view(radar, like, false, prepare);
    const std::lock_guard lock(mutex_);
    opening_.push_back([view, later] { later(*view); });
    return std::nullopt;
  }
  void leave(const std::string&) override { ++leaves_; }
  int leaves() const { return leaves_; }
  std::vector<wire::HopStatus> hops() const override {
    wire::HopStatus hop;
    hop.set_upstream("192.0.2.7:7410");
    return {hop};
  }
  void await_asked(std::size_t count) {
    ASSERT_TRUE(wait_until([&] {
      const std::lock_guard lock(mutex_);
      return asked_.size() + opening_.size() == count;
    }));
  }
  void answer(std::size_t which, wire::Reply::Code code, const std::string& text = {}) {
    wire::Reply reply;
    reply.set_code(code);
    reply.set_text(text);
    const std::lock_guard lock(mutex_);
    asked_.at(which)(reply);
  }
  void open(std::size_t which) {
    const std::lock_guard lock(mutex_);
    opening_.at(which)();
  }

 private:
  std::atomic<int> leaves_{0};
  std::mutex mutex_;
  std::vector<Answered> asked_;
  std::vector<std::function<void()>> opening_;
};

NetConfig with_few_views() {
  NetConfig config = test_config();
  config.foreign_addresses = {"127.0.0.1"};
  config.control_token = "secret";  // which may open views
  config.limits.views_of_peer = 2;
  return config;
}

class LaterAnswers : public testing::Test {
 protected:
  LaterAnswers() { server_.start(); }
  TestClient client() {
    TestClient client(server_.tcp_port());
    client.receive_hello();
    return client;
  }
  AskingHost host_;
  NetServer server_{host_, test_config(), {}};
};

TEST_F(LaterAnswers, ComeBeforeThoseToWhatWasAskedAfter) {
  TestClient first = client(), second = client();
  first.send(set_gain_message(1, 0, 70));
  first.send(get_status_message(2));
  host_.await_asked(1);
  EXPECT_EQ(second.get_status().server(), "fake");  // others do not wait
  host_.answer(0, wire::Reply::REFUSED, "the other server says no");
  const wire::Reply set = first.receive_reply();
  EXPECT_EQ(set.request(), 1u);
  EXPECT_EQ(set.code(), wire::Reply::REFUSED);
  EXPECT_EQ(set.text(), "the other server says no");
  EXPECT_EQ(first.receive_reply().request(), 2u);
}

TEST_F(LaterAnswers, AViewIsTheClientsOnceItIsThere) {
  TestClient console = client();
  wire::ClientMessage subscribe = subscribe_message(1, 0);
  subscribe.mutable_subscribe()->set_new_view(true);
  console.send(subscribe);
  console.send(get_status_message(2));
  host_.await_asked(1);
  host_.open(0);
  const wire::Reply reply = console.receive_reply();
  EXPECT_EQ(reply.request(), 1u);
  EXPECT_GT(reply.view(), 0u);
  EXPECT_EQ(console.receive_reply().request(), 2u);
  EXPECT_EQ(host_.view_count(0), 2u);
}

// Many at once, before any has been opened.
TEST(LaterAnswersToStrangers, ViewsThatAreBeingOpenedCount) {
  AskingHost host;
  NetServer server(host, with_few_views(), {});
  server.start();
  const auto ask = [&](TestClient& client) {
    client.receive_hello();
    wire::ClientMessage subscribe = subscribe_message(1, 0);
    subscribe.mutable_subscribe()->set_new_view(true);
    subscribe.mutable_subscribe()->set_token("secret");
    client.send(subscribe);
  };
  TestClient first(server.tcp_port()), second(server.tcp_port()), third(server.tcp_port());
  ask(first);
  host.await_asked(1);
  ask(second);
  host.await_asked(2);
  ask(third);
  const wire::Reply refused = third.receive_reply();
  EXPECT_EQ(refused.code(), wire::Reply::REFUSED);
  EXPECT_THAT(refused.text(), HasSubstr("has opened 2 views of radar 0"));
  host.open(0);
  EXPECT_EQ(first.receive_reply().code(), wire::Reply::OK);
  // One counts once, being opened or open.
  third.send(subscribe_message(2, 0));
  EXPECT_EQ(third.receive_reply().code(), wire::Reply::OK);
  host.open(1);
  EXPECT_EQ(second.receive_reply().code(), wire::Reply::OK);
  server.stop();
}

TEST_F(LaterAnswers, OfAClientThatHasGoneDoNoHarm) {
  {
    TestClient gone = client();
    gone.send(set_gain_message(1, 0, 70));
    host_.await_asked(1);
    gone.socket().reset();
  }
  host_.answer(0, wire::Reply::OK);
  {
    TestClient gone = client();
    wire::ClientMessage subscribe = subscribe_message(1, 0);
    subscribe.mutable_subscribe()->set_new_view(true);
    gone.send(subscribe);
    host_.await_asked(2);
    gone.socket().reset();
  }
  host_.open(0);
  // Nobody reads it: it ends as any other.
  EXPECT_TRUE(wait_until([&] { return host_.view_count(0) == 1; }));
}

TEST_F(LaterAnswers, WhatAClientThatHasGoneIsGrantedIsGivenBack) {
  {
    TestClient gone = client();
    gone.send(subscribe_message(1, 0));
    EXPECT_EQ(gone.receive_reply().code(), wire::Reply::OK);
    gone.send(set_gain_message(2, 0, 70));
    host_.await_asked(1);
    gone.socket().reset();
  }
  // It is found gone as spokes cannot be sent to it.
  EXPECT_TRUE(wait_until([&] {
    host_.publish();
    return host_.leaves() == 1;
  }));
  host_.answer(0, wire::Reply::OK);
  EXPECT_TRUE(wait_until([&] { return host_.leaves() == 2; }));
}

TEST_F(LaterAnswers, HopsAreTold) {
  TestClient console = client();
  wire::ClientMessage message;
  message.set_request(3);
  message.mutable_get_hops();
  std::vector<wire::HopStatus> hops;
  console.on_message = [&](const wire::ServerMessage& told) {
    for (const auto& hop : told.hops().hops()) hops.push_back(hop);
  };
  console.send(message);
  EXPECT_EQ(console.receive_reply().code(), wire::Reply::OK);
  ASSERT_EQ(hops.size(), 1u);
  EXPECT_EQ(hops[0].upstream(), "192.0.2.7:7410");
  EXPECT_EQ(console.get_status().hops_size(), 1);
}

}  // namespace
}  // namespace skerry::server
