#include "server/app/options/fleet_options.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <sstream>
#include <stdexcept>

#include "server/app/config.pb.h"
#include "server/app/options/field_options.hpp"
#include "server/fleet/log_keys.hpp"
#include "server/net/common/net_config.hpp"

namespace skerry::server {
namespace {

std::string machine_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

bool is_any(const std::string& bind) { return bind == "0.0.0.0" || bind == "::"; }

void refuse_beside_fleet(bool given, const char* what, const char* why) {
  if (given)
    throw std::runtime_error(fmt::format("{} and --fleet exclude each other: {}", what, why));
}

// "192.0.2.1:2379", "[2001:db8::1]:2379", "etcd-1:2379".
bool is_member(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  const std::string port = text.substr(colon + 1);
  return !port.empty() && port.size() <= 5 &&
         port.find_first_not_of("0123456789") == std::string::npos;
}

void require_name(const char* option, const std::string& name) {
  if (fleet::is_name(name)) return;
  throw std::runtime_error(fmt::format("{} \"{}\": expected 1 to {} letters, digits and . _ -",
                                       option, name, fleet::kMostName));
}

}  // namespace

void add_fleet_options(CLI::App& cli, app::Fleet& line) {
  FieldOptions add(cli, "Fleet");
  cli.add_option_function<std::string>(
         "--fleet",
         [&line](const std::string& text) {
           std::istringstream members(text);
           for (std::string member; std::getline(members, member, ',');) line.add_store(member);
         },
         "run the exercise with other hosts, over an etcd with these members")
      ->group("Fleet")
      ->type_name("HOST:PORT,...");
  add.text("--fleet-exercise", line, &app::Fleet::mutable_exercise,
           "name of the exercise in the store (exercise)")
      ->type_name("NAME");
  add.text("--fleet-host", line, &app::Fleet::mutable_host,
           "name of this host in the exercise (the machine's)")
      ->type_name("NAME");
  add.text("--fleet-address", line, &app::Fleet::mutable_address,
           "address by which others reach this host (what it is bound to)")
      ->type_name("ADDRESS");
  add.text("--fleet-tls", line, &app::Fleet::mutable_tls,
           "folder with ca.pem, host.pem and host.key, to reach the store encrypted")
      ->type_name("FOLDER");
}

FleetOptions fleet_options(const app::ServerConfig& config, const NetConfig& net) {
  FleetOptions options;
  if (!config.has_fleet()) return options;
  const app::Fleet& fleet = config.fleet();
  if (fleet.store().empty()) {
    throw std::runtime_error(
        "--fleet-exercise, --fleet-host, --fleet-address, --fleet-tls: over which store? give its "
        "members with --fleet HOST:PORT,HOST:PORT,...");
  }
  for (const std::string& member : fleet.store()) {
    if (!is_member(member)) {
      throw std::runtime_error(fmt::format(
          "--fleet \"{}\": expected HOST:PORT of an etcd's members, with commas between", member));
    }
    options.store.push_back(member);
  }
  refuse_beside_fleet(config.playback().has_file(), "--play",
                      "a recording is no exercise to take part in");
  refuse_beside_fleet(config.has_relay(), "--relay",
                      "a relay runs nothing; let it relay a host of the fleet");
  refuse_beside_fleet(!config.inputs().empty(), "--input",
                      "what comes from outside would move ships on one host alone");
  if (fleet.has_exercise()) options.exercise = fleet.exercise();
  options.host = fleet.has_host() ? fleet.host() : machine_name();
  options.address = fleet.has_address() ? fleet.address()
                    : is_any(net.bind)  ? machine_name()
                                        : net.bind;
  options.tls = fleet.tls();
  require_name("--fleet-exercise", options.exercise);
  require_name("--fleet-host", options.host);
  return options;
}

}  // namespace skerry::server
