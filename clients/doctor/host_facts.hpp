// HostFacts: what this host's network is like, as far as anybody may read it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry::client::doctor {

// An IPv4 address of this host.
struct InterfaceAddress {
  std::string interface;
  std::uint32_t address = 0, mask = 0;
  bool up = true;      // switched on
  bool linked = true;  // and something is at the other end
  bool loopback = false;
  bool multicast = true;  // meaningless on loopback, which carries groups without saying so

  bool reaches(std::uint32_t other) const { return (other & mask) == (address & mask); }
};

// A TCP port on which somebody waits for connections, or a UDP port that somebody has.
struct Listener {
  bool tcp = true;
  Ipv4Endpoint at;      // address 0: all of them
  std::string program;  // "python3 (4711)"; empty: another user's
};

// What keeps packets from coming in.
enum class Firewall : std::uint8_t {
  none,        // no rules seen
  open,        // rules, and what they do not name comes in
  drops,       // what they do not name is dropped
  unreadable,  // there are rules, which only root may read
};

struct HostFacts {
  std::vector<InterfaceAddress> addresses;
  std::vector<Listener> listeners;
  // Whose address a program gets that sends to groups and chooses no interface; nothing: no route.
  std::optional<std::uint32_t> groups_leave_from;
  // Interfaces that drop what comes from a network to which another one leads.
  std::vector<std::string> strict_interfaces;
  Firewall firewall = Firewall::none;
};

// Reads them anew.  What cannot be read is left out.
HostFacts read_host_facts();

}  // namespace skerry::client::doctor
