#include "server/app/options/relay_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options/options.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

Options read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "skerryd");
  return *read_options(static_cast<int>(arguments.size()), arguments.data());
}
std::string relay_refusal(const std::vector<const char*>& arguments) {
  try {
    read(arguments);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(RelayOptions, OfTheCommandLineAndTheFile) {
  EXPECT_EQ(read({}).relay.place.host, "");
  const Options line = read({"--relay", "tls://bridge:7411"});
  EXPECT_EQ(line.relay.place.host, "tls://bridge");
  EXPECT_EQ(line.relay.place.port, 7411);
  const std::string file = testing::TempDir() + "/skerry_relay_options.yaml";
  std::ofstream(file) << "relay: {server: \"bridge:7411\"}\n";
  EXPECT_EQ(read({"--config", file.c_str()}).relay.place.name(), "bridge:7411");
  EXPECT_EQ(read({"--config", file.c_str(), "--relay", "other:1"}).relay.place.name(), "other:1");
  EXPECT_EQ(read({"--config", file.c_str(), "--scenario", "x.yaml"}).relay.place.host, "");
  EXPECT_EQ(read({"--config", file.c_str(), "--play", "x.mcap"}).relay.place.host, "");
  std::ofstream(file) << "scenario: x.yaml\n";
  EXPECT_EQ(read({"--config", file.c_str(), "--relay", "other:1"}).scenario, "");
}

TEST(RelayOptions, TheTokenIsOfAFileOrOfTheEnvironment) {
  ::setenv("SKERRY_TOKEN", "of the environment", 1);
  EXPECT_EQ(read({"--relay", "bridge:7411"}).relay.token, "of the environment");
  const std::string file = testing::TempDir() + "/skerry_relayed.token";
  std::ofstream(file) << "of the file\r\nmore\n";
  EXPECT_EQ(read({"--relay", "bridge:7411", "--relay-token-file", file.c_str()}).relay.token,
            "of the file");
  ::unsetenv("SKERRY_TOKEN");
  EXPECT_EQ(read({"--relay", "bridge:7411"}).relay.token, "");
  std::ofstream(file) << "\n";
  EXPECT_THAT(relay_refusal({"--relay", "bridge:7411", "--relay-token-file", file.c_str()}),
              HasSubstr("expected a token"));
  EXPECT_THAT(relay_refusal({"--relay-token-file", file.c_str()}), HasSubstr("of which server?"));
}

TEST(RelayOptions, WhatARelayCannotDoIsRefused) {
  EXPECT_THAT(relay_refusal({"--relay", "bridge"}), HasSubstr("expected HOST:PORT"));
  EXPECT_THAT(relay_refusal({"--relay", "b:1", "--scenario", "x"}),
              HasSubstr("--scenario and --relay"));
  EXPECT_THAT(relay_refusal({"--relay", "b:1", "--play", "x"}), HasSubstr("--play and --relay"));
  EXPECT_THAT(relay_refusal({"--relay", "b:1", "--verify", "x"}),
              HasSubstr("--verify and --relay"));
  EXPECT_THAT(relay_refusal({"--relay", "b:1", "--workers", "2"}),
              HasSubstr("a relay makes no video"));
  EXPECT_THAT(relay_refusal({"--relay", "localhost:7410"}), HasSubstr("own port"));
  EXPECT_THAT(relay_refusal({"--relay", "127.0.0.1:7410"}), HasSubstr("own port"));
  EXPECT_EQ(relay_refusal({"--relay", "127.0.0.1:7410", "--tcp-port", "7411"}), "");
  EXPECT_EQ(relay_refusal({"--relay", "192.0.2.7:7410"}), "");
}

}  // namespace
}  // namespace skerry::server
