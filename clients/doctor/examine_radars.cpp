#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "clients/doctor/examine.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client::doctor {
namespace {

bool has_fixed_addresses(const Ipv4Endpoint& group) {
  const auto kinds = radar_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const RadarKind& kind) {
    return kind.report == group && kind.fixed_addresses;
  });
}

const char* maker_of(const Ipv4Endpoint& group) {
  for (const RadarKind& kind : radar_kinds()) {
    if (kind.report != group) continue;
    return kind.maker == Maker::navico   ? "Navico"
           : kind.maker == Maker::garmin ? "Garmin"
                                         : "Raymarine";
  }
  return "radar";
}

void examine_deaf(const HeardRadars& radars, const HostFacts& host, Findings& out) {
  for (const auto& [ear, problem] : radars.deaf) {
    if (problem == EADDRNOTAVAIL || problem == ENODEV) continue;  // examined as an interface
    std::string owner;
    for (const Listener& one : host.listeners) {
      const bool in_the_way = one.at.address == 0 || one.at.address == ear.group.address;
      if (!one.tcp && in_the_way && one.at.port == ear.group.port && owner.empty()) {
        owner = one.program.empty() ? "another user's program" : printable(one.program);
      }
    }
    const bool taken = problem == EADDRINUSE;
    out.push_back({Grade::fault, fmt::format("port {}", ear.group.port),
                   taken ? fmt::format("{} has UDP port {} for itself alone: neither a {} "
                                       "radar nor its displays can use it on this host",
                                       owner.empty() ? "a program" : owner, ear.group.port,
                                       maker_of(ear.group))
                         : fmt::format("cannot listen to {} on {}: {}", text_of(ear.group),
                                       address_text(ear.interface_address), std::strerror(problem)),
                   taken ? "end that program" : ""});
  }
}

// What keeps displays from telling two apart; nothing if they can.
std::optional<Finding> conflict_of(const Heard& a, const Heard& b) {
  if (a.ear.group != b.ear.group || a.ear.interface_address != b.ear.interface_address) return {};
  const std::string both = fmt::format("{} and {}", text_of(a.sender), text_of(b.sender));
  const std::string about = maker_of(a.ear.group);
  if (has_fixed_addresses(a.ear.group)) {
    const bool one_address = a.sender.address == b.sender.address;
    const bool told_apart = !one_address && is_loopback(a.sender.address);
    return Finding{told_apart ? Grade::hint : Grade::fault, about,
                   fmt::format("two radars send to {}: {}{}; displays take them for one",
                               text_of(a.ear.group), both, one_address ? ", of one address" : ""),
                   "switch one off, or put it on another network (interface_address)"};
  }
  if (!a.serial.empty() && a.serial == b.serial) {
    return Finding{Grade::fault, about,
                   fmt::format("two radars have the serial {}: {}", printable(a.serial, 32), both),
                   "give one of them another serial="};
  }
  if (a.data.port != 0 && a.data == b.data) {
    return Finding{Grade::fault, about,
                   fmt::format("two radars send their pictures to {}: {}", text_of(a.data), both),
                   "give one of them other groups (addresses=)"};
  }
  return {};
}

// At most one for each radar, however many there are.
void examine_conflicts(const HeardRadars& radars, Findings& out) {
  for (std::size_t i = 0; i < radars.heard.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      auto conflict = conflict_of(radars.heard[j], radars.heard[i]);
      if (!conflict) continue;
      out.push_back(*std::move(conflict));
      break;
    }
  }
}

// Silence where the server's own radar should be heard: at its interface, or from another host.
void examine_own(const Case& of, const HeardRadars& radars, Findings& out) {
  if (!of.status) return;
  for (const WantedOutput& output : of.outputs) {
    const std::string address = address_text(output.interface_address);
    const auto is_here = [&](const Ear& ear) {
      return ear.group == output.kind->report &&
             (!of.on_this_host || ear.interface_address == output.interface_address);
    };
    const bool is_servers =
        std::any_of(of.status->outputs().begin(), of.status->outputs().end(), [&](const auto& one) {
          return one.name() == output.kind->name && one.interface_address() == address;
        });
    const bool heard = std::any_of(radars.heard.begin(), radars.heard.end(), [&](const Heard& one) {
      return is_here(one.ear) && one.sender.address == output.interface_address;
    });
    const bool deaf = std::any_of(radars.deaf.begin(), radars.deaf.end(),
                                  [&](const auto& one) { return is_here(one.ear); });
    if (!is_servers || heard || deaf) continue;
    out.push_back({Grade::fault, std::string(output.kind->name),
                   fmt::format("the server has it at {}, but nothing of it is heard at {} on {}",
                               address, text_of(output.kind->report),
                               of.on_this_host ? "that interface" : "any interface of this host"),
                   of.on_this_host ? "look at the firewall of this host, and listen longer "
                                     "(--listen)"
                                   : "look at the networks of both hosts, at the firewall of this "
                                     "one, and at switches between that keep multicast back"});
  }
}

}  // namespace

Findings examine_radars(const Case& of, const HostFacts& host, const HeardRadars& radars) {
  Findings out;
  examine_deaf(radars, host, out);
  for (const Heard& one : radars.heard) {
    const std::string serial =
        one.serial.empty() ? "" : fmt::format(", serial {}", printable(one.serial, 32));
    out.push_back({Grade::good, maker_of(one.ear.group),
                   fmt::format("a radar at {} is heard{} ({} datagrams)", text_of(one.sender),
                               serial, one.datagrams),
                   ""});
  }
  examine_conflicts(radars, out);
  examine_own(of, radars, out);
  return out;
}

}  // namespace skerry::client::doctor
