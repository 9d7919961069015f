// What the doctor makes of what was seen: pure, so that every illness can be made up in a test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/doctor/finding.hpp"
#include "clients/doctor/host_facts.hpp"
#include "clients/doctor/radars_heard.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::client::doctor {

// An output that somebody wants, or that a server has.
struct WantedOutput {
  const RadarKind* kind = nullptr;  // never nullptr
  std::uint32_t interface_address = ipv4(127, 0, 0, 1);
};

// What was asked, and what the server said.
struct Case {
  std::string server;  // "127.0.0.1:7410"
  std::uint16_t tcp_port = 7410, http_port = 7480;
  bool on_this_host = true;            // the server, or where it would be
  std::optional<wire::Status> status;  // nothing: it did not answer
  std::string problem;                 // why
  bool is_refused = false;             // it answered that it does not tell this client
  std::vector<WantedOutput> outputs;
  std::optional<std::uint32_t> display;  // where the display is
};

constexpr bool is_loopback(std::uint32_t address) { return address >> 24 == 127; }
// "192.0.2.7".
std::string address_text(std::uint32_t address);
// The IPv4 address that a text is; nothing if it is none.
std::optional<std::uint32_t> address_of_text(std::string_view text);

// The server, its ports and who can reach it.
Findings examine_server(const Case& of, const HostFacts& host);
// Each output's interface, route, network and displays, and the firewall.
Findings examine_outputs(const Case& of, const HostFacts& host);
// Radars on the network, and what stands in each other's way.
Findings examine_radars(const Case& of, const HostFacts& host, const HeardRadars& radars);

}  // namespace skerry::client::doctor
