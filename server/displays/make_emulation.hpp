// Which radars of other makers can be emulated, and how one is made.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

enum class EmulationKind : std::uint8_t {
  navico_br24,
  navico_3g,
  navico_4g,
  navico_halo20,
  navico_halo,
  garmin_xhd,
  raymarine_quantum,
};

struct EmulationSpec {
  EmulationKind kind = EmulationKind::navico_br24;
  // As displays show it; empty: the kind's own, told apart by `number`.
  std::string serial = {};
  // What sets radars of one kind on one host apart; 0 has the addresses that are usual.
  std::uint32_t number = 0;
  bool dual_range = false;                     // ranges A and B; navico_4g and navico_halo alone
  std::optional<Duration> standby_after = {};  // no display has said anything; nothing: never
  // In place of the kind's own, for kinds that announce theirs: navico_halo and navico_halo20 data,
  // commands and reports of A, then of B; raymarine_quantum data, and commands (of which only the
  // port counts).  Empty: the kind's own, told apart by `number`.
  std::vector<Ipv4Endpoint> addresses = {};
};

// What is wrong with it, and what was expected; nothing where all is well.
std::optional<std::string> fault_of(const EmulationSpec& spec);

// Require a spec without fault.
std::unique_ptr<RadarEmulation> make_emulation(const EmulationSpec& spec);
EmulationIdentity identity_of(const EmulationSpec& spec);

// Whether displays of the kind know its addresses beforehand.
bool has_fixed_addresses(EmulationKind kind);
// Its spokes leave together in bursts so long apart (protocol/navico/README.md,
// protocol/garmin/README.md); 0: each on its own.
Duration burst_of(EmulationKind kind);

}  // namespace skerry::server
