#include "server/app/options/fleet_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options/options.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Options read_fleet(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "skerryd");
  return *read_options(static_cast<int>(arguments.size()), arguments.data());
}
std::string fleet_refusal(const std::vector<const char*>& arguments) {
  try {
    read_fleet(arguments);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(FleetOptions, OfTheCommandLineAndTheFile) {
  EXPECT_THAT(read_fleet({}).fleet.store, IsEmpty());
  const FleetOptions line = read_fleet({"--fleet", "a:1,[::1]:2", "--fleet-exercise", "kattegat-7",
                                        "--fleet-host", "bridge-1"})
                                .fleet;
  EXPECT_THAT(line.store, ElementsAre("a:1", "[::1]:2"));
  EXPECT_EQ(line.exercise, "kattegat-7");
  EXPECT_EQ(line.host, "bridge-1");
  EXPECT_EQ(line.address, "127.0.0.1");
  const std::string file = testing::TempDir() + "/skerry_fleet_options.yaml";
  std::ofstream(file) << "fleet: {store: [\"x:1\", \"y:2\"], host: h, address: bridge}\n";
  const FleetOptions both = read_fleet({"--config", file.c_str(), "--fleet", "z:3"}).fleet;
  EXPECT_THAT(both.store, ElementsAre("z:3"));
  EXPECT_EQ(both.host, "h");
  EXPECT_EQ(both.address, "bridge");
  EXPECT_EQ(both.exercise, "exercise");
  EXPECT_THAT(read_fleet({"--config", file.c_str(), "--relay", "b:1"}).fleet.store, IsEmpty());
}

TEST(FleetOptions, WhatMakesNoSenseIsRefused) {
  EXPECT_THAT(fleet_refusal({"--fleet", "a"}), HasSubstr("expected HOST:PORT"));
  EXPECT_THAT(fleet_refusal({"--fleet", "a:1,:2"}), HasSubstr("\":2\""));
  EXPECT_THAT(fleet_refusal({"--fleet-host", "a"}), HasSubstr("over which store?"));
  EXPECT_THAT(fleet_refusal({"--fleet", "a:1", "--fleet-host", "a b"}),
              HasSubstr("--fleet-host \"a b\""));
  EXPECT_THAT(fleet_refusal({"--fleet", "a:1", "--fleet-exercise", "x/y"}),
              HasSubstr("--fleet-exercise"));
  EXPECT_THAT(fleet_refusal({"--fleet", "a:1", "--play", "x"}), HasSubstr("--play and --fleet"));
  EXPECT_THAT(fleet_refusal({"--fleet", "a:1", "--input", "nmea0183:port=10111"}),
              HasSubstr("--input and --fleet"));
}

}  // namespace
}  // namespace skerry::server
