// skerry doctor: why does the display show nothing?
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/doctor/examine.hpp"
#include "protocol/wire/host_and_port.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using doctor::Finding;
using doctor::Findings;
using doctor::Grade;

constexpr double kMostListening = 600.0;  // s

struct DoctorOptions {
  ServerPlace place;
  std::vector<std::string> outputs;
  std::string display;
  double listen_s = 5.0;  // some radars report every 2 s
  std::uint16_t http_port = 7480;
  bool json = false;
};

// "navico_4g:interface_address=192.0.2.7,radar=1", as skerryd takes it; other keys are not looked
// at. Error: what is wrong with it.
Result<doctor::WantedOutput, std::string> wanted_output(const std::string& text) {
  const std::size_t colon = text.find(':');
  doctor::WantedOutput output;
  output.kind = doctor::find_radar_kind(text.substr(0, colon));
  if (output.kind == nullptr) {
    std::string kinds;
    for (const auto& kind : doctor::radar_kinds()) {
      kinds += fmt::format("{}{}", kinds.empty() ? "" : ", ", kind.name);
    }
    return Failure{fmt::format("'{}' is no emulated radar; these are: {}",
                               printable(text.substr(0, colon)), kinds)};
  }
  constexpr std::string_view kKey = "interface_address=";
  std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1) + ",";
  for (std::size_t comma; (comma = rest.find(',')) != std::string::npos;
       rest = rest.substr(comma + 1)) {
    const std::string pair = rest.substr(0, comma);
    if (!pair.starts_with(kKey)) continue;
    const auto address = doctor::address_of_text(pair.substr(kKey.size()));
    if (!address) {
      return Failure{fmt::format("'{}' is no IPv4 address such as 192.0.2.7",
                                 printable(pair.substr(kKey.size())))};
    }
    output.interface_address = *address;
  }
  return output;
}

std::vector<doctor::WantedOutput> outputs_of(const wire::Status& status) {
  std::vector<doctor::WantedOutput> out;
  for (const auto& one : status.outputs()) {
    const doctor::RadarKind* kind = doctor::find_radar_kind(one.name());
    const auto address = doctor::address_of_text(one.interface_address());
    if (kind != nullptr && address) out.push_back({kind, *address});
  }
  return out;
}

// Where to listen: at each output.  Where none is named, or the server is elsewhere: on all of this
// host's interfaces, for the radars that it has, or for all kinds.
std::vector<doctor::Ear> ears_of(const doctor::Case& of, const doctor::HostFacts& host) {
  std::vector<Ipv4Endpoint> groups;
  for (const auto& output : of.outputs) groups.push_back(output.kind->report);
  if (of.outputs.empty()) {
    for (const auto& kind : doctor::radar_kinds()) groups.push_back(kind.report);
  }
  std::vector<doctor::Ear> ears;
  if (of.on_this_host && !of.outputs.empty()) {
    for (const auto& output : of.outputs) {
      ears.push_back({output.interface_address, output.kind->report});
    }
  } else {
    for (const auto& own : host.addresses) {
      for (const Ipv4Endpoint& group : groups) {
        if (own.up) ears.push_back({own.address, group});
      }
    }
  }
  std::sort(ears.begin(), ears.end());
  ears.erase(std::unique(ears.begin(), ears.end()), ears.end());
  return ears;
}

void add(Findings& all, Findings more) {
  for (Finding& one : more) all.push_back(std::move(one));
}

int run_doctor(const DoctorOptions& options) {
  doctor::Case of;
  of.tcp_port = options.place.port;
  of.http_port = options.http_port;
  if (!options.display.empty()) {
    of.display = doctor::address_of_text(options.display);
    if (!of.display) {
      report(fmt::format("--display '{}' is no IPv4 address such as 192.0.2.8",
                         printable(options.display)));
      return kExitUsage;
    }
  }
  for (const std::string& text : options.outputs) {
    const auto output = wanted_output(text);
    if (!output) {
      report(output.error());
      return kExitUsage;
    }
    of.outputs.push_back(*output);
  }
  const doctor::HostFacts host = doctor::read_host_facts();
  const auto place = doctor::address_of_text(options.place.host);
  of.on_this_host =
      options.place.host == "localhost" ||
      (place && (doctor::is_loopback(*place) ||
                 std::any_of(host.addresses.begin(), host.addresses.end(),
                             [&](const auto& own) { return own.address == *place; })));
  of.server = host_and_port(options.place.host, options.place.port);
  const auto keep_problem = [&](const ClientError& error) {
    of.problem = error.text;
    of.is_refused = error.kind == ClientErrorKind::rejected;
  };
  if (auto client = options.place.connect()) {
    if (const auto status = client->get_status(options.place.timeout())) {
      of.status = *status;
      if (of.outputs.empty()) of.outputs = outputs_of(*status);
    } else {
      keep_problem(status.error());
    }
  } else {
    keep_problem(client.error());
  }
  Findings findings = doctor::examine_server(of, host);
  add(findings, doctor::examine_outputs(of, host));
  if (options.listen_s > 0.0) {
    Progress progress;
    progress.show(fmt::format("listening for radars, {:g} s", options.listen_s));
    const auto radars = doctor::listen_for_radars(
        ears_of(of, host), seconds_as_duration(options.listen_s), [] { return !interrupted(); });
    progress.clear();
    add(findings, doctor::examine_radars(of, host, radars));
  }
  const auto count = [&](Grade grade) {
    return std::count_if(findings.begin(), findings.end(),
                         [&](const Finding& one) { return one.grade == grade; });
  };
  const auto faults = count(Grade::fault);
  write_out(options.json ? as_json(findings) : as_text(findings));
  if (!options.json) {
    write_out(fmt::format("{} fault{}, {} hint{}\n", faults, faults == 1 ? "" : "s",
                          count(Grade::hint), count(Grade::hint) == 1 ? "" : "s"));
  }
  return faults == 0 ? kExitOk : kExitFailure;
}

}  // namespace

Command make_doctor_command(CLI::App& app) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command = app.add_subcommand(
      "doctor",
      "Says why a display shows nothing: server, ports, interfaces, routes, firewall, "
      "radars on the network");
  options->place.add_options(*command);
  command->add_option("OUTPUT", options->outputs,
                      "Emulated radars as skerryd --output takes them; without any, those of the "
                      "server that answers");
  command->add_option("--display", options->display, "Address of the host on which the display is");
  command->add_option("--listen", options->listen_s, "Seconds to listen for radars; 0: not at all")
      ->check(CLI::Range(0.0, kMostListening))
      ->capture_default_str();
  command->add_option("--http-port", options->http_port, "The server's HTTP port")
      ->capture_default_str();
  command->add_flag("--json", options->json, "A list of {grade, about, text, advice}");
  command->footer(
      "Exit code 0: no fault was found, 1: there is one, 2: wrong command line.\n"
      "Examples:\n"
      "  skerry doctor\n"
      "  skerry doctor --display 192.0.2.8\n"
      "  skerry doctor garmin_xhd:interface_address=172.16.2.1\n");
  return {command, [options] { return run_doctor(*options); }};
}

}  // namespace skerry::client
