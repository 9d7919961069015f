#include "server/app/fleet/joined_fleet.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

#include "protocol/wire/host_and_port.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/fleet/fleet_store.hpp"
#include "server/app/version.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr std::chrono::seconds kTell{5};

std::vector<std::string> charter_of(const Options& options, const std::string& scenario) {
  std::vector<std::string> charter =
      exercise_digests(scenario, {options.charts, options.elevation});
  charter.insert(charter.begin(), fmt::format("version {}", kServerName));
  return charter;
}

}  // namespace

std::unique_ptr<FleetHost> join_fleet(
    const Options& options, RadarServer& radars, const NetServer& net, const std::string& scenario,
    const std::function<bool(std::chrono::milliseconds)>& is_to_end) {
  const FleetOptions& fleet = options.fleet;
  if (fleet.store.empty()) return nullptr;
  const bool encrypted = !options.net.tls.empty();
  fleet::MemberPlan plan;
  plan.exercise = fleet.exercise;
  plan.host = fleet.host;
  plan.ships = radars.timeline().latest()->own_ships.size();
  plan.charter = charter_of(options, scenario);
  plan.native = (encrypted ? "tls://" : "") + host_and_port(fleet.address, net.tcp_port());
  plan.web = fmt::format("http{}://{}/", encrypted ? "s" : "",
                         host_and_port(fleet.address, net.http_port()));
  plan.store = open_fleet_store(fleet.store, fleet.tls);
  auto host = std::make_unique<FleetHost>(radars, std::move(plan));
  host->start();
  spdlog::info("fleet: {} joins exercise {}", fleet.host, fleet.exercise);
  for (auto waited = kLook; !host->time(); waited += kLook) {
    if (const auto ended = host->ended()) throw std::runtime_error("--fleet: " + *ended);
    if (waited % kTell == std::chrono::milliseconds(0))
      spdlog::warn("fleet: still {}", host->standing());
    if (is_to_end(kLook)) {
      host->stop();
      return host;
    }
  }
  return host;
}

}  // namespace skerry::server
