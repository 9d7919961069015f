// Displays that were never told of this server find its emulated radars, see its picture and
// command it, as the protocol pages have them do it: every byte is read and written here anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/system/display_kit.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

// A server with one output, and a console beside it.
struct Served {
  explicit Served(const std::string& output)
      : server({"--scenario", folder.write("small.yaml", small_scenario()), "--output", output}),
        console(subscribed(server, 0)) {}

  wire::Settings settings_when(const std::function<bool(const wire::Settings&)>& condition) {
    return await_status(
               console,
               [&](const wire::Status& status) { return condition(status.radars(0).settings()); })
        .radars(0)
        .settings();
  }
  void expect_likeness(const std::vector<SeenSpoke>& seen) {
    const Likeness likeness = compare(seen, next_scan(console));
    EXPECT_GT(likeness.strong, 2000u) << "an empty picture";
    EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";
  }

  TempFolder folder;
  RunningServer server;
  client::SpokeClient console;
};

// Navico, on whatever groups.
struct NavicoDisplay {
  NavicoDisplay(std::uint32_t address, Ipv4Endpoint data_at, Ipv4Endpoint commands_at,
                Ipv4Endpoint reports_at)
      : at(address), commands(commands_at), reports(reports_at, address), data(data_at, address) {}

  void command(const std::string& bytes) { reports.send(commands, hex(bytes)); }
  Bytes report(
      std::uint8_t number, std::size_t length,
      const std::function<bool(const Bytes&)>& condition = [](const Bytes&) { return true; }) {
    return await_datagram(reports, at, "report " + std::to_string(number), [&](const Bytes& b) {
      return b.size() == length && b[0] == number && b[1] == 0xC4 && condition(b);
    });
  }
  // Whole frames of a turn, at the reach that `reach_of` reads from a spoke's header.
  std::vector<SeenSpoke> turn(const std::function<double(const Bytes&, std::size_t)>& reach_of) {
    std::vector<SeenSpoke> seen;
    while (seen.size() < 2048) {
      const Bytes frame =
          await_datagram(data, at, "a frame", [](const Bytes& b) { return b.size() == 17160; });
      for (std::size_t spoke = 0; spoke < 32; ++spoke) {
        const std::size_t head = 8 + spoke * 536;
        EXPECT_EQ(frame[head], 0x18);
        SeenSpoke one{u16(frame, head + 8) / 4096.0, reach_of(frame, head), {}};
        for (std::size_t i = 0; i < 512; ++i) {
          const std::uint8_t two = frame[head + 24 + i];
          one.cells.push_back(static_cast<std::uint8_t>((two & 15) * 17));
          one.cells.push_back(static_cast<std::uint8_t>((two >> 4) * 17));
        }
        seen.push_back(std::move(one));
      }
    }
    return seen;
  }

  std::uint32_t at;
  Ipv4Endpoint commands;
  DisplaySocket reports, data;
};

double reach_of_br24(const Bytes& frame, std::size_t head) {
  return (u16(frame, head + 12) | std::uint32_t{frame[head + 14]} << 16) * 10.0 / std::sqrt(2.0);
}
double reach_of_4g(const Bytes& frame, std::size_t head) {
  const std::uint32_t large = u16(frame, head + 6), small = u16(frame, head + 12);
  return large == 0x80 ? small / 4.0 : large * 64.0;
}
double reach_of_halo(const Bytes& frame, std::size_t head) {
  const std::uint32_t large = u16(frame, head + 6), small = u16(frame, head + 12);
  return large == 0x80 ? small / 4.0 : double(large) * small / 512.0;
}

// Transmits, sees, sets range and gain, goes to standby.
void use_navico(Served& served, NavicoDisplay& display,
                const std::function<double(const Bytes&, std::size_t)>& reach_of) {
  display.report(1, 18);
  display.command("A0C1");
  display.command("00C101");
  display.command("01C101");
  display.report(1, 18, [](const Bytes& b) { return b[2] == 2; });
  const auto seen = display.turn(reach_of);
  EXPECT_GT(seen.front().reach_m, 6 * 1852.0);
  EXPECT_LE(seen.front().reach_m, 2 * 6 * 1852.0);
  served.expect_likeness(seen);

  display.command("03C1 08D90000");  // 5556.0 m, 3 NM
  display.report(2, 99, [](const Bytes& b) { return u32(b, 2) == 55'560; });
  EXPECT_EQ(
      served.settings_when([](const wire::Settings& s) { return s.range_nm() != 6; }).range_nm(),
      3.0);
  display.command("06C1 00000000 00 000000 B2");
  display.report(2, 99, [](const Bytes& b) { return u32(b, 8) == 0 && b[12] == 0xB2; });
  EXPECT_NEAR(served.settings_when([](const wire::Settings& s) { return s.gain() != 50; }).gain(),
              0xB2 / 2.55, 0.5);
  // Another hand on the same control, and the display is told.
  EXPECT_EQ(served.server.skerry("set", {"--gain", "20"}).code, 0);
  display.report(2, 99, [](const Bytes& b) { return b[12] < 60; });

  display.command("00C101");
  display.command("01C100");
  display.report(1, 18, [](const Bytes& b) { return b[2] == 1; });
  EXPECT_TRUE(served.settings_when([](const wire::Settings& s) { return s.standby(); }).standby());
  const wire::Status status =
      await_status(served.console, [](const wire::Status& s) { return s.outputs_size() == 1; });
  EXPECT_GE(status.outputs(0).datagrams(), 64u);
  EXPECT_GE(status.outputs(0).commands(), 7u);
  EXPECT_EQ(status.outputs(0).commands_dropped(), 0u);
}

TEST(NavicoDisplays, ABr24IsFoundSeenAndCommanded) {
  NavicoDisplay display(ipv4(127, 0, 0, 51), {ipv4(236, 6, 7, 8), 6678},
                        {ipv4(236, 6, 7, 10), 6680}, {ipv4(236, 6, 7, 9), 6679});
  Served served("navico_br24:interface_address=127.0.0.51");
  use_navico(served, display, reach_of_br24);
}

TEST(NavicoDisplays, A4gIsFoundSeenAndCommanded) {
  NavicoDisplay display(ipv4(127, 0, 0, 52), {ipv4(236, 6, 7, 8), 6678},
                        {ipv4(236, 6, 7, 10), 6680}, {ipv4(236, 6, 7, 9), 6679});
  Served served("navico_4g:interface_address=127.0.0.52");
  use_navico(served, display, reach_of_4g);
}

// Range B has a radar of its own on the same ship: it may be longer than A, and A's changes leave
// it alone, as on the real one.
TEST(NavicoDisplays, RangeBOfA4gMayBeLongerThanRangeA) {
  constexpr std::uint32_t kAt = ipv4(127, 0, 0, 59);
  NavicoDisplay a(kAt, {ipv4(236, 6, 7, 8), 6678}, {ipv4(236, 6, 7, 10), 6680},
                  {ipv4(236, 6, 7, 9), 6679});
  NavicoDisplay b(kAt, {ipv4(236, 6, 7, 13), 6657}, {ipv4(236, 6, 7, 14), 6658},
                  {ipv4(236, 6, 7, 15), 6659});
  Served served("navico_4g:interface_address=127.0.0.59,dual_range=true,radar_b=1,view_b=shared");
  const auto range_is = [](std::uint32_t dm) {
    return [dm](const Bytes& report) { return u32(report, 2) == dm; };
  };
  b.command("03C1 20640300");  // 22 224.0 m, 12 NM; A is at 6
  b.report(2, 99, range_is(222'240));
  a.command("03C1 08D90000");  // 5556.0 m, 3 NM
  a.report(2, 99, range_is(55'560));
  const auto of_b = b.turn(reach_of_4g), of_a = a.turn(reach_of_4g);
  EXPECT_GT(of_b.back().reach_m, 12 * 1852.0);
  EXPECT_LE(of_b.back().reach_m, 2 * 12 * 1852.0);
  EXPECT_GT(of_a.back().reach_m, 3 * 1852.0);
  EXPECT_LE(of_a.back().reach_m, 2 * 3 * 1852.0);
  const wire::Status status =
      await_status(served.console, [](const wire::Status& s) { return s.radars_size() == 3; });
  EXPECT_EQ(status.radars(0).settings().range_nm(), 3.0);
  EXPECT_EQ(status.radars(1).settings().range_nm(), 12.0);
}

TEST(NavicoDisplays, AHaloIsFoundByItsLocatorSeenAndCommanded) {
  constexpr std::uint32_t kAt = ipv4(127, 0, 0, 53);
  constexpr Ipv4Endpoint kLocator{ipv4(236, 6, 7, 5), 6878};
  DisplaySocket locator(kLocator, kAt);
  Served served("navico_halo:interface_address=127.0.0.53");
  locator.send(kLocator, hex("01B1"));
  const Bytes answer = await_datagram(locator, kAt, "a locator", [](const Bytes& b) {
    return b.size() >= 150 && b[0] == 0x01 && b[1] == 0xB2;
  });
  const auto endpoint = [&](std::size_t i) {
    return Ipv4Endpoint{ipv4(answer[i], answer[i + 1], answer[i + 2], answer[i + 3]),
                        static_cast<std::uint16_t>(answer[i + 4] << 8 | answer[i + 5])};
  };
  EXPECT_EQ(endpoint(18).address, kAt);
  NavicoDisplay display(kAt, endpoint(88), endpoint(98), endpoint(108));
  use_navico(served, display, reach_of_halo);
}

TEST(GarminDisplays, AnXhdIsFoundSeenAndCommanded) {
  constexpr std::uint32_t kAt = ipv4(127, 0, 0, 54);
  DisplaySocket reports({ipv4(239, 254, 2, 0), 50100}, kAt);
  DisplaySocket data({ipv4(239, 254, 2, 0), 50102}, kAt);
  Served served("garmin_xhd:interface_address=127.0.0.54");
  const auto report = [&](std::uint32_t type, std::uint32_t value, std::size_t octets) {
    await_datagram(reports, kAt, "packet " + std::to_string(type), [&](const Bytes& b) {
      return b.size() == 8 + octets && u32(b, 0) == type &&
             (octets == 1   ? b[8]
              : octets == 2 ? u16(b, 8)
                            : u32(b, 8)) == value;
    });
  };
  report(0x992, 5, 1);
  std::vector<SeenSpoke> seen;
  while (seen.size() < 1440) {
    const Bytes b = await_datagram(data, kAt, "a spoke", [](const Bytes& datagram) {
      return datagram.size() > 36 && u32(datagram, 0) == 0x998;
    });
    ASSERT_EQ(b.size(), 36u + u16(b, 26));
    seen.push_back({u16(b, 12) / 11520.0, double(u32(b, 20)), {b.begin() + 36, b.end()}});
  }
  served.expect_likeness(seen);
  const Ipv4Endpoint radar{kAt, 50101};
  reports.send(radar, hex("1E090000 04000000 B4150000"));  // 5556 m
  report(0x91e, 5556, 4);
  EXPECT_EQ(
      served.settings_when([](const wire::Settings& s) { return s.range_nm() != 6; }).range_nm(),
      3.0);
  reports.send(radar, hex("24090000 01000000 00"));
  reports.send(radar, hex("25090000 02000000 581B"));  // 70.00
  report(0x925, 7000, 2);
  EXPECT_NEAR(served.settings_when([](const wire::Settings& s) { return s.gain() != 50; }).gain(),
              70, 0.5);
  reports.send(radar, hex("19090000 01000000 00"));
  report(0x992, 3, 1);
  EXPECT_TRUE(served.settings_when([](const wire::Settings& s) { return s.standby(); }).standby());
}

TEST(RaymarineDisplays, AQuantumIsFoundByItsLocatorSeenAndCommanded) {
  constexpr std::uint32_t kAt = ipv4(127, 0, 0, 55);
  DisplaySocket locator({ipv4(224, 0, 0, 1), 5800}, kAt);
  Served served("raymarine_quantum:interface_address=127.0.0.55");
  const Bytes where = await_datagram(locator, kAt, "a locator",
                                     [](const Bytes& b) { return b.size() == 36 && b[8] == 0x28; });
  const Ipv4Endpoint radar{u32(where, 28), static_cast<std::uint16_t>(u32(where, 32))};
  EXPECT_EQ(radar.address, kAt);
  DisplaySocket data({u32(where, 20), static_cast<std::uint16_t>(u32(where, 24))}, kAt);
  const auto status = [&](const std::function<bool(const Bytes&)>& condition) {
    return await_datagram(data, kAt, "a status", [&](const Bytes& b) {
      return b.size() == 260 && u32(b, 0) == 0x280002 && condition(b);
    });
  };
  const Bytes first = status([](const Bytes& b) { return b[4] == 1; });
  const double range_m = u32(first, 148 + 4u * first[20]) * 1.852;
  EXPECT_NEAR(range_m, 6 * 1852.0, 1.0);
  std::vector<SeenSpoke> seen;
  while (seen.size() < 250) {
    const Bytes b = await_datagram(data, kAt, "a spoke", [](const Bytes& datagram) {
      return datagram.size() >= 20 && u32(datagram, 0) == 0x280003;
    });
    const std::uint32_t cells = u16(b, 8);
    SeenSpoke spoke{(u16(b, 16) + 125) % 250 / 250.0, range_m * cells / u16(b, 14), {}};
    for (std::size_t i = 20; i < b.size(); ++i) {
      if (b[i] != 0x5C) {
        spoke.cells.push_back(b[i]);
      } else {
        spoke.cells.insert(spoke.cells.end(), b.at(i + 1), b.at(i + 2));
        i += 2;
      }
    }
    ASSERT_LE(spoke.cells.size(), cells);
    spoke.cells.resize(cells);
    seen.push_back(std::move(spoke));
  }
  const Likeness likeness = compare(seen, next_scan(served.console));
  EXPECT_GT(likeness.strong, 500u) << "an empty picture";
  EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";

  data.send(radar, hex("0101 2800 00 0A 0000"));  // index 10: 3 NM
  status([](const Bytes& b) { return b[20] == 10; });
  EXPECT_EQ(
      served.settings_when([](const wire::Settings& s) { return s.range_nm() != 6; }).range_nm(),
      3.0);
  data.send(radar, hex("1000 2800 00 000000"));
  status([](const Bytes& b) { return b[4] == 0; });
  EXPECT_TRUE(served.settings_when([](const wire::Settings& s) { return s.standby(); }).standby());
}

// Ten thousand datagrams to each of three radars in less than a second: cut and lengthened
// commands, noise, and wild values in good ones.  Between bursts of a thousand a sector must come,
// so that a slow machine is flooded for longer and not harder.
TEST(Outputs, AFloodOfBadCommandsDisturbsNeitherConsolesNorTheAntenna) {
  constexpr std::uint32_t kAt = ipv4(127, 0, 0, 59);
  DisplaySocket display({ipv4(236, 6, 7, 9), 6679}, kAt);
  TempFolder folder;
  const RunningServer server({"--scenario", folder.write("small.yaml", small_scenario()),
                              "--output", "navico_4g:interface_address=127.0.0.59", "--output",
                              "garmin_xhd:interface_address=127.0.0.59", "--output",
                              "raymarine_quantum:interface_address=127.0.0.59,"
                              "addresses=239.255.75.59:7159,addresses=0.0.0.0:7160"});
  Witness witness(server, 2);
  const std::vector<std::pair<Ipv4Endpoint, std::vector<Bytes>>> radars = {
      {{ipv4(236, 6, 7, 10), 6680},
       {hex("03C1 FFFFFFFF"), hex("06C1 FF000000 00 000000 FF"), hex("0DC1 FF000000 FF"),
        hex("11C1 FFFFFFFF")}},
      {{kAt, 50101},
       {hex("1E090000 04000000 FFFFFFFF"), hex("25090000 02000000 FFFF"),
        hex("25090000 FFFFFFFF 5819"), hex("30090000 04000000 00000080")}},
      {{kAt, 7160},
       {hex("0101 2800 00 FF 0000"), hex("0203 2800 00 FF 0000"), hex("0701 2800 00 FF 0000"),
        hex("0401 2800 FFFFFF7F")}}};
  std::uint64_t state = 1;
  const auto random = [&](std::uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % below;
  };
  for (int i = 0; i < 10'000; ++i) {
    if (i % 1000 == 0) witness.await_more(16);
    for (const auto& [to, commands] : radars) {
      Bytes bytes = commands[random(commands.size())];
      if (random(2) == 0) bytes.resize(random(40));
      if (random(2) == 0 && !bytes.empty()) {
        bytes[random(bytes.size())] = static_cast<std::uint8_t>(random(256));
      }
      display.send(to, bytes);
    }
  }
  const Witness::Seen seen = witness.finish(kSmallSpokes);
  EXPECT_EQ(seen.error, "");
  EXPECT_EQ(seen.lost, 0u);
  client::SpokeClient console = connected(server);
  const wire::Status status = await_status(console, [](const wire::Status& s) {
    bool all = s.outputs_size() == 3;
    for (const auto& output : s.outputs()) all = all && output.commands() > 0;
    return all;
  });
  for (const auto& output : status.outputs()) {
    EXPECT_GT(output.commands_dropped() + output.commands_refused(), 0u) << output.name();
  }
  // Once the gate is open again, what is right is obeyed.
  await_status(console, [&](const wire::Status& s) {
    display.send({ipv4(236, 6, 7, 10), 6680}, hex("03C1 08D90000"));
    return s.radars(0).settings().range_nm() == 3.0;
  });
}

TEST(Outputs, TwoRadarsOfOneFixedFamilyOnOneAddressAreRefusedWithTheReason) {
  TempFolder folder;
  const Ending ending = run({skerryd_program(), "--tcp-port", "0", "--http-port", "0", "--scenario",
                             folder.write("small.yaml", small_scenario()), "--output",
                             "navico_br24:interface_address=127.0.0.56", "--output",
                             "navico_3g:radar=1,interface_address=127.0.0.56"});
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.err, HasSubstr("on 127.0.0.56, which displays take for one radar"));
}

TEST(Outputs, AreReadFromAConfigurationFileAndToldByTheStatus) {
  TempFolder folder;
  const std::string config = folder.write("server.yaml", R"(
outputs:
  - {kind: navico_3g, interface_address: 127.0.0.57}
  - {kind: navico_4g, interface_address: 127.0.0.58, radar: 1, dual_range: true}
  - {kind: raymarine_quantum, interface_address: 127.0.0.58, radar: 2, view: own}
  - {kind: cat240, port: 18657, spokes: 360, cells: 256, bits: 4, records: 8}
)");
  const RunningServer server(
      {"--config", config, "--scenario", folder.write("small.yaml", small_scenario())});
  client::SpokeClient console = connected(server);
  const wire::Status status = await_status(console, [](const wire::Status& s) {
    bool all = s.outputs_size() == 3;
    for (const auto& output : s.outputs()) all = all && output.datagrams() > 0;
    return all;
  });
  EXPECT_EQ(status.outputs(0).name(), "navico_3g");
  EXPECT_EQ(status.outputs(1).interface_address(), "127.0.0.58");
  EXPECT_EQ(status.outputs(1).radar(), 1u);
  EXPECT_GT(status.outputs(2).view(), 0u);
  EXPECT_EQ(status.clients(0).transport(), "cat240");
  const Ending shown = server.skerry("status");
  EXPECT_THAT(shown.out, HasSubstr("navico_3g"));
  EXPECT_THAT(shown.out, HasSubstr("127.0.0.58"));
}

TEST(Outputs, WhatIsMistypedIsNamedWithWhatThereIs) {
  const auto refusal = [](const std::string& output) {
    const Ending ending = run({skerryd_program(), "--check", "--output", output});
    EXPECT_EQ(ending.code, 2) << output;
    return ending.err;
  };
  EXPECT_THAT(refusal("navico_5g"), HasSubstr("navico_4g"));
  EXPECT_THAT(refusal("cat240:cels=512"), HasSubstr("did you mean \"cells\"?"));
  EXPECT_THAT(refusal("cat240:bits=3"), HasSubstr("1, 2, 4, 8, 16, 32"));
  EXPECT_THAT(refusal("garmin_xhd:cells=512"), HasSubstr("'cells' is not a key of this kind"));
  EXPECT_THAT(refusal("garmin_xhd:dual_range=true"),
              HasSubstr("is a key of navico_4g, navico_halo"));
  EXPECT_THAT(refusal("cat240:bits"), HasSubstr("'bits' is not key=value"));
  EXPECT_THAT(refusal("nmea0183:sentences=rmq=1"), HasSubstr("there is no such sentence"));
}

}  // namespace
}  // namespace skerry::system_test
