// skerry status: what a server is doing, as tables or JSON.
#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <memory>
#include <set>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/common/label_text.hpp"
#include "clients/common/printable_text.hpp"

namespace skerry::client {
namespace {

std::string hours_minutes_seconds(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string with_degree_signs(std::string text) {
  for (std::size_t at; (at = text.find('^')) != std::string::npos;) text.replace(at, 1, "\u00b0");
  return text;
}

std::string own_ships(const wire::Status& status) {
  std::string out = fmt::format("{:<20} {:<27} {:>7} {:>9} {:>10}  {}\n", "OWN SHIP", "POSITION",
                                "HEADING", "SPEED", "TURN/MIN", "ORDERED");
  std::set<std::string> seen;
  for (const auto& radar : status.radars()) {
    const wire::OwnShip& ship = radar.own_ship();
    if (!seen.insert(ship.name()).second) continue;
    out += with_degree_signs(fmt::format(
        "{:<20} {:<27} {:>7} {:>6.1f} kn {:>9.1f}^  {} {:.1f} kn\n", printable(ship.name(), 20),
        position_text({ship.latitude_deg(), ship.longitude_deg()}),
        bearing_text(ship.heading_deg()), ship.speed_kn(), ship.rate_of_turn_deg_min(),
        bearing_text(ship.ordered_course_deg()), ship.ordered_speed_kn()));
  }
  return out;
}

std::string radars(const wire::Status& status) {
  std::string out = fmt::format(
      "{:<5} {:<16} {:>9} {:>5} {:>4} {:>5} {:>8} {:>11} {:>6} {:>8} "
      "{:>9} {:>8} {:>7}\n",
      "RADAR", "NAME", "RANGE", "GAIN", "SEA", "RAIN", "SCAN", "SPOKES", "LATE", "SKIPPED", "WORST",
      "NS/CELL", "EDGES");
  for (const auto& radar : status.radars()) {
    const wire::Settings& settings = radar.settings();
    out += fmt::format(
        "{:<5} {:<16} {:>6g} NM {:>5.0f} {:>4.0f} {:>5.0f} {:>8} {:>11} {:>6} {:>8} "
        "{:>6.1f} ms {:>8.1f} {:>7}\n",
        radar.radar(), printable(radar.name(), 16), settings.range_nm(), settings.gain(),
        settings.sea(), settings.rain(), radar.scan(), radar.spokes(), radar.spokes_late(),
        radar.sectors_skipped(), radar.lateness_max_ms(), radar.render_ns_per_cell(),
        radar.coast_edges());
  }
  return out;
}

std::string clients(const wire::Status& status) {
  if (status.clients().empty()) return "no clients\n";
  std::string out = fmt::format("{:<9} {:<28} {:>5} {:>12} {:>10} {:>10}\n", "CLIENT", "PEER",
                                "RADAR", "SENT", "LOST", "MIB");
  for (const auto& client : status.clients()) {
    out += fmt::format("{:<9} {:<28} {:>5} {:>12} {:>10} {:>10.1f}\n",
                       printable(client.transport(), 9), printable(client.peer(), 48),
                       client.radar(), client.spokes_sent(), client.spokes_lost(),
                       static_cast<double>(client.bytes_sent()) / (1 << 20));
  }
  return out;
}

std::string errors(const wire::Status& status) {
  if (status.errors().empty()) return "no errors\n";
  std::string out = fmt::format("{:>10}  {}\n", "ERRORS", "KIND");
  for (const auto& [kind, count] : status.errors()) {
    out += fmt::format("{:>10}  {}\n", count, printable(kind));
  }
  return out;
}

std::string table(const wire::Status& status, const std::string& place) {
  return fmt::format(
      "{} at {}, scenario {}\nscenario time {}, up {}, {:.1f} MiB in memory\n\n"
      "{}\n{}\n{}\n{}",
      printable(status.server()), place, printable(status.scenario()),
      hours_minutes_seconds(status.scenario_s()), hours_minutes_seconds(status.uptime_s()),
      status.resident_mib(), own_ships(status), radars(status), clients(status), errors(status));
}

std::string json(const wire::Status& status) {
  google::protobuf::util::JsonPrintOptions format;
  format.add_whitespace = true;
  format.always_print_primitive_fields = true;
  format.preserve_proto_field_names = true;
  std::string out;
  const auto done = google::protobuf::util::MessageToJsonString(status, &out, format);
  if (!done.ok())
    throw std::runtime_error("the status cannot be written as JSON: " +
                             std::string(done.message()));
  return out;
}

int run_status(const ServerPlace& place, bool as_json) {
  auto client = place.connect();
  if (!client) return report(client.error());
  const auto status = client->get_status(place.timeout());
  if (!status) return report(status.error());
  write_out(as_json ? json(*status) : table(*status, client->name()));
  return kExitOk;
}

}  // namespace

Command make_status_command(CLI::App& app) {
  auto place = std::make_shared<ServerPlace>();
  auto as_json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("status", "Shows own ships, radars, clients, losses and errors");
  place->add_options(*command);
  command->add_flag("--json", *as_json,
                    "The Status message of radar.proto as JSON (64-bit counts "
                    "are strings, as protobuf writes them)");
  command->footer(
      "Examples:\n"
      "  skerry status\n"
      "  skerry status --host bridge-1 --json | jq '.radars[0].scan'\n");
  return {command, [place, as_json] { return run_status(*place, *as_json); }};
}

}  // namespace skerry::client
