// skerry cluster: the hosts that run an exercise together, as one of them knows it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/message_json.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

std::string radars_of(const wire::FleetHost& host) {
  return host.radars().empty() ? "-" : fmt::format("{}", fmt::join(host.radars(), " "));
}

// Hosts tell of their worlds at moments of their own.
std::string world_of(const wire::FleetHost& host) {
  if (host.tick() == 0) return "-";
  return fmt::format("{} {:>8.0f} s", printable(host.digest(), 16),
                     0.1 * static_cast<double>(host.tick()));
}

// Hosts tell of the same second at times of their own: only those of one tick are compared.
std::string worlds(const wire::Fleet& fleet) {
  std::map<std::uint64_t, std::map<std::string, std::string>> ticks;
  for (const wire::FleetHost& host : fleet.hosts()) {
    if (host.tick() != 0) ticks[host.tick()][host.digest()] += " " + printable(host.name(), 40);
  }
  for (const auto& [tick, digests] : ticks) {
    if (digests.size() < 2) continue;
    std::string out = fmt::format("WORLDS DIFFER after {:.1f} s:", 0.1 * static_cast<double>(tick));
    for (const auto& [digest, hosts] : digests) out += fmt::format(" {}:{};", digest, hosts);
    return out + "\n";
  }
  return "";
}

std::string table_of(const wire::Fleet& fleet, const std::string& place) {
  std::string out =
      fmt::format("exercise {}, seen from {} at {}: {}\nleader: {}\n", printable(fleet.exercise()),
                  printable(fleet.host()), place, printable(fleet.standing()),
                  fleet.leader().empty() ? "nobody" : printable(fleet.leader()));
  if (!fleet.refusal().empty())
    out += fmt::format("takes no orders: {}\n", printable(fleet.refusal(), 400));
  if (!fleet.problem().empty()) out += fmt::format("store: {}\n", printable(fleet.problem(), 400));
  out += fmt::format("\n{:<20} {:<26} {:<34} {:<14} {:>8} {:<26} {}\n", "HOST", "NATIVE PROTOCOL",
                     "PAGES", "STANDING", "HEARD", "WORLD", "RADARS");
  for (const wire::FleetHost& host : fleet.hosts()) {
    const bool told = !host.native().empty();
    out += fmt::format(
        "{:<20} {:<26} {:<34} {:<14} {:>8} {:<26} {}\n", printable(host.name(), 20),
        told ? printable(host.native(), 60) : "-", told ? printable(host.web(), 60) : "-",
        host.standing().empty() ? "-" : printable(host.standing(), 14),
        host.name() == fleet.host() ? "here" : fmt::format("{:.1f} s", host.heard_s()),
        world_of(host), radars_of(host));
  }
  return out + worlds(fleet);
}

int run_cluster_status(const ServerPlace& place, bool as_json) {
  auto client = place.connect();
  if (!client) return report(client.error());
  if (!client->hello().has_fleet()) {
    return report(fmt::format("{} runs its exercise alone", client->name()),
                  "A host of a fleet is started with skerryd --fleet.");
  }
  const wire::Fleet& fleet = client->hello().fleet();
  write_out(as_json ? json_text(fleet) : table_of(fleet, client->name()));
  return kExitOk;
}

}  // namespace

Command make_cluster_command(CLI::App& app) {
  auto place = std::make_shared<ServerPlace>();
  auto as_json = std::make_shared<bool>(false);
  CLI::App* cluster =
      app.add_subcommand("cluster", "The hosts that run an exercise together: skerryd --fleet");
  cluster->require_subcommand(1);
  CLI::App* command = cluster->add_subcommand(
      "status", "Shows the hosts, who leads, whose radars turn where, whether worlds are the same");
  place->add_options(*command);
  command->add_flag("--json", *as_json, "The Fleet message of fleet.proto as JSON");
  command->footer(
      "Examples:\n"
      "  skerry cluster status\n"
      "  skerry cluster status --host bridge-1 --json | jq '.hosts[].radars'\n");
  return {cluster, [place, as_json] { return run_cluster_status(*place, *as_json); }};
}

}  // namespace skerry::client
