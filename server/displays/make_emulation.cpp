#include "server/displays/make_emulation.hpp"

#include <fmt/format.h>

#include <utility>

#include "server/displays/garmin/garmin_xhd.hpp"
#include "server/displays/navico/navico_radar.hpp"
#include "server/displays/raymarine/quantum.hpp"

namespace skerry::server {
namespace {

navico::Model model_of(EmulationKind kind) {
  switch (kind) {
    case EmulationKind::navico_3g:
      return navico::Model::g3;
    case EmulationKind::navico_4g:
      return navico::Model::g4;
    case EmulationKind::navico_halo20:
      return navico::Model::halo20;
    case EmulationKind::navico_halo:
      return navico::Model::halo;
    default:
      return navico::Model::br24;
  }
}

bool is_navico(EmulationKind kind) { return kind <= EmulationKind::navico_halo; }

// A family is known by how its serial numbers begin (navico/README.md).
std::string navico_serial(const EmulationSpec& spec) {
  if (!spec.serial.empty() || spec.number == 0) return spec.serial;
  const char* beginning = spec.kind == EmulationKind::navico_4g ? "1403302" : "1902501";
  return fmt::format("{}{:03}", beginning, spec.number % 1000);
}

NavicoOptions navico_options(const EmulationSpec& spec) {
  NavicoOptions options;
  options.model = model_of(spec.kind);
  options.second_range = spec.dual_range;
  options.serial = navico_serial(spec);
  options.standby_when_alone = spec.standby_after.value_or(Duration{});
  if (!navico::is_halo(options.model)) return options;
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

std::optional<std::string> fault_of_addresses(const EmulationSpec& spec) {
  const std::size_t count = spec.addresses.size();
  if (count == 0) return std::nullopt;
  if (has_fixed_addresses(spec.kind)) {
    return "its displays know its addresses beforehand; take `addresses` out, and give radars of "
           "one kind different interface addresses";
  }
  if (spec.kind == EmulationKind::raymarine_quantum) {
    if (count != 2 || !spec.addresses[0].is_multicast() || spec.addresses[0].port == 0) {
      return "addresses are two: the group of its data, and that of its commands, of which only "
             "the port counts; for example 232.1.215.7:2574 and 0.0.0.0:2581";
    }
    return std::nullopt;
  }
  const std::size_t wanted = spec.dual_range ? 6 : 3;
  bool groups = true;
  for (const Ipv4Endpoint& one : spec.addresses) {
    groups = groups && one.is_multicast() && one.port != 0;
  }
  if (count == wanted && groups) return std::nullopt;
  return fmt::format("addresses are {} groups: data, commands and reports{}", wanted,
                     spec.dual_range ? " of range A, then of B" : "");
}

}  // namespace

bool has_fixed_addresses(EmulationKind kind) {
  return kind <= EmulationKind::navico_4g || kind == EmulationKind::garmin_xhd;
}

Duration burst_of(EmulationKind kind) {
  return kind == EmulationKind::garmin_xhd ? std::chrono::milliseconds(10) : Duration{};
}

std::optional<std::string> fault_of(const EmulationSpec& spec) {
  if (spec.dual_range && !navico::has_two_ranges(model_of(spec.kind))) {
    return "dual_range is not of this kind; navico_4g and navico_halo have two ranges";
  }
  if (spec.standby_after && (!is_navico(spec.kind))) {
    return "standby_after_s is not of this kind; Navico radars alone are told to stay awake";
  }
  const std::size_t longest = spec.kind == EmulationKind::raymarine_quantum ? 7 : 16;
  if (spec.serial.size() > longest) {
    return fmt::format("serial '{}' has more than {} characters", spec.serial, longest);
  }
  if (!spec.serial.empty() && spec.kind == EmulationKind::garmin_xhd) {
    return "serial is not of this kind: a Garmin xHD does not tell one";
  }
  return fault_of_addresses(spec);
}

std::unique_ptr<RadarEmulation> make_emulation(const EmulationSpec& spec) {
  if (spec.kind == EmulationKind::garmin_xhd) return make_garmin_xhd(GarminOptions{});
  if (spec.kind == EmulationKind::raymarine_quantum) return make_quantum(quantum_options(spec));
  return make_navico_radar(navico_options(spec));
}

EmulationIdentity identity_of(const EmulationSpec& spec) {
  if (spec.kind == EmulationKind::garmin_xhd) return identity_of(GarminOptions{});
  if (spec.kind == EmulationKind::raymarine_quantum) return identity_of(quantum_options(spec));
  return navico_identity(navico_options(spec));
}

}  // namespace skerry::server
