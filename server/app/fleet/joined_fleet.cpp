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

// Whoever can write to the store gives orders in everybody's name.
void tell_of_open_store(const FleetOptions& fleet) {
  if (!fleet.tls.empty()) return;
  for (const std::string& member : fleet.store) {
    if (member.starts_with("127.") || member.starts_with("[::1]") ||
        member.starts_with("localhost:")) {
      continue;
    }
    spdlog::warn(
        "fleet: the store {} is reached in the clear; who can reach it, too, can order anything on "
        "all hosts. --fleet-tls encrypts, and a network of its own keeps others away",
        member);
    return;
  }
}

}  // namespace

JoinedFleet join_fleet(const Options& options, RadarServer& radars, const NetServer& net,
                       const std::string& scenario,
                       const std::function<bool(std::chrono::milliseconds)>& is_to_end) {
  const FleetOptions& fleet = options.fleet;
  JoinedFleet joined;
  if (fleet.store.empty()) return joined;
  tell_of_open_store(fleet);
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
  joined.host = std::make_unique<FleetHost>(radars, std::move(plan));
  joined.host->start();
  spdlog::info("fleet: {} joins exercise {}", fleet.host, fleet.exercise);
  for (auto waited = kLook;; waited += kLook) {
    if (const auto time = joined.host->time()) {
      joined.time = *time;
      joined.host->begin_anew();
      return joined;
    }
    if (const auto ended = joined.host->ended()) throw std::runtime_error("--fleet: " + *ended);
    if (waited % kTell == std::chrono::milliseconds(0))
      spdlog::warn("fleet: still {}", joined.host->standing());
    if (!is_to_end(kLook)) continue;
    joined.host->stop();
    joined.ends = true;
    return joined;
  }
}

}  // namespace skerry::server
