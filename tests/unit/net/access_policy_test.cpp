#include "server/net/common/access_policy.hpp"

#include <gtest/gtest.h>

#include <array>

namespace skerry::server {
namespace {

TEST(AccessPolicy, HostNameDropsPortBracketsAndCase) {
  EXPECT_EQ(host_name("localhost"), "localhost");
  EXPECT_EQ(host_name("LocalHost:7480"), "localhost");
  EXPECT_EQ(host_name("127.0.0.1:7480"), "127.0.0.1");
  EXPECT_EQ(host_name("[::1]:7480"), "::1");
  EXPECT_EQ(host_name("[::1]"), "::1");
  for (const char* none : {"", ":7480", "::1", "[::1", "[::1]x", "a:b:c"}) {
    EXPECT_EQ(host_name(none), "") << none;
  }
}

TEST(AccessPolicy, OnlyNamesOfThisServerAreServed) {
  const std::array<std::string, 1> names = {"Radar.Example"};
  const HostPolicy loopback{.allowed_hosts = names, .any_ip_literal = false};
  const HostPolicy open{.allowed_hosts = names, .any_ip_literal = true};
  for (const char* host :
       {"localhost", "localhost:7480", "127.0.0.1:7480", "[::1]:7480", "radar.example:7480"}) {
    EXPECT_FALSE(host_refusal(host, loopback)) << host;
    EXPECT_FALSE(host_refusal(host, open)) << host;
  }
  for (const char* host : {"192.0.2.2:7480", "[2001:db8::1]:7480"}) {
    EXPECT_TRUE(host_refusal(host, loopback)) << host;
    EXPECT_FALSE(host_refusal(host, open)) << host;
  }
  for (const char* host : {"", ":7480", "evil.example:7480", "localhost.evil.example",
                           "127.0.0.1.evil.example", "evil.example/localhost"}) {
    EXPECT_TRUE(host_refusal(host, loopback)) << host;
    EXPECT_TRUE(host_refusal(host, open)) << host;
  }
}

TEST(AccessPolicy, OnlyPagesOfThisServerMayOpenAWebSocket) {
  EXPECT_FALSE(origin_refusal(std::nullopt, "localhost:7480")) << "no browser";
  EXPECT_FALSE(origin_refusal("http://localhost:7480", "localhost:7480"));
  EXPECT_FALSE(origin_refusal("https://LOCALHOST:7480", "localhost:7480"));
  EXPECT_FALSE(origin_refusal("ws://localhost:7480", "localhost:7480")) << "IXWebSocket";
  EXPECT_FALSE(origin_refusal("wss://localhost:7480", "localhost:7480"));
  for (const char* origin :
       {"", "null", "http://evil.example", "http://localhost", "http://localhost:74800",
        "http://localhost:7480.evil.example", "ws://evil.example", "ws://localhost",
        "wss://localhost:7480.evil.example", "ftp://localhost:7480", "localhost:7480"}) {
    EXPECT_TRUE(origin_refusal(origin, "localhost:7480")) << origin;
  }
}

TEST(AccessPolicy, RefusalsRepeatForeignTextWithoutControlCharacters) {
  const auto refusal = host_refusal("evil\r\nX: y\x1b[2J", HostPolicy{});
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->find_first_of("\r\n\x1b"), std::string::npos);
}

}  // namespace
}  // namespace skerry::server
