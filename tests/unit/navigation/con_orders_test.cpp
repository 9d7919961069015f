#include "server/navigation/con_orders.hpp"

#include <gtest/gtest.h>

#include "server/navigation/navigation_listener.hpp"
#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

// What a line orders, as a short text of the message.
std::string order_of(const std::string& between) {
  NavigationListener listener{std::chrono::seconds(10)};
  const HeardLine heard =
      listener.hear("$" + between + "*" + nmea::checksum_text(between), ScenarioTime{});
  EXPECT_EQ(heard.fault, "") << between;
  EXPECT_FALSE(heard.fix) << between;
  return heard.command ? con_order_of(*heard.command).ShortDebugString() : "nothing";
}

TEST(ConOrders, AnAutopilotOutsideSteers) {
  EXPECT_EQ(order_of("AGHTC,V,,,H,N,,,,,92.5,,,T,C"), "heading_deg: 92.5");
  EXPECT_EQ(order_of("AGHTC,V,12.5,L,M,,,,,,,,,,C"), "rudder_deg: -12.5");
  EXPECT_EQ(order_of("AGHTC,V,,,M,,,,,,,,,,C"), "steering: STEERING_HAND");
  EXPECT_EQ(order_of("AGHTC,V,,,S,N,,,,,92.5,,,T,R"), "nothing") << "a report";
}

TEST(ConOrders, ABridgeOutsideMovesRudderEngineAndThrusters) {
  EXPECT_EQ(order_of("RCROR,-12.5,A,,V,B"), "rudder_deg: -12.5");
  EXPECT_EQ(order_of("RCROR,60,A,,V,B"), "rudder_deg: 35") << "hard over";
  EXPECT_EQ(order_of("RCETL,,O,04,30,B,1"), "engine_percent: 80");
  EXPECT_EQ(order_of("RCETL,,O,04,30,B,2"), "") << "the port shaft moves with the other";
}

TEST(ConOrders, WhatCannotBeReadIsAFault) {
  NavigationListener listener{std::chrono::seconds(10)};
  const std::string line = "AGHTC,V,,,H,N,,,,,92.5,,,M,C";
  const HeardLine heard = listener.hear("$" + line + "*" + nmea::checksum_text(line), {});
  EXPECT_NE(heard.fault, "");
  EXPECT_FALSE(heard.command);
}

}  // namespace
}  // namespace skerry::server
