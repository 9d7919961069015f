// Navigation data as another program sends and receives it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <stdexcept>
#include <string>

#include "protocol/nmea/sentence.hpp"
#include "protocol/nmea/udp450.hpp"
#include "server/net/navigation/navigation_input.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/navigation_host.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using enum NavigationSentence;

constexpr std::uint32_t kLoopback = ipv4(127, 0, 0, 1);

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::string line_of(const std::string& between) {
  return "$" + between + "*" + nmea::checksum_text(between) + "\r\n";
}

// Whether all whole lines of a text are good sentences; their formatters.
std::set<std::string> formatters_of(const std::string& text) {
  std::set<std::string> kinds;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) break;
    const std::string line = text.substr(at, end - at);
    const auto sentence = nmea::parse_sentence(line);
    EXPECT_TRUE(sentence) << line;
    if (sentence) kinds.insert(std::string(sentence->formatter));
    at = end + 1;
  }
  return kinds;
}

std::string received_text(DisplaySocket& socket) {
  const auto datagram = socket.receive();
  if (!datagram) throw std::runtime_error("no datagram came");
  return text_of(datagram->payload);
}

// The status of the only navigation input or output.
wire::OutputStatus output_status(const NetServer& server) {
  const wire::Status status = server.status();
  return status.outputs_size() == 1 ? status.outputs(0) : wire::OutputStatus();
}

std::uint16_t port_in(const std::string& address) {
  return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

NavigationOutputConfig an_output() {
  NavigationOutputConfig config;
  config.plan.periods = {{rmc, 50ms}, {hdt, 50ms}, {vdm, 50ms}, {vdo, 50ms}, {zda, 50ms}};
  return config;
}

TEST(NavigationOutput, TwoVesselsHaveTwoNumbers) {
  NavigationHost host;
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].port = 10'110;
  config.navigation_outputs[0].plan.own_mmsi = 257'000'222;
  try {
    const NetServer server(host, config, {});
    FAIL() << "own ship has the number of the tanker";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("257000222 is also that of \"Tanker\""));
  }
  config.navigation_outputs[0].plan.own_mmsi = 257'000'111;
  NavigationHost another;
  EXPECT_NO_THROW(NetServer(another, config, {})) << "own ship's own";
}

TEST(NavigationOutput, NobodyListeningIsNoError) {
  std::uint16_t port = 0;
  { port = DisplaySocket({kLoopback, 0}, kLoopback).port(); }
  NavigationHost host;
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].port = port;
  NetServer server(host, config, {});
  server.start();
  ASSERT_TRUE(wait_until([&] { return output_status(server).datagrams_unsent() > 0; }));
  EXPECT_EQ(server.status().errors().count("nmea send"), 0u);
}

TEST(NavigationOutput, SendsItsSentencesAsDatagrams) {
  NavigationHost host;
  DisplaySocket display({}, kLoopback);
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].port = display.port();
  NetServer server(host, config, {});
  server.start();
  std::set<std::string> seen;
  std::string all;
  while (seen.size() < 5) {
    const std::string text = received_text(display);
    all += text;
    ASSERT_TRUE(text.ends_with("\r\n"));
    seen.merge(formatters_of(text));
  }
  EXPECT_EQ(seen, (std::set<std::string>{"HDT", "RMC", "VDM", "VDO", "ZDA"}));
  EXPECT_NE(all.find("$GPRMC,090807.06,A,6025.50000,N,00502.40000,E,12.00,335.0,211126"),
            std::string::npos);
  const wire::OutputStatus status = output_status(server);
  EXPECT_EQ(status.name(), "nmea_udp");
  EXPECT_EQ(status.address(), "127.0.0.1:" + std::to_string(display.port()));
  EXPECT_GT(status.reports(), 0u);
  EXPECT_GT(status.bytes(), 0u);
  EXPECT_EQ(status.datagrams_unsent(), 0u);
}

TEST(NavigationOutput, OwnShipIsNoTargetOfHerOwn) {
  NavigationHost host;
  DisplaySocket display({}, kLoopback);
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].port = display.port();
  config.navigation_outputs[0].plan.periods = {{ttm, 20ms}};
  config.navigation_outputs[0].plan.targets = TargetSource::truth;
  NetServer server(host, config, {});
  server.start();
  for (int i = 0; i < 5; ++i) {
    const std::string text = received_text(display);
    EXPECT_TRUE(text.starts_with("$RATTM,01,")) << text;
    EXPECT_NE(text.find("Tanker"), std::string::npos) << text;
  }
}

TEST(NavigationOutput, A450OutputSendsEachSentenceToItsGroup) {
  NavigationHost host;
  // The groups are fixed, and other programs of this host may use them: only what has our source.
  const std::string source = "RA4711";
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].transport = NavigationTransport::iec450;
  config.navigation_outputs[0].address.clear();
  config.navigation_outputs[0].source = source;
  NetServer server(host, config, {});
  server.start();
  const std::pair<nmea::Udp450Group, std::set<std::string>> groups[] = {
      {nmea::Udp450Group::navigation, {"RMC"}},
      {nmea::Udp450Group::fast, {"HDT"}},
      {nmea::Udp450Group::targets, {"VDM", "VDO"}},
      {nmea::Udp450Group::time, {"ZDA"}}};
  for (const auto& [group, expected] : groups) {
    DisplaySocket display(nmea::address_of(group), kLoopback);
    std::set<std::string> seen;
    for (int i = 0; i < 8 || seen.size() < expected.size(); ++i) {
      const auto datagram = display.receive();
      ASSERT_TRUE(datagram);
      const auto lines = nmea::decode_udp450(datagram->payload);
      ASSERT_TRUE(lines) << lines.error().text;
      for (const nmea::TaggedLine& line : *lines) {
        if (line.source != source) continue;
        seen.merge(formatters_of(line.sentence + "\r\n"));
      }
    }
    EXPECT_EQ(seen, expected) << text_of(nmea::address_of(group));
  }
  EXPECT_EQ(output_status(server).name(), "nmea_450");
}

TEST(NavigationOutput, ATcpServerGivesLinesToAllWhoConnect) {
  NavigationHost host;
  NetConfig config = test_config();
  config.navigation_outputs = {an_output()};
  config.navigation_outputs[0].transport = NavigationTransport::tcp;
  config.navigation_outputs[0].port = 0;
  config.navigation_outputs[0].max_connections = 2;
  NetServer server(host, config, {});
  server.start();
  const std::uint16_t port = port_in(output_status(server).address());
  const auto read_some = [](TestSocket& socket) {
    std::string text;
    while (text.size() < 3000) {
      const Bytes bytes = socket.receive(1024);
      if (bytes.empty()) throw std::runtime_error("the server has closed");
      text.append(bytes.begin(), bytes.end());
    }
    return text;
  };
  TestSocket first(port), second(port);
  first.send(std::string("what a display says here is thrown away\r\n"));
  for (TestSocket* socket : {&first, &second}) {
    const std::string text = read_some(*socket);
    const auto kinds = formatters_of(text.substr(text.find('\n') + 1));
    EXPECT_TRUE(kinds.contains("RMC"));
    EXPECT_TRUE(kinds.contains("VDM"));
  }
  TestSocket third(port);
  EXPECT_EQ(third.receive_all(), "") << "two connections at most";
  EXPECT_EQ(server.status().errors().at("NMEA output refused"), 1u);
  second.close();
  // Its place is free once the server has noticed.
  ASSERT_TRUE(wait_until([&] {
    TestSocket again(port);
    return !again.receive(64).empty();
  }));
}

TEST(NavigationOutput, AReceiverThatDoesNotReadLosesLinesAndHoldsNobodyUp) {
  NavigationHost host;
  DisplaySocket display({}, kLoopback);
  NetConfig config = test_config();
  NavigationOutputConfig tcp = an_output();
  tcp.transport = NavigationTransport::tcp;
  tcp.port = 0;
  for (std::size_t i = 0; i < kNavigationSentences; ++i) {
    tcp.plan.periods[static_cast<NavigationSentence>(i)] = 20ms;
  }
  NavigationOutputConfig udp = an_output();
  udp.port = display.port();
  config.navigation_outputs = {tcp, udp};
  NetServer server(host, config, {});
  server.start();
  std::uint16_t port = 0;
  const wire::Status status = server.status();
  for (const auto& output : status.outputs()) {
    if (output.name() == "nmea_tcp") port = port_in(output.address());
  }
  TestSocket asleep(port, 2048);
  ASSERT_TRUE(wait_until([&] { return server.status().outputs(0).datagrams_unsent() > 100; }));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(received_text(display).empty());
}

std::string refusal(const NetConfig& config) {
  NavigationHost host;
  try {
    NetServer server(host, config, {});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(NavigationOutput, WrongConfigurationsAreNamed) {
  const auto refused = [](auto change) {
    NetConfig config = test_config();
    config.navigation_outputs = {an_output()};
    change(config.navigation_outputs[0]);
    return refusal(config);
  };
  using Config = NavigationOutputConfig;
  EXPECT_NE(refused([](Config& c) { c.radar = 7; }).find("no such radar"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.address = "plotter"; }).find("literal"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.port = 0; }).find("1 to 65535"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.multicast_ttl = 256; }).find("TTL"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.source = "radar"; }).find("source"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.max_connections = 65; }).find("64"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.plan.periods[hdt] = 1ms; }).find("hdt"), std::string::npos);
  EXPECT_NE(refused([](Config& c) { c.address = "255.255.255.255"; }).find("`broadcast`"),
            std::string::npos);
  EXPECT_EQ(refused([](Config& c) {
              c.address = "127.255.255.255";
              c.broadcast = true;
            }),
            "accepted");
  EXPECT_NE(refused([](Config& c) {
              c.address = "239.1.1.1";
              c.interface_address = "203.0.113.9";
            }).find("203.0.113.9"),
            std::string::npos);
}

// A server with one input, and a simulator that sends to it.
class NavigationInputTest : public testing::Test {
 protected:
  void start(const NavigationInputConfig& input) {
    NetConfig config = test_config();
    config.navigation_inputs = {input};
    server.emplace(host, config, std::span<const WebFile>{});
    server->start();
    port = port_in(output_status(*server).address());
  }
  void send(const std::string& text) { simulator.send({kLoopback, port}, text); }
  std::uint64_t errors(const std::string& kind) const {
    const auto counts = server->status().errors();
    const auto found = counts.find(kind);
    return found == counts.end() ? 0 : found->second;
  }
  // Waits for the fix of a heading that only this one has.
  bool heading_comes(double heading) {
    return wait_until([&] {
      send(line_of("HEHDT," + std::to_string(heading) + ",T"));
      const auto fixes = host.fixes();
      return !fixes.empty() && fixes.back().heading_deg == heading;
    });
  }

  NavigationHost host{2};
  std::optional<NetServer> server;
  DisplaySocket simulator{{}, kLoopback};
  std::uint16_t port = 0;
};

TEST_F(NavigationInputTest, DrivesOwnShip) {
  start({});
  send(line_of("GPRMC,092204,A,6024.000,N,00519.200,E,10.0,84.5,211126,,,A") +
       line_of("HEHDT,84.0,T") + line_of("TIROT,-3.0,A"));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 3; }));
  const auto fixes = host.fixes();
  EXPECT_EQ(fixes[0].position, (GeoPoint{60.4, 5.32}));
  EXPECT_EQ(fixes[1].heading_deg, 84.0);
  EXPECT_EQ(fixes[2].rate_of_turn_deg_min, -3.0);
  const wire::OutputStatus status = output_status(*server);
  EXPECT_EQ(status.name(), "nmea_input");
  EXPECT_EQ(status.commands(), 1u);
  EXPECT_EQ(status.commands_refused(), 0u);
  EXPECT_TRUE(status.last_display().starts_with("127.0.0.1:")) << status.last_display();
}

TEST_F(NavigationInputTest, Reads450DatagramsToo) {
  start({});
  nmea::Udp450Encoder encoder("GP0001");
  const std::vector<std::string> lines = {line_of("HEHDT,84.0,T"), line_of("TIROT,-3.0,A")};
  simulator.send({kLoopback, port}, encoder.encode(lines)[0]);
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 2; }));
  EXPECT_EQ(host.fixes()[0].heading_deg, 84.0);
}

TEST_F(NavigationInputTest, GarbageIsCountedAndChangesNothing) {
  start({});
  std::uint64_t state = 7;
  for (int i = 0; i < 100; ++i) {
    std::string noise;
    for (int k = 0; k < 200; ++k) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      noise += static_cast<char>(state >> 56);
    }
    send(noise);
  }
  send("$HEHDT,84.0,T*00\r\n");
  send(std::string("UdPbC\0\\s:XX", 11));
  send("");
  ASSERT_TRUE(wait_until([&] { return errors("nmea input fault") >= 100; }));
  EXPECT_TRUE(host.fixes().empty());
  EXPECT_TRUE(heading_comes(11.0));
  EXPECT_EQ(host.fixes().back().heading_deg, 11.0);
}

TEST_F(NavigationInputTest, AJumpIsCountedAndObeyed) {
  start({});
  send(line_of("GPGLL,6024.000,N,00519.200,E,092204,A"));
  send(line_of("GPGLL,5924.000,N,00519.200,E,092205,A"));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 2; }));
  EXPECT_EQ(host.fixes()[1].position->latitude_deg, 59.4);
  ASSERT_TRUE(wait_until([&] { return errors("nmea input jump") == 1; }));
}

TEST_F(NavigationInputTest, SourcesThatAreNotAmongTheConfiguredAreRefused) {
  start({.sources = {"192.0.2.0/24", "127.0.0.9"}});
  send(line_of("HEHDT,84.0,T"));
  ASSERT_TRUE(wait_until([&] { return errors("nmea input source") == 1; }));
  EXPECT_TRUE(host.fixes().empty());
  DisplaySocket other({}, ipv4(127, 0, 0, 9));
  other.send({kLoopback, port}, line_of("HEHDT,85.0,T"));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 1; }));
  EXPECT_EQ(host.fixes()[0].heading_deg, 85.0);
}

TEST_F(NavigationInputTest, WhatTheHostRefusesIsCounted) {
  start({.radar = 1});
  send(line_of("HEHDT,84.0,T"));
  ASSERT_TRUE(wait_until([&] { return errors("nmea input refused") == 1; }));
  EXPECT_EQ(output_status(*server).commands_refused(), 1u);
}

TEST_F(NavigationInputTest, AFloodIsBoundedAndItsEndIsTheEndOfIt) {
  start({});
  std::string many;
  for (int i = 0; i < 1000; ++i) many += line_of("HEHDT,1.0,T");
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) send(many);
  TestClient(server->tcp_port()).get_status();  // net-0 answers others meanwhile
  ASSERT_TRUE(wait_until([&] { return output_status(*server).commands_dropped() > 1000; }));
  EXPECT_TRUE(heading_comes(99.0));
  const auto windows = (std::chrono::steady_clock::now() - begin) / NavigationInput::kWindow + 2;
  EXPECT_LE(host.fixes().size(), static_cast<std::size_t>(windows) * NavigationInput::kLines);
}

TEST_F(NavigationInputTest, TakesLinesOverTcpHoweverTheyAreCut) {
  start({.transport = NavigationTransport::tcp});
  TestSocket socket(port);
  const std::string lines = line_of("HEHDT,84.0,T") + line_of("TIROT,-3.0,A");
  for (const char c : lines) socket.send(std::string(1, c));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 2; }));
  // A line without an end is left out up to the next.
  socket.send(std::string(100'000, 'x'));
  socket.send("\r\n" + line_of("HEHDT,85.0,T"));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 3; }));
  EXPECT_EQ(host.fixes()[2].heading_deg, 85.0);
  EXPECT_EQ(errors("nmea input fault"), 1u);
}

TEST_F(NavigationInputTest, ListensToAGroup) {
  start({.address = "239.255.74.21"});
  simulator.send({ipv4(239, 255, 74, 21), port}, line_of("HEHDT,84.0,T"));
  ASSERT_TRUE(wait_until([&] { return host.fixes().size() == 1; }));
}

TEST(NavigationInputs, WrongConfigurationsAreNamed) {
  const auto refused = [](const NavigationInputConfig& input) {
    NetConfig config = test_config();
    config.navigation_inputs = {input};
    return refusal(config);
  };
  EXPECT_NE(refused({.radar = 7}).find("no such radar"), std::string::npos);
  EXPECT_NE(refused({.address = "simulator"}).find("literal"), std::string::npos);
  EXPECT_NE(refused({.address = "203.0.113.9"}).find("203.0.113.9"), std::string::npos);
  EXPECT_NE(refused({.sources = {"192.0.2.0/99"}}).find("192.0.2.0/99"), std::string::npos);
  EXPECT_NE(refused({.sources = {"everybody"}}).find("everybody"), std::string::npos);
  EXPECT_NE(refused({.max_connections = 0}).find("1 to 64"), std::string::npos);
}

}  // namespace
}  // namespace skerry::server
