// The radars of other makers that can be emulated: a row for each.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

// The options of one emulated radar.  A member whose key is not in the row keeps its default.
struct EmulationSpec {
  // The serial that displays show; empty: the model's own, told apart by `number`.
  std::string serial = {};
  // Sets radars of one model on one host apart; 0 has the usual addresses and serial.
  std::uint32_t number = 0;
  bool dual_range = false;                     // ranges A and B
  std::optional<Duration> standby_after = {};  // no display has said anything; nothing: never
  // In place of the model's own; empty: those, told apart by `number`.
  std::vector<Ipv4Endpoint> addresses = {};
};

// One row.  Everything that reads configuration, checks, documents or makes emulated radars reads
// it: a new radar is a row here, a line in Output.Kind (server/app/config.proto) and its own
// folder.
struct EmulatedRadar {
  std::string_view name;   // `kind` of an output, and the output's name in status and log
  std::string_view maker;  // radars of one maker may know each other's addresses
  // Keys of an output that it takes besides those that all emulated radars take.
  std::vector<std::string_view> keys;
  // Displays know its addresses beforehand.  Otherwise it announces them and can move.
  bool fixed_addresses = false;
  // Its spokes leave together in bursts so long apart; 0: each when it is complete.
  Duration burst{};

  // The fault of a spec and what was expected; nothing if it is sound.
  std::function<std::optional<std::string>(const EmulationSpec&)> fault;
  // Require a spec without fault.
  std::function<std::unique_ptr<RadarEmulation>(const EmulationSpec&)> make;
  std::function<EmulationIdentity(const EmulationSpec&)> identity;
};

std::span<const EmulatedRadar> emulated_radars();
const EmulatedRadar* find_emulated_radar(std::string_view name);  // nullptr: there is none

}  // namespace skerry::server
