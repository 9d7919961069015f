// The emulated radars, a row each, as far as their displays' networks go.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry::client::doctor {

enum class Maker : std::uint8_t { navico, garmin, raymarine };

struct RadarKind {
  std::string_view name;  // of an output, as skerryd has it
  Maker maker = Maker::navico;
  // Where a radar of it says something without being asked, about once a second.
  Ipv4Endpoint report;
  // Its report goes to a group that displays know beforehand: a second radar there is taken for it.
  bool fixed_addresses = false;
  // What the server binds for displays' commands; port 0: any.  Address 0: the interface's.
  Ipv4Endpoint commands;
  // The only network in which its displays look; mask 0: any.
  std::uint32_t network = 0, mask = 0;
};

std::span<const RadarKind> radar_kinds();
const RadarKind* find_radar_kind(std::string_view name);  // nullptr: there is none

}  // namespace skerry::client::doctor
