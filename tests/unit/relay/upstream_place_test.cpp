#include "server/relay/upstream_place.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::server {
namespace {

TEST(UpstreamPlace, HostAndPortWithOrWithoutTls) {
  const auto plain = upstream_place("192.0.2.7:7410");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->host, "192.0.2.7");
  EXPECT_EQ(plain->port, 7410);
  EXPECT_EQ(plain->name(), "192.0.2.7:7410");
  const auto secure = upstream_place("tls://bridge:1");
  ASSERT_TRUE(secure);
  EXPECT_EQ(secure->host, "tls://bridge");
  EXPECT_EQ(secure->name(), "bridge:1");
  const auto v6 = upstream_place("[2001:db8::7]:65535");
  ASSERT_TRUE(v6);
  EXPECT_EQ(v6->host, "2001:db8::7");
  EXPECT_EQ(v6->name(), "[2001:db8::7]:65535");
}

TEST(UpstreamPlace, WhatIsNoneSaysWhatIsExpected) {
  for (const char* text :
       {"", "bridge", ":7410", "bridge:", "bridge:0", "bridge:65536", "bridge:x",
        "2001:db8::7:7410", "http://bridge:7410", "tls://:7410", "bridge:7410/"}) {
    const auto place = upstream_place(text);
    EXPECT_FALSE(place.ok()) << text;
    if (place) continue;
    EXPECT_THAT(place.error(), testing::HasSubstr("expected HOST:PORT"));
  }
}

TEST(UpstreamPlace, TheWaitForAServerIsToldAndCanBeGivenUp) {
  int told = 0, pauses = 0;
  const auto hello = first_hello(
      {"127.0.0.1", 1}, Tries::until_it_is_there, [&](auto) { return ++pauses == 3; },
      [&](const std::string& why) {
        ++told;
        EXPECT_THAT(why, testing::HasSubstr("127.0.0.1:1"));
      });
  EXPECT_FALSE(hello);
  EXPECT_EQ(pauses, 3);
  EXPECT_EQ(told, 1);  // at most every few seconds
}

}  // namespace
}  // namespace skerry::server
