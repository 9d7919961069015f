#include "server/app/fleet/fleet_host.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <random>
#include <utility>

#include "clients/common/message_stream.hpp"
#include "protocol/digest/digest.hpp"
#include "server/app/control/control_ranges.hpp"
#include "server/app/fleet/fleet_order.pb.h"
#include "server/app/fleet/world_digest.hpp"
#include "server/relay/upstream_place.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::seconds kGroundedAgain{2};
constexpr std::chrono::seconds kLeaveAgain{1};
constexpr std::size_t kMostLeaving = 4096;
constexpr std::chrono::milliseconds kAskOthers{300};
constexpr const char* kAlone = "alone";

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

void FleetHost::start() {
  member_.start();
  others_.start("fleet-others", kAskOthers, [this](const std::stop_token&) { ask_others(); });
}

void FleetHost::stop() {
  others_.stop();
  member_.stop();
}

// A host that runs no server any more takes nothing; of one that does not answer that is not known.
void FleetHost::ask_others() {
  if (!member_.alone()) return;
  const fleet::HostTime asked = fleet::host_now();
  for (const fleet::HostSeen& host : member_.view().hosts) {
    if (host.name == host_) continue;
    const auto place = upstream_place(host.native);
    if (!place) return;
    client::MessageStream stream(place->host, place->port);
    const auto hello = stream.open(place->host, place->port, kAskOthers);
    if (hello && hello->fleet().standing() == kAlone) continue;
    if (hello || hello.error().kind != client::ClientErrorKind::refused) return;
  }
  member_.go_on_alone(asked);
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
  member_.order(id, bytes_of(known_as(origin), set));
}

void FleetHost::leave(const std::string& origin) {
  app::FleetOrder order;
  order.set_origin(known_as(origin));
  order.set_left(true);
  leave_until_known(order.SerializeAsString());
}

void FleetHost::begin_anew() {
  app::FleetOrder order;
  order.set_host_left(host_);
  leave_until_known(order.SerializeAsString());
}

void FleetHost::leave_until_known(const std::string& bytes) {
  const std::string id = new_id();
  {
    const std::lock_guard lock(mutex_);
    if (leaving_.size() >= kMostLeaving) return;
    leaving_[id] = {bytes, fleet::HostTime::max()};
  }
  member_.order(id, bytes);
}

void FleetHost::leave_again() {
  const auto now = fleet::host_now();
  std::vector<std::pair<std::string, std::string>> due;
  {
    const std::lock_guard lock(mutex_);
    for (auto& [id, leaving] : leaving_) {
      if (now < leaving.again) continue;
      leaving.again = fleet::HostTime::max();
      due.emplace_back(id, leaving.bytes);
    }
  }
  for (const auto& [id, bytes] : due) member_.order(id, bytes);
}

std::optional<std::string> FleetHost::refusal() const {
  const std::string text = member_.view().refusal;
  return text.empty() ? std::nullopt : std::optional(text);
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
  member_.order(new_id(), bytes_of(ShoreThread::kBy, set));
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
  // As of this moment: others rely on it.
  fleet.set_standing(member_.alone() ? kAlone : view.standing);
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
  if (seen.by != host_) return;
  {
    const std::lock_guard lock(mutex_);
    leaving_.erase(seen.id);
  }
  answer(seen.id, std::move(reply));
}

void FleetHost::refused(const std::string& id, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    const auto leaving = leaving_.find(id);
    if (leaving != leaving_.end()) leaving->second.again = fleet::host_now() + kLeaveAgain;
  }
  answer(id, server::refusal(wire::Reply::REFUSED, text));
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
  leave_again();
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
    leave_until_known(order.SerializeAsString());
  }
  lost_hosts_.clear();
}

}  // namespace skerry::server
