#include "clients/doctor/examine.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client::doctor {
namespace {

const Listener* find_tcp(const HostFacts& host, std::uint16_t port) {
  const auto found =
      std::find_if(host.listeners.begin(), host.listeners.end(),
                   [&](const Listener& one) { return one.tcp && one.at.port == port; });
  return found == host.listeners.end() ? nullptr : &*found;
}

std::string owner_of(const Listener& listener) {
  return listener.program.empty() ? "another user's program" : printable(listener.program);
}

void examine_ports(const Case& of, const HostFacts& host, Findings& out) {
  const std::pair<std::uint16_t, const char*> ports[] = {{of.tcp_port, "--tcp-port"},
                                                         {of.http_port, "--http-port"}};
  for (const auto& [port, option] : ports) {
    const std::string about = fmt::format("port {}", port);
    const Listener* taken = find_tcp(host, port);
    if (taken == nullptr) {
      out.push_back({Grade::good, about, "free for skerryd", ""});
    } else {
      out.push_back(
          {Grade::fault, about,
           fmt::format("taken by {}, which is no skerryd that answers", owner_of(*taken)),
           fmt::format("end that program, or start skerryd with {} and another port", option)});
    }
  }
}

}  // namespace

std::string address_text(std::uint32_t address) {
  const std::string text = text_of(Ipv4Endpoint{address, 0});
  return text.substr(0, text.find(':'));
}

std::optional<std::uint32_t> address_of_text(std::string_view text) {
  const auto endpoint = ipv4_endpoint(std::string(text) + ":0");
  return endpoint ? std::optional(endpoint->address) : std::nullopt;
}

Findings examine_server(const Case& of, const HostFacts& host) {
  Findings out;
  if (of.is_refused) {
    out.push_back({Grade::hint, "server", of.problem,
                   "say who you are, by --user or SKERRY_TOKEN: then its outputs are looked at"});
    return out;
  }
  if (!of.status) {
    out.push_back({Grade::hint, "server", of.problem,
                   "start skerryd, or say where it is with --host and --port"});
    if (of.on_this_host) examine_ports(of, host, out);
    return out;
  }
  out.push_back({Grade::good, "server",
                 fmt::format("{} at {}: radars {}, outputs {}", printable(of.status->server()),
                             of.server, of.status->radars_size(), of.status->outputs_size()),
                 ""});
  if (!of.display || !of.on_this_host) return out;
  const bool elsewhere =
      std::none_of(host.addresses.begin(), host.addresses.end(),
                   [&](const InterfaceAddress& one) { return one.address == *of.display; });
  const Listener* http = find_tcp(host, of.http_port);
  if (elsewhere && http != nullptr && is_loopback(http->at.address)) {
    out.push_back({Grade::fault, fmt::format("port {}", of.http_port),
                   fmt::format("the server listens on {} alone, so no console, Signal K or native "
                               "display at {} reaches it",
                               address_text(http->at.address), address_text(*of.display)),
                   "start skerryd with --bind and the address of this host in that network"});
  }
  for (const auto& client : of.status->clients()) {
    if (!elsewhere || client.transport().find("udp") == std::string::npos) continue;
    if (!client.peer().starts_with("127.")) continue;
    out.push_back({Grade::hint, printable(client.transport()),
                   fmt::format("datagrams go to {}, not to the display at {}",
                               printable(client.peer()), address_text(*of.display)),
                   "give --udp or --cat240 the display's address"});
  }
  return out;
}

}  // namespace skerry::client::doctor
