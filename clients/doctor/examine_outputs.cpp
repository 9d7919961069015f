#include <fmt/format.h>

#include <algorithm>

#include "clients/doctor/examine.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client::doctor {
namespace {

const InterfaceAddress* find_address(const HostFacts& host, std::uint32_t address) {
  for (const InterfaceAddress& one : host.addresses) {
    // All of 127.0.0.0/8 is this host.
    if (one.address == address || (one.loopback && one.reaches(address))) return &one;
  }
  return nullptr;
}

std::string all_addresses(const HostFacts& host) {
  std::string text;
  for (const InterfaceAddress& one : host.addresses) {
    text += fmt::format("{}{} ({}{})", text.empty() ? "" : ", ", address_text(one.address),
                        printable(one.interface), one.up ? "" : ", down");
  }
  return text.empty() ? "none" : text;
}

// Whether the interface can carry anything.
bool examine_interface(const WantedOutput& output, const HostFacts& host, Findings& out) {
  const std::string about(output.kind->name);
  const std::string address = address_text(output.interface_address);
  const InterfaceAddress* own = find_address(host, output.interface_address);
  if (own == nullptr) {
    out.push_back({Grade::fault, about,
                   fmt::format("interface address {} is none of this host's, which are {}", address,
                               all_addresses(host)),
                   "give the output interface_address= one of these"});
    return false;
  }
  const std::string interface = printable(own->interface);
  if (!own->up || !own->linked) {
    out.push_back(
        {Grade::fault, about,
         fmt::format("interface {} with {} is {}", interface, address,
                     own->up ? "without a link: nothing is connected to it" : "switched off"),
         own->up ? "look at the cable and at what is at its other end"
                 : fmt::format("ip link set {} up", interface)});
    return false;
  }
  if (!own->multicast && !own->loopback) {
    out.push_back(
        {Grade::fault, about,
         fmt::format("interface {} with {} carries no multicast", interface, address),
         fmt::format("ip link set {} multicast on, or take another interface", interface)});
    return false;
  }
  out.push_back({Grade::good, about, fmt::format("sends from {} on {}", address, interface), ""});
  return true;
}

// Displays on this host that choose no interface take the one that the route leads to.
void examine_route(const WantedOutput& output, const Case& of, const HostFacts& host,
                   Findings& out) {
  const std::string about(output.kind->name);
  const InterfaceAddress* own = find_address(host, output.interface_address);
  const bool display_here = !of.display || find_address(host, *of.display) != nullptr;
  const Grade grade = display_here ? Grade::fault : Grade::hint;
  const std::string advice =
      fmt::format("ip route add 224.0.0.0/4 dev {}", printable(own->interface));
  if (own->loopback) return;  // no route leads groups there: displays on it name the interface
  if (!host.groups_leave_from) {
    out.push_back(
        {grade, about,
         "there is no route for multicast: programs on this host that choose no interface "
         "neither hear nor ask a radar",
         advice});
  } else if (*host.groups_leave_from != output.interface_address) {
    out.push_back(
        {Grade::hint, about,
         fmt::format("programs on this host that choose no interface use {} for "
                     "multicast, not {}",
                     address_text(*host.groups_leave_from), address_text(output.interface_address)),
         advice + ", or choose the interface in the display"});
  } else {
    out.push_back({Grade::good, about, "the route of multicast leads to its interface", ""});
  }
}

void examine_network(const WantedOutput& output, const Case& of, const HostFacts& host,
                     Findings& out) {
  const std::string about(output.kind->name);
  const std::string address = address_text(output.interface_address);
  const bool loopback = is_loopback(output.interface_address);
  const bool display_here = of.display && find_address(host, *of.display) != nullptr;
  if (of.display && !display_here) {
    const InterfaceAddress* own = find_address(host, output.interface_address);
    if (loopback) {
      out.push_back({Grade::fault, about,
                     fmt::format("it sends on loopback ({}), which the display at {} never hears",
                                 address, address_text(*of.display)),
                     "give the output interface_address= the address of this host in the "
                     "display's network"});
    } else if (!own->reaches(*of.display)) {
      out.push_back({Grade::fault, about,
                     fmt::format("the display at {} is not in the network of {} (mask {}); "
                                 "multicast of TTL 1 does not leave it",
                                 address_text(*of.display), address, address_text(own->mask)),
                     "put both into one network"});
    }
  }
  if (output.kind->mask == 0 || (output.interface_address & output.kind->mask) ==
                                    (output.kind->network & output.kind->mask)) {
    return;
  }
  const std::string wanted = fmt::format("{}/{}", address_text(output.kind->network),
                                         static_cast<int>(__builtin_popcount(output.kind->mask)));
  out.push_back(
      {loopback ? Grade::hint : Grade::fault, about,
       fmt::format("{} is not in {}, where its displays look for a radar", address, wanted),
       fmt::format("ip addr add 172.16.2.1/12 dev INTERFACE, and interface_address= "
                   "that address{}",
                   loopback ? "; a display on this host may do without" : "")});
}

void examine_asked(const WantedOutput& output, const Case& of, Findings& out) {
  if (!of.status) return;
  const std::string address = address_text(output.interface_address);
  for (const auto& one : of.status->outputs()) {
    if (one.name() != output.kind->name || one.interface_address() != address) continue;
    const std::string about(output.kind->name);
    if (one.datagrams_unsent() > 0) {
      out.push_back({Grade::hint, about,
                     fmt::format("{} of {} datagrams were not taken by the system or came too late",
                                 one.datagrams_unsent(), one.datagrams() + one.datagrams_unsent()),
                     "see what else this host and this interface do"});
    }
    if (one.commands() == 0) {
      out.push_back({Grade::hint, about, "no display has said anything to it yet",
                     "start the display and look again; server/displays/GUIDES.md goes through "
                     "displays one by one"});
    } else {
      out.push_back(
          {Grade::good, about,
           fmt::format("asked or commanded {} times, last by {} (a doctor's question is one of "
                       "them); {} refused",
                       one.commands(), printable(one.last_display()), one.commands_refused()),
           ""});
    }
  }
}

void examine_firewall(const HostFacts& host, Findings& out) {
  switch (host.firewall) {
    case Firewall::none:
      out.push_back({Grade::good, "firewall", "no rules seen", ""});
      break;
    case Firewall::open:
      out.push_back({Grade::good, "firewall", "rules, but what they do not name comes in", ""});
      break;
    case Firewall::drops:
      out.push_back({Grade::hint, "firewall",
                     "what its rules do not name is dropped: displays' commands may not come in, "
                     "nor radars' pictures",
                     "let UDP of the radars' ports in (server/displays/README.md), and TCP of the "
                     "server's"});
      break;
    case Firewall::unreadable:
      out.push_back({Grade::hint, "firewall", "there may be rules, which only root may read",
                     "run the doctor as root"});
      break;
  }
  if (host.strict_interfaces.size() > 1) {
    std::string names;
    for (const std::string& one : host.strict_interfaces) {
      names += (names.empty() ? "" : ", ") + printable(one);
    }
    out.push_back({Grade::hint, "routes",
                   fmt::format("{} drop what comes from a network to which another interface "
                               "leads (rp_filter 1)",
                               names),
                   "sysctl net.ipv4.conf.all.rp_filter=2, where radars or displays are behind "
                   "several interfaces"});
  }
}

}  // namespace

Findings examine_outputs(const Case& of, const HostFacts& host) {
  Findings out;
  for (const WantedOutput& output : of.outputs) {
    if (of.on_this_host && examine_interface(output, host, out)) {
      examine_route(output, of, host, out);
      examine_network(output, of, host, out);
    }
    examine_asked(output, of, out);
  }
  for (std::size_t i = 0; i < of.outputs.size(); ++i) {
    for (std::size_t j = i + 1; j < of.outputs.size(); ++j) {
      const WantedOutput &a = of.outputs[i], &b = of.outputs[j];
      if (a.interface_address != b.interface_address || !a.kind->fixed_addresses ||
          !b.kind->fixed_addresses || a.kind->report != b.kind->report) {
        continue;
      }
      out.push_back({Grade::fault, std::string(a.kind->name),
                     fmt::format("{} is wanted at {} as well: displays take both for one radar",
                                 b.kind->name, address_text(a.interface_address)),
                     "give one of them another interface"});
    }
  }
  if (of.on_this_host) examine_firewall(host, out);
  return out;
}

}  // namespace skerry::client::doctor
