// What clients are told of a fleet, and what pages of its other hosts may.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>

#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::array<WebFile, 1> kPage = {
    {{"/index.html", "text/html; charset=utf-8", "<p>console</p>"}}};

class HostOfAFleet : public FakeHost {
 public:
  HostOfAFleet() {
    fleet_.set_host("a");
    add("a", "http://192.0.2.1:7480/");
    add("b", "http://192.0.2.2:7480/");
  }
  void add(const std::string& name, const std::string& web) {
    const std::lock_guard lock(mutex_);
    wire::FleetHost* host = fleet_.add_hosts();
    host->set_name(name);
    host->set_web(web);
    version_.fetch_add(1);
  }
  std::optional<wire::Fleet> fleet() const override {
    const std::lock_guard lock(mutex_);
    return fleet_;
  }
  std::uint64_t fleet_version() const override { return version_.load(); }

 private:
  mutable std::mutex mutex_;
  wire::Fleet fleet_;
  std::atomic<std::uint64_t> version_{1};
};

class FleetNews : public testing::Test {
 protected:
  FleetNews() { server_.start(); }
  std::string upgrade_from(const std::string& origin) {
    return http_exchange(server_.http_port(),
                         "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                         "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: " +
                             origin + "\r\n\r\n");
  }
  HostOfAFleet host_;
  NetServer server_{host_, test_config(), kPage};
};

TEST_F(FleetNews, AreInHelloAndInTheStatusAndComeAnewWhenSomethingChanges) {
  TestClient client(server_.tcp_port());
  EXPECT_EQ(client.receive_hello().fleet().hosts_size(), 2);
  client.send(subscribe_message(1, 0));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  host_.add("c", "http://192.0.2.3:7480/");
  for (;;) {
    const auto message = client.receive();
    ASSERT_TRUE(message);
    if (!message->has_fleet()) continue;
    EXPECT_EQ(message->fleet().hosts_size(), 3);
    break;
  }
  EXPECT_EQ(client.get_status().fleet().host(), "a");
}

TEST_F(FleetNews, APageMayConnectToTheOtherHosts) {
  const std::string page = http_get(server_.http_port(), "/");
  EXPECT_THAT(page, HasSubstr("object-src 'none'; connect-src 'self' http://192.0.2.2:7480 "
                              "ws://192.0.2.2:7480\r\n"));
  EXPECT_THAT(page, Not(HasSubstr("192.0.2.1")));
  EXPECT_THAT(http_get(server_.http_port(), "/status"), Not(HasSubstr("connect-src")));
}

TEST_F(FleetNews, WhatAHostTellsOfItselfIsNoMoreThanAnOrigin) {
  for (const char* const bad :
       {"http://x/; script-src *", "javascript:alert(1)/", "http://x", "http://x/ y/", "http://*/",
        "httpx://x/", "http://x\r\nSet-Cookie: a=b/", "http://'x'/"}) {
    host_.add("d", bad);
  }
  const std::string page = http_get(server_.http_port(), "/");
  EXPECT_THAT(page, HasSubstr("connect-src 'self' http://192.0.2.2:7480 ws://192.0.2.2:7480\r\n"));
}

TEST_F(FleetNews, APageOfAnotherHostMayOpenAWebSocketAndNobodyElses) {
  EXPECT_THAT(upgrade_from("http://192.0.2.2:7480"), StartsWith("HTTP/1.1 101"));
  for (const char* const other : {"http://192.0.2.2", "https://192.0.2.2:7480",
                                  "http://192.0.2.2:7481", "http://evil.example", "null"}) {
    EXPECT_THAT(upgrade_from(other), StartsWith("HTTP/1.1 403")) << other;
  }
}

}  // namespace
}  // namespace skerry::server
