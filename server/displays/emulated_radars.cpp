#include "server/displays/emulated_radars.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "server/displays/garmin/garmin_xhd.hpp"
#include "server/displays/navico/navico_radar.hpp"
#include "server/displays/raymarine/quantum.hpp"

namespace skerry::server {
namespace {

constexpr std::string_view kSerial = "serial", kAddresses = "addresses",
                           kStandbyAfter = "standby_after_s";

std::optional<std::string> fault_of_serial(const EmulationSpec& spec, std::size_t longest) {
  if (spec.serial.size() <= longest) return std::nullopt;
  return fmt::format("serial '{}' has more than {} characters", spec.serial, longest);
}

// Displays know a family by how its serial numbers begin (protocol/navico/README.md).
std::string navico_serial(navico::Model model, const EmulationSpec& spec) {
  if (!spec.serial.empty() || spec.number == 0) return spec.serial;
  const char* beginning = model == navico::Model::g4 ? "1403302" : "1902501";
  return fmt::format("{}{:03}", beginning, spec.number % 1000);
}

NavicoOptions navico_options(navico::Model model, const EmulationSpec& spec) {
  NavicoOptions options;
  options.model = model;
  options.second_range = spec.dual_range;
  options.serial = navico_serial(model, spec);
  options.standby_when_alone = spec.standby_after.value_or(Duration{});
  if (!navico::is_halo(model)) return options;
  if (!spec.addresses.empty()) {
    options.a = {spec.addresses[0], spec.addresses[1], spec.addresses[2]};
    if (spec.addresses.size() == 6) {
      options.b = {spec.addresses[3], spec.addresses[4], spec.addresses[5]};
    }
  } else if (spec.number != 0) {
    // Groups of the same numbers in a network of their own: 236.6.8.x, 236.6.9.x, ...
    const std::uint32_t shift = (spec.number % 240) << 8;
    for (navico::Addresses* addresses : {&options.a, &options.b}) {
      for (Ipv4Endpoint* one : {&addresses->data, &addresses->send, &addresses->report}) {
        one->address += shift;
      }
    }
  }
  return options;
}

std::optional<std::string> navico_fault(const EmulationSpec& spec) {
  if (const auto fault = fault_of_serial(spec, 16)) return fault;
  const std::size_t wanted = spec.dual_range ? 6 : 3;
  const bool groups =
      std::all_of(spec.addresses.begin(), spec.addresses.end(),
                  [](const Ipv4Endpoint& one) { return one.is_multicast() && one.port != 0; });
  if (spec.addresses.empty() || (spec.addresses.size() == wanted && groups)) return std::nullopt;
  return fmt::format("addresses are {} groups: data, commands and reports{}", wanted,
                     spec.dual_range ? " of range A, then of B" : "");
}

EmulatedRadar navico_row(std::string_view name, navico::Model model) {
  EmulatedRadar row{
      .name = name,
      .maker = "navico",
      .keys = {kSerial, kStandbyAfter},
      .fixed_addresses = !navico::is_halo(model),
      .fault = navico_fault,
      .make = [model](const auto& spec) { return make_navico_radar(navico_options(model, spec)); },
      .identity = [model](const auto& s) { return navico_identity(navico_options(model, s)); }};
  if (navico::has_two_ranges(model)) {
    row.keys.insert(row.keys.end(), {"dual_range", "radar_b", "view_b"});
  }
  if (navico::is_halo(model)) row.keys.push_back(kAddresses);
  return row;
}

QuantumOptions quantum_options(const EmulationSpec& spec) {
  QuantumOptions options;
  options.link_id += spec.number;
  options.serial_number = spec.serial.empty() ? fmt::format("{:07}", 1 + spec.number) : spec.serial;
  if (spec.addresses.empty()) {
    options.data.address += spec.number % 250;
    options.command_port = static_cast<std::uint16_t>(options.command_port + spec.number % 250);
  } else {
    options.data = spec.addresses[0];
    options.command_port = spec.addresses[1].port;
  }
  return options;
}

std::optional<std::string> quantum_fault(const EmulationSpec& spec) {
  const std::vector<Ipv4Endpoint>& at = spec.addresses;
  if (!at.empty() && (at.size() != 2 || !at[0].is_multicast() || at[0].port == 0)) {
    return "addresses are two: the group of its data, and that of its commands, of which only the "
           "port counts; for example 232.1.215.7:2574 and 0.0.0.0:2581";
  }
  return fault_of_serial(spec, 7);
}

}  // namespace

std::span<const EmulatedRadar> emulated_radars() {
  static const std::vector<EmulatedRadar> rows = {
      navico_row("navico_br24", navico::Model::br24),
      navico_row("navico_3g", navico::Model::g3),
      navico_row("navico_4g", navico::Model::g4),
      navico_row("navico_halo20", navico::Model::halo20),
      navico_row("navico_halo", navico::Model::halo),
      {.name = "garmin_xhd",
       .maker = "garmin",
       .keys = {},  // it tells displays no serial
       .fixed_addresses = true,
       .burst = std::chrono::milliseconds(10),  // protocol/garmin/README.md
       .fault = [](const EmulationSpec&) { return std::nullopt; },
       .make = [](const EmulationSpec&) { return make_garmin_xhd(GarminOptions{}); },
       .identity = [](const EmulationSpec&) { return identity_of(GarminOptions{}); }},
      {.name = "raymarine_quantum",
       .maker = "raymarine",
       .keys = {kSerial, kAddresses},
       .fault = quantum_fault,
       .make = [](const EmulationSpec& spec) { return make_quantum(quantum_options(spec)); },
       .identity = [](const EmulationSpec& spec) { return identity_of(quantum_options(spec)); }},
  };
  return rows;
}

const EmulatedRadar* find_emulated_radar(std::string_view name) {
  const auto rows = emulated_radars();
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const EmulatedRadar& one) { return one.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace skerry::server
