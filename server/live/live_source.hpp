// LiveSource: which radar on the network an input takes its picture from.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/captures/captured_spoke.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry::server {

// A row for each kind of input that is a radar; its name is the `kind` of an input and, where we
// emulate the make, of the output that is taken for it.
struct LiveKind {
  std::string_view name;
  captures::Family family;
  navico::Model model = navico::Model::g4;  // of a Navico
  bool has_second_range = false;
  bool has_commands = false;  // its controls can be set from here
  bool has_address = false;   // where its picture goes must be told: CAT240
};
std::span<const LiveKind> live_kinds();
const LiveKind* find_live_kind(std::string_view name);  // nullptr: there is none

struct LiveSource {
  const LiveKind* kind = nullptr;
  std::uint32_t radar = 0;            // its number in the server
  bool second_range = false;          // range B of a radar with two
  bool commands = false;              // it is told what consoles set, and kept on the air
  bool simulated = false;             // the simulated radar of that number is laid over it
  std::optional<std::uint32_t> from;  // the radar's IPv4 address; nothing: the first heard
  std::optional<Ipv4Endpoint> at;     // a group or a port of this host; kinds with an address
  std::string interface_address = "127.0.0.1";
};

}  // namespace skerry::server
