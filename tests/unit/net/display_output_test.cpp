// An emulated radar on this host's network, and displays that find, see and command it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "server/net/outputs/command_gate.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/test_client.hpp"
#include "tests/unit/net/test_emulation.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint32_t kHere = ipv4(127, 0, 0, 41), kThere = ipv4(127, 0, 0, 42);

std::string address_text(std::uint32_t address) {
  const std::string text = text_of({address, 0});
  return text.substr(0, text.find(':'));
}

DisplayOutputConfig radar_at(std::uint32_t address, std::uint32_t radar = 0,
                             const TestRadarOptions& options = {}) {
  DisplayOutputConfig config;
  config.name = "test_radar";
  config.make = [options] { return std::make_unique<TestRadar>(options); };
  config.identity = {"Test", {options.commands, options.reports, options.data}};
  config.interface_address = address_text(address);
  config.sources = {{radar, false}};
  return config;
}

// The state that a display keeps of one radar.
struct Display {
  explicit Display(std::uint32_t address, const TestRadarOptions& options = {})
      : at(address),
        commands(options.commands),
        reports(options.reports, address),
        data(options.data, address) {}

  // The next report that begins so; the text behind the beginning.
  std::string report(const std::string& beginning) {
    for (;;) {
      const auto received = reports.receive(at);
      if (!received) throw std::runtime_error("no report '" + beginning + "' came");
      const std::string text(received->payload.begin(), received->payload.end());
      if (text.starts_with(beginning)) return text.substr(beginning.size());
    }
  }
  void command(const std::string& text) { reports.send(commands, text); }

  std::uint32_t at;
  Ipv4Endpoint commands;
  DisplaySocket reports, data;
};

struct DisplayServer {
  DisplayServer(FakeHost& host, std::vector<DisplayOutputConfig> displays)
      : net(host, with(std::move(displays)), {}) {
    net.start();
  }
  static NetConfig with(std::vector<DisplayOutputConfig> displays) {
    NetConfig config = test_config();
    config.displays = std::move(displays);
    return config;
  }
  wire::OutputStatus output(int index = 0) const { return net.status().outputs(index); }

  NetServer net;
};

std::string refusal(std::vector<DisplayOutputConfig> displays) {
  FakeHost host(2);
  try {
    const DisplayServer server(host, std::move(displays));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DisplayOutput, ADisplayFindsItSeesThePictureAndCommandsIt) {
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  EXPECT_THAT(display.report("here "), HasSubstr("127.0.0.41:"));
  display.report("tick");

  host.publish();
  std::uint64_t sequence = 0;
  for (std::uint32_t datagram = 0; datagram < FakeHost::kSectorSpokes / 4; ++datagram) {
    const auto received = display.data.receive(kHere);
    ASSERT_TRUE(received);
    ASSERT_EQ(received->payload.size(), 4u);
    for (const std::uint8_t byte : received->payload) {
      EXPECT_EQ(byte, host.spoke(0, sequence++).cells.front());
    }
  }

  display.command("gain 40");
  EXPECT_EQ(display.report("a gain "), "40");
  EXPECT_EQ(host.settings(0, 0).gain(), 40.0) << "the view that all consoles share";
  EXPECT_THAT(host.origins(), ElementsAre(HasSubstr("Test display 127.0.0.41:")));
  display.command("gain 400");
  EXPECT_THAT(display.report("a refused "), HasSubstr("0 to 100"));

  display.report("tick");  // What went before it is counted.
  const wire::OutputStatus status = server.output();
  EXPECT_EQ(status.name(), "test_radar");
  EXPECT_EQ(status.address(), "239.255.74.42:31942");
  EXPECT_EQ(status.interface_address(), "127.0.0.41");
  EXPECT_EQ(status.datagrams(), 4u);
  EXPECT_GE(status.reports(), 4u);
  EXPECT_GE(status.bytes(), 16u);
  EXPECT_EQ(status.commands(), 2u);
  EXPECT_EQ(status.spokes_lost() + status.datagrams_unsent(), 0u);
  EXPECT_THAT(status.last_display(), HasSubstr("127.0.0.41:"));
}

TEST(DisplayOutput, ItsUnicastEarHearsDisplaysAnywhereOnThisHost) {
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  const std::string where = display.report("here ");
  DisplaySocket other({0, 0}, kThere);
  other.send({kHere, static_cast<std::uint16_t>(std::stoi(where.substr(where.find(':') + 1)))},
             "gain 33");
  EXPECT_EQ(display.report("a gain "), "33");
}

TEST(DisplayOutput, WhatAConsoleChangesReachesDisplaysAndTheViewsInstrumentedRange) {
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  display.report("here ");
  EXPECT_EQ(host.settings(0, 1).instrumented_range_m(), 12 * 1852.0 * 1.5) << "its hidden view";
  wire::Set set;
  set.set_gain(71);
  set.set_range_nm(6);
  host.apply(set, "console");
  EXPECT_EQ(display.report("a gain "), "71");
  display.report(
      "tick");  // the view is fitted after the emulation has reported, and before its next tick
  EXPECT_EQ(host.settings(0, 1).instrumented_range_m(), 6 * 1852.0 * 1.5);
}

TEST(DisplayOutput, RowsThatAreASpokeLongStayAsTheyAre) {
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  display.report("here ");
  wire::Set set;
  set.set_instrumented_range_m(12 * 1852.0 * 0.752);  // half of what is wanted, but for a rounding
  host.apply(set, "playback");
  display.report("a gain ");
  display.report("tick");
  EXPECT_EQ(host.settings(0, 1).instrumented_range_m(), 12 * 1852.0 * 0.752);
  set.set_instrumented_range_m(12 * 1852.0 * 0.9);
  host.apply(set, "playback");
  display.report("a gain ");
  display.report("tick");
  EXPECT_EQ(host.settings(0, 1).instrumented_range_m(), 12 * 1852.0 * 1.5);
}

TEST(DisplayOutput, TwoRadarsOfOneFamilyOnTwoAddressesDoNotHearEachOthersDisplays) {
  FakeHost host(2);
  Display here(kHere), there(kThere);
  const DisplayServer server(host, {radar_at(kHere, 0), radar_at(kThere, 1)});
  here.report("here ");
  there.report("here ");
  there.command("gain 22");
  here.command("gain 11");
  EXPECT_EQ(here.report("a gain "), "11");
  EXPECT_EQ(there.report("a gain "), "22");
  EXPECT_EQ(host.settings(0, 0).gain(), 11.0);
  EXPECT_EQ(host.settings(1, 0).gain(), 22.0);
  EXPECT_EQ(server.output(0).commands(), 1u);
  EXPECT_EQ(server.output(1).commands(), 1u);
  host.publish(1);
  const auto of_there = there.data.receive(kThere);
  ASSERT_TRUE(of_there);
  EXPECT_EQ(of_there->payload.front(), host.spoke(1, 0).cells.front());
}

TEST(DisplayOutput, ASecondRangeHasAViewOfItsOwn) {
  FakeHost host;
  const TestRadarOptions dual{.dual_range = true};
  DisplayOutputConfig config = radar_at(kHere, 0, dual);
  config.sources = {{0, false}, {0, true}};
  Display display(kHere);
  DisplaySocket second({dual.data.address + 1, dual.data.port}, kHere);
  const DisplayServer server(host, {config});
  display.report("here ");
  EXPECT_EQ(host.view_count(0), 3u);
  display.command("b gain 66");
  display.report("b gain ");
  EXPECT_EQ(host.last_set().view(), 2u);
  host.publish();
  EXPECT_TRUE(display.data.receive(kHere));
  EXPECT_TRUE(second.receive(kHere));
}

TEST(DisplayOutput, OneThatDoesNotObeyRefuses) {
  FakeHost host;
  DisplayOutputConfig config = radar_at(kHere);
  config.obeys = false;
  Display display(kHere);
  const DisplayServer server(host, {config});
  display.report("here ");
  display.command("gain 40");
  EXPECT_THAT(display.report("a refused "), HasSubstr("configured not to obey"));
  EXPECT_EQ(host.settings(0, 0).gain(), 50.0);
}

TEST(DisplayOutput, GarbageIsCountedAndTheNextCommandObeyed) {
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  display.report("here ");
  display.command("");
  display.command(std::string(9000, 'x'));
  display.command("gone 40");
  display.command("gain 40");
  EXPECT_EQ(display.report("a gain "), "40");
  EXPECT_EQ(server.output().commands(), 4u);
  EXPECT_EQ(server.output().commands_refused(), 3u);
  EXPECT_EQ(server.net.status().errors().at("test command malformed"), 2u);
  EXPECT_EQ(server.net.status().errors().at("display command too long"), 1u);
}

// Four times as many as the gate can ever let pass in the while, from two senders.
TEST(DisplayOutput, AFloodOfCommandsIsDroppedAndCountedWhileThePictureGoesOn) {
  constexpr int kCommands = 10'000, kSectors = 100;
  FakeHost host;
  Display display(kHere);
  const DisplayServer server(host, {radar_at(kHere)});
  display.report("here ");
  std::jthread flood([&] {
    DisplaySocket other({0, 0}, kHere);
    for (int i = 0; i < kCommands / 2; ++i) {
      other.send(display.commands, "gain " + std::to_string(i % 100));
      other.send(display.commands, "nonsense");
    }
  });
  for (int i = 0; i < kSectors; ++i) {
    host.publish();
    for (std::uint32_t datagram = 0; datagram < FakeHost::kSectorSpokes / 4; ++datagram) {
      ASSERT_TRUE(display.data.receive(kHere)) << "sector " << i;
    }
  }
  flood.join();
  EXPECT_EQ(TestClient(server.net.tcp_port()).get_status().server(), "fake") << "consoles go on";
  const auto all_looked_at = [&] {
    const wire::OutputStatus status = server.output();
    const auto errors = server.net.status().errors();
    const auto dropped = errors.find("commands dropped");
    return dropped != errors.end() && dropped->second == status.commands_dropped() &&
           status.commands() ==
               status.commands_dropped() + status.commands_refused() + host.origins().size();
  };
  EXPECT_TRUE(wait_until(all_looked_at)) << server.output().DebugString();
  EXPECT_LT(host.origins().size(), std::size_t{kCommands} / 4);
  EXPECT_EQ(server.output().datagrams_unsent(), 0u);
  // The gate opens again.
  EXPECT_TRUE(wait_until([&] {
    display.command("gain 100");
    return host.settings(0, 0).gain() == 100.0;
  }));
}

TEST(DisplayOutput, WhatCannotBeIsRefusedByNameAndReason) {
  EXPECT_THAT(refusal({radar_at(kHere, 2)}),
              HasSubstr("output 1 (test_radar): there is no radar 2; there are 2"));
  DisplayOutputConfig config = radar_at(kHere);
  config.interface_address = "eth0";
  EXPECT_THAT(refusal({config}), HasSubstr("interface address 'eth0'"));
  config.interface_address = "203.0.113.1";
  EXPECT_THAT(refusal({config}),
              HasSubstr("cannot send from 203.0.113.1, which must be an address of this host"));
  config = radar_at(kHere);
  config.ttl = 256;
  EXPECT_THAT(refusal({config}), HasSubstr("TTL 256 is not 0 to 255"));
  config = radar_at(kHere);
  config.make = []() -> std::unique_ptr<RadarEmulation> {
    throw std::invalid_argument("this radar is broken");
  };
  EXPECT_THAT(refusal({config}), HasSubstr("output 1 (test_radar): this radar is broken"));
  EXPECT_THAT(refusal({radar_at(kHere), radar_at(kHere, 1)}),
              HasSubstr("output 1 (test_radar) and output 2 (test_radar) would both be a Test at "
                        "239.255.74.40:31940 on 127.0.0.41"));
}

TEST(DisplayOutput, MoreOutputsThanARadarHasViewsAreRefused) {
  std::vector<DisplayOutputConfig> displays;
  for (std::uint32_t i = 0; i < FakeHost::kMaxViews; ++i) displays.push_back(radar_at(kHere + i));
  EXPECT_THAT(refusal(displays), HasSubstr("radar 0 has as many views as it may"));
}

}  // namespace
}  // namespace skerry::server
