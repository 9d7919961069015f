#include "server/app/fleet/fleet_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <random>
#include <utility>

#include "protocol/digest/digest.hpp"
#include "server/app/control/control_ranges.hpp"
#include "server/app/fleet/fleet_order.pb.h"
#include "server/app/fleet/world_digest.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::seconds kGroundedAgain{2};

// Names this run, so that no two runs of a host ever give the same id.
std::string new_run() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

std::string bytes_of(const std::string& origin, const wire::Set& set) {
  app::FleetOrder order;
  order.set_origin(origin);
  *order.mutable_set() = set;
  order.mutable_set()->clear_token();
  return order.SerializeAsString();
}

}  // namespace

FleetHost::FleetHost(RadarServer& radars, fleet::MemberPlan plan)
    : radars_(radars),
      host_(plan.host),
      exercise_(plan.exercise),
      at_host_(" at " + plan.host),
      run_(new_run()),
      beginning_{radars.timeline().world(), radars.desk().kept()},
      member_(std::move(plan), *this) {
  radars_.timeline().keep_to(0);
  radars_.set_fleet(this);
}

std::string FleetHost::new_id() {
  return fmt::format("{}-{}-{}", host_, run_, ids_.fetch_add(1) + 1);
}

std::string FleetHost::standing() const {
  const fleet::MemberView view = member_.view();
  return view.problem.empty() ? view.standing : view.standing + ": " + view.problem;
}

void FleetHost::order(const wire::Set& set, const std::string& origin, const Answered& later) {
  std::string id = new_id();
  {
    const std::lock_guard lock(mutex_);
    pending_[id] = {later, fleet::host_now() + kAnswer};
  }
  append(id, bytes_of(known_as(origin), set));
}

void FleetHost::leave(const std::string& origin) {
  app::FleetOrder order;
  order.set_origin(known_as(origin));
  order.set_left(true);
  append(new_id(), order.SerializeAsString());
}

void FleetHost::ground(const wire::ExerciseOrder& order) {
  if (!member_.leads()) return;
  const auto now = fleet::host_now();
  {
    const std::lock_guard lock(mutex_);
    const auto [told, is_new] = grounded_.emplace(order.aground(), now);
    if (!is_new && now - told->second < kGroundedAgain) return;
    told->second = now;
  }
  wire::Set set;
  set.set_instructor(true);
  *set.mutable_exercise() = order;
  append(new_id(), bytes_of(ShoreThread::kBy, set));
}

std::string FleetHost::shown(const std::string& known_as) const {
  return known_as.ends_with(at_host_) ? known_as.substr(0, known_as.size() - at_host_.size())
                                      : known_as;
}

wire::Fleet FleetHost::told() const {
  const fleet::MemberView view = member_.view();
  const auto now = fleet::host_now();
  wire::Fleet fleet;
  fleet.set_exercise(exercise_);
  fleet.set_host(host_);
  fleet.set_leader(view.leader);
  fleet.set_standing(view.standing);
  fleet.set_refusal(view.refusal);
  fleet.set_problem(view.problem);
  for (const fleet::HostSeen& seen : view.hosts) {
    wire::FleetHost* host = fleet.add_hosts();
    host->set_name(seen.name);
    host->set_native(seen.native);
    host->set_web(seen.web);
    host->set_standing(seen.standing);
    if (seen.tick != 0) {
      const std::string digest(seen.digest.begin(), seen.digest.end());
      host->set_tick(seen.tick);
      host->set_digest(hexadecimal(digest).substr(0, 16));
    }
    if (seen.heard != fleet::HostTime{} && seen.name != host_)
      host->set_heard_s(in_seconds(now - seen.heard));
    for (const std::size_t ship : seen.ships) {
      for (std::uint32_t radar = 0; radar < radars_.radar_count(); ++radar) {
        if (radars_.own_ship_of(radar) == ship) host->add_radars(radar);
      }
    }
  }
  return fleet;
}

void FleetHost::run_to(fleet::Tick tick) {
  radars_.timeline().keep_to(tick);
  radars_.timeline().make(tick);
}

void FleetHost::give(const fleet::OrderSeen& seen) {
  app::FleetOrder order;
  wire::Reply reply;
  if (!order.ParseFromString(seen.order)) {
    spdlog::error("fleet: order {} of host {} cannot be read; all hosts leave it out", seen.id,
                  seen.by);
  } else if (order.has_set()) {
    reply = radars_.desk().apply(order.set(), order.origin());
  } else if (order.has_host_left()) {
    lost_hosts_.erase(order.host_left());
    radars_.desk().leave_all(" at " + order.host_left());
  } else if (order.left()) {
    radars_.desk().leave(order.origin());
  }
  if (seen.by == host_) answer(seen.id, std::move(reply));
}

void FleetHost::refused(const std::string& id, const std::string& text) {
  answer(id, refusal(wire::Reply::REFUSED, text));
}

void FleetHost::answer(const std::string& id, wire::Reply reply) {
  Answered later;
  {
    const std::lock_guard lock(mutex_);
    const auto found = pending_.find(id);
    if (found == pending_.end()) return;
    later = std::move(found->second.later);
    pending_.erase(found);
  }
  later(std::move(reply));
}

void FleetHost::answer_late() {
  const auto now = fleet::host_now();
  std::vector<std::string> late;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, pending] : pending_) {
      if (now >= pending.until) late.push_back(id);
    }
  }
  for (const std::string& id : late) {
    refused(id,
            "it is not known whether the order holds: this host has not heard of it since it gave "
            "it; look before you give it again");
  }
}

void FleetHost::keep() { kept_.emplace(Kept{radars_.timeline().world(), radars_.desk().kept()}); }

void FleetHost::come_back(Back to) {
  const Kept& kept = to == Back::kept && kept_ ? *kept_ : beginning_;
  radars_.timeline().keep_to(kept.world.tick());
  radars_.timeline().restore(kept.world);
  radars_.desk().restore(kept.desk);
  spdlog::warn(
      "fleet: back to tick {} of the exercise; a recording of inputs that runs cannot be "
      "played from here on",
      kept.world.tick());
}

fleet::WorldDigest FleetHost::digest() const { return world_digest(*radars_.timeline().latest()); }

void FleetHost::hold(const std::vector<fleet::HostTime>& until) {
  if (const auto time = member_.time()) radars_.set_time(*time);
  const auto host_now = fleet::host_now();
  const auto now = std::chrono::steady_clock::now();
  for (std::size_t ship = 0; ship < until.size(); ++ship) {
    const bool holds = until[ship] > host_now;
    radars_.make_spokes_until(
        ship, holds ? now + (until[ship] - host_now) : std::chrono::steady_clock::time_point{});
    if (std::exchange(held_[ship], holds) == holds) continue;
    spdlog::info("fleet: own ship {}, {}: her radars are {} this host", ship,
                 radars_.timeline().latest()->own_ships[ship].name, holds ? "run by" : "left by");
  }
  answer_late();
  look_for_lost_hosts();
}

// Consoles of a host that is gone have no con any more.
void FleetHost::look_for_lost_hosts() {
  const fleet::MemberView view = member_.view();
  if (view.version != seen_version_) {
    seen_version_ = view.version;
    std::set<std::string> hosts;
    for (const fleet::HostSeen& host : view.hosts) hosts.insert(host.name);
    for (const std::string& host : seen_hosts_) {
      if (!hosts.contains(host)) lost_hosts_.insert(host);
    }
    for (const std::string& host : hosts) lost_hosts_.erase(host);
    seen_hosts_ = std::move(hosts);
  }
  if (lost_hosts_.empty() || !member_.leads()) return;
  for (const std::string& host : lost_hosts_) {
    app::FleetOrder order;
    order.set_host_left(host);
    append(new_id(), order.SerializeAsString());
  }
  lost_hosts_.clear();
}

}  // namespace skerry::server
