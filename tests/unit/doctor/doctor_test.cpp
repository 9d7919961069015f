// What the doctor makes of made-up hosts: every illness alone, and a host that has none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <ostream>

#include "clients/doctor/examine.hpp"
#include "clients/doctor/firewall.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/model.hpp"

namespace skerry::client::doctor {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kHost = ipv4(192, 0, 2, 7), kDisplay = ipv4(192, 0, 2, 8);

// Everything that an examination looks at.
struct Patient {
  Case of;
  HostFacts host;
  HeardRadars radars;

  Findings examine() const {
    Findings out = examine_server(of, host);
    for (const Findings& more : {examine_outputs(of, host), examine_radars(of, host, radars)}) {
      out.insert(out.end(), more.begin(), more.end());
    }
    return out;
  }
};

// A server with a 4G on the network of 192.0.2.7, which is heard, and asked by a display.
Patient healthy() {
  Patient patient;
  patient.host.addresses = {{"lo", ipv4(127, 0, 0, 1), ipv4(255, 0, 0, 0), true, true, true, false},
                            {"eth0", kHost, ipv4(255, 255, 255, 0)}};
  patient.host.groups_leave_from = kHost;
  patient.host.listeners = {{true, {0, 7410}, "skerryd (9)"}, {true, {0, 7480}, "skerryd (9)"}};
  Case& of = patient.of;
  of.server = "127.0.0.1:7410";
  of.status.emplace();
  of.status->set_server("skerryd 0.1.0");
  of.outputs = {{find_radar_kind("navico_4g"), kHost}};
  wire::OutputStatus& output = *of.status->add_outputs();
  output.set_name("navico_4g");
  output.set_interface_address("192.0.2.7");
  output.set_commands(3);
  output.set_last_display("192.0.2.8:50000");
  of.display = kDisplay;
  patient.radars.heard = {{{kHost, navico::kAddressesA.report}, {kHost, 40000}, 5, "", {}}};
  return patient;
}

std::string all_of(const Findings& findings) {
  std::string text;
  for (const Finding& one : findings) {
    text += std::to_string(static_cast<int>(one.grade)) + " " + one.about + ": " + one.text +
            " -> " + one.advice + "\n";
  }
  return text;
}

TEST(Doctor, FindsNothingWrongWithAHealthyHost) {
  const Findings findings = healthy().examine();
  for (const Finding& one : findings) EXPECT_EQ(one.grade, Grade::good) << all_of({one});
  EXPECT_GE(findings.size(), 5u);
}

struct Illness {
  const char* name;
  std::function<void(Patient&)> fall_ill;
  Grade grade;
  const char* text;
  friend std::ostream& operator<<(std::ostream& out, const Illness& one) { return out << one.name; }
};

void on_loopback(Patient& patient) {
  patient.of.outputs[0].interface_address = ipv4(127, 0, 0, 1);
  patient.of.status->mutable_outputs(0)->set_interface_address("127.0.0.1");
  patient.radars.heard[0].ear.interface_address = ipv4(127, 0, 0, 1);
  patient.radars.heard[0].sender.address = ipv4(127, 0, 0, 1);
}
Heard& another_radar(Patient& patient) {
  patient.radars.heard.push_back(patient.radars.heard[0]);
  patient.radars.heard.back().sender.port = 40001;
  return patient.radars.heard.back();
}
void as_halo(Patient& patient) {
  patient.of.outputs[0].kind = find_radar_kind("navico_halo");
  patient.of.status->mutable_outputs(0)->set_name("navico_halo");
  patient.radars.heard[0].ear.group = navico::kLocatorGroup;
  patient.radars.heard[0].serial = "1403302452";
  patient.radars.heard[0].data = navico::kAddressesA.data;
}
void without_server(Patient& patient) {
  patient.of.status.reset();
  patient.of.problem = "127.0.0.1:7410 refused the connection";
  patient.host.listeners.clear();
}

class DoctorFinds : public testing::TestWithParam<Illness> {};

// It is found, with its grade, and nothing else is a fault.
TEST_P(DoctorFinds, ThatAlone) {
  Patient patient = healthy();
  GetParam().fall_ill(patient);
  const Findings findings = patient.examine();
  bool found = false;
  for (const Finding& one : findings) {
    if (one.text.find(GetParam().text) != std::string::npos) {
      found = true;
      EXPECT_EQ(one.grade, GetParam().grade) << all_of({one});
    } else {
      EXPECT_NE(one.grade, Grade::fault) << all_of({one});
    }
  }
  EXPECT_TRUE(found) << GetParam().text << " is not in:\n" << all_of(findings);
}

using enum Grade;
INSTANTIATE_TEST_SUITE_P(
    EachIllness, DoctorFinds,
    testing::Values(
        Illness{"ServerRefuses", without_server, hint, "refused the connection"},
        Illness{"PortTaken",
                [](Patient& p) {
                  without_server(p);
                  p.host.listeners = {{true, {0, 7480}, "python3 (4711)"}};
                },
                fault, "taken by python3 (4711)"},
        Illness{"PortTakenByAnotherUser",
                [](Patient& p) {
                  without_server(p);
                  p.host.listeners = {{true, {ipv4(127, 0, 0, 1), 7410}, ""}};
                },
                fault, "taken by another user's program"},
        Illness{"HttpOnLoopback",
                [](Patient& p) { p.host.listeners[1].at.address = ipv4(127, 0, 0, 1); }, fault,
                "listens on 127.0.0.1 alone"},
        Illness{"DatagramsToLoopback",
                [](Patient& p) {
                  auto& client = *p.of.status->add_clients();
                  client.set_transport("udp");
                  client.set_peer("127.0.0.1:7411");
                },
                hint, "datagrams go to 127.0.0.1:7411"},
        Illness{"NoSuchAddress",
                [](Patient& p) {
                  p.of.outputs[0].interface_address = ipv4(192, 0, 2, 99);
                  p.radars.heard.clear();
                },
                fault,
                "192.0.2.99 is none of this host's, which are 127.0.0.1 (lo), 192.0.2.7 (eth0)"},
        Illness{"InterfaceDown", [](Patient& p) { p.host.addresses[1].up = false; }, fault,
                "switched off"},
        Illness{"NoLink", [](Patient& p) { p.host.addresses[1].linked = false; }, fault,
                "without a link"},
        Illness{"NoMulticast", [](Patient& p) { p.host.addresses[1].multicast = false; }, fault,
                "carries no multicast"},
        Illness{"NoRouteWithTheDisplayHere",
                [](Patient& p) {
                  p.host.groups_leave_from.reset();
                  p.of.display = kHost;
                },
                fault, "no route for multicast"},
        Illness{"NoRouteWithTheDisplayElsewhere",
                [](Patient& p) { p.host.groups_leave_from.reset(); }, hint,
                "no route for multicast"},
        Illness{"RouteElsewhere",
                [](Patient& p) { p.host.groups_leave_from = ipv4(198, 51, 100, 7); }, hint,
                "use 198.51.100.7 for multicast, not 192.0.2.7"},
        Illness{"OnLoopbackWithTheDisplayElsewhere", on_loopback, fault,
                "which the display at 192.0.2.8 never hears"},
        Illness{"DisplayInAnotherNetwork", [](Patient& p) { p.of.display = ipv4(198, 51, 100, 8); },
                fault, "is not in the network of 192.0.2.7 (mask 255.255.255.0)"},
        Illness{"GarminOutsideItsNetwork",
                [](Patient& p) {
                  p.of.outputs[0].kind = find_radar_kind("garmin_xhd");
                  p.of.status->mutable_outputs(0)->set_name("garmin_xhd");
                  p.radars.heard[0].ear.group = garmin::kReportAddress;
                },
                fault, "192.0.2.7 is not in 172.16.0.0/12"},
        Illness{"TwoOutputsOfFixedAddresses",
                [](Patient& p) {
                  p.of.outputs.push_back({find_radar_kind("navico_3g"), kHost});
                },
                fault, "navico_3g is wanted at 192.0.2.7 as well"},
        Illness{"TwoRadarsOfOneAddress", [](Patient& p) { another_radar(p); }, fault,
                "192.0.2.7:40000 and 192.0.2.7:40001, of one address"},
        Illness{"TwoRadarsOfOneGroup",
                [](Patient& p) { another_radar(p).sender.address = ipv4(192, 0, 2, 50); }, fault,
                "192.0.2.7:40000 and 192.0.2.50:40001; displays take them for one"},
        Illness{"TwoOnLoopback",
                [](Patient& p) {
                  on_loopback(p);
                  p.of.display.reset();
                  another_radar(p).sender.address = ipv4(127, 0, 0, 2);
                },
                hint, "127.0.0.1:40000 and 127.0.0.2:40001; displays take them for one"},
        Illness{"TwoOfOneSerial",
                [](Patient& p) {
                  as_halo(p);
                  another_radar(p).data = navico::kAddressesB.data;
                },
                fault, "two radars have the serial 1403302452"},
        Illness{"TwoPicturesInOneGroup",
                [](Patient& p) {
                  as_halo(p);
                  another_radar(p).serial = "other";
                },
                fault, "two radars send their pictures to 236.6.7.8:6678"},
        Illness{"OwnRadarNotHeard", [](Patient& p) { p.radars.heard.clear(); }, fault,
                "nothing of it is heard at 236.6.7.9:6679"},
        Illness{"PortOfRadarsTaken",
                [](Patient& p) {
                  p.radars.heard.clear();
                  p.radars.deaf = {{{kHost, navico::kAddressesA.report}, EADDRINUSE}};
                  p.host.listeners.push_back({false, {0, 6679}, "opencpn (12)"});
                },
                fault, "opencpn (12) has UDP port 6679 for itself alone"},
        Illness{"NoDisplayAsked",
                [](Patient& p) { p.of.status->mutable_outputs(0)->set_commands(0); }, hint,
                "no display has said anything"},
        Illness{"DatagramsUnsent",
                [](Patient& p) {
                  p.of.status->mutable_outputs(0)->set_datagrams(90);
                  p.of.status->mutable_outputs(0)->set_datagrams_unsent(10);
                },
                hint, "10 of 100 datagrams"},
        Illness{"FirewallDrops", [](Patient& p) { p.host.firewall = Firewall::drops; }, hint,
                "is dropped"},
        Illness{"FirewallUnreadable", [](Patient& p) { p.host.firewall = Firewall::unreadable; },
                hint, "only root may read"},
        Illness{"StrictReversePath",
                [](Patient& p) {
                  p.host.strict_interfaces = {"eth0", "wlan0"};
                },
                hint, "eth0, wlan0 drop"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(Doctor, LooksAtNoInterfaceOfAServerElsewhere) {
  Patient patient = healthy();
  patient.of.on_this_host = false;
  patient.host = {};
  for (const Finding& one : patient.examine()) EXPECT_EQ(one.grade, Grade::good) << all_of({one});
}

TEST(Doctor, MissesTheRadarOfAServerElsewhere) {
  Patient patient = healthy();
  patient.of.on_this_host = false;
  patient.host = {};
  patient.radars.heard[0].ear.interface_address = kDisplay;  // heard at the display's host
  for (const Finding& one : patient.examine()) EXPECT_EQ(one.grade, Grade::good) << all_of({one});
  patient.radars.heard.clear();
  EXPECT_THAT(all_of(patient.examine()), HasSubstr("on any interface of this host"));
}

TEST(Doctor, SaysOneThingOfEachOfManyRadars) {
  Patient patient = healthy();
  for (std::uint16_t i = 1; i < kMostHeard; ++i) another_radar(patient).sender.port = 40000 + i;
  EXPECT_LT(patient.examine().size(), 2 * kMostHeard + 20);
}

TEST(Doctor, PrintsNothingOfTheNetworkAsItCame) {
  Patient patient = healthy();
  as_halo(patient);
  patient.radars.heard[0].serial = "\x1b[2J\n";
  patient.of.status->set_server("\x1b[31m");
  const std::string text = all_of(patient.examine());
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(Firewall, IsReadFromTheRulesOfNft) {
  EXPECT_EQ(firewall_of(""), Firewall::none);
  EXPECT_EQ(firewall_of(" \n"), Firewall::none);
  EXPECT_EQ(firewall_of("table inet filter {\n\tchain input {\n\t\ttype filter hook input priority "
                        "filter; policy accept;\n\t}\n}\n"),
            Firewall::open);
  EXPECT_EQ(firewall_of("table inet filter {\n\tchain input {\n\t\ttype filter hook input priority "
                        "filter; policy drop;\n\t}\n}\n"),
            Firewall::drops);
  EXPECT_EQ(firewall_of("chain forward { type filter hook forward priority 0; policy drop; }"),
            Firewall::open);
}

TEST(Addresses, AreReadAndWritten) {
  EXPECT_EQ(address_of_text("192.0.2.7"), kHost);
  EXPECT_EQ(address_text(kHost), "192.0.2.7");
  for (const char* wrong : {"", "192.0.2", "192.0.2.256", "192.0.2.7:1", "host", "1.2.3.4.5"}) {
    EXPECT_EQ(address_of_text(wrong), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace skerry::client::doctor
