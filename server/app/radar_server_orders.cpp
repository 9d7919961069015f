// RadarServer: orders to it, and who else decides on them.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

#include "server/app/control/control_ranges.hpp"
#include "server/app/radar_mount.hpp"
#include "server/app/radar_server.hpp"

namespace skerry::server {

wire::Reply RadarServer::apply(const wire::Set& set, const std::string& origin) {
  // Who cannot wait is told at least what is known now.
  if (fleet_ != nullptr && desk_->parts_of(set).shared) {
    if (auto wrong = fleet_->refusal()) return refusal(wire::Reply::REFUSED, *wrong);
  }
  return apply_or_ask(set, origin, [](const wire::Reply&) {}).value_or(wire::Reply{});
}

std::optional<wire::Reply> RadarServer::apply_or_ask(const wire::Set& set,
                                                     const std::string& origin,
                                                     const Answered& later) {
  if (fleet_ == nullptr) return desk_->apply(set, origin);
  const ControlDesk::Parts parts = desk_->parts_of(set);
  if (!parts.shared) return desk_->apply(set, origin);
  const std::string known_as = fleet_->known_as(origin);
  if (auto wrong = desk_->refusal_now(*parts.shared, known_as)) return wrong;
  if (!parts.own) {
    fleet_->order(*parts.shared, origin, later);
    return std::nullopt;
  }
  // All or nothing: what is this host's alone follows what all grant.
  if (auto wrong = desk_->refusal_now(*parts.own, known_as)) return wrong;
  fleet_->order(*parts.shared, origin,
                [this, own = *parts.own, origin, later](const wire::Reply& reply) {
                  later(reply.code() == wire::Reply::OK ? desk_->apply(own, origin) : reply);
                });
  return std::nullopt;
}

void RadarServer::set_fleet(FleetPort* fleet) {
  fleet_ = fleet;
  for (auto& mount : radars_) mount->unit.make_spokes_until({});
  shore_.set_elsewhere([this](const wire::ExerciseOrder& order) { fleet_->ground(order); });
}

std::optional<wire::Fleet> RadarServer::fleet() const {
  return fleet_ ? std::optional(fleet_->told()) : std::nullopt;
}

std::size_t RadarServer::own_ship_of(std::uint32_t radar) const {
  return radars_.at(radar)->unit.config().own_ship;
}

void RadarServer::set_time(Duration time) {
  // What differs less is how long messages took.
  constexpr Duration kKeeps = std::chrono::milliseconds(10);
  const std::shared_ptr<const Epoch> epoch = epoch_.get();
  if (!epoch) return;
  const Duration shift = (std::chrono::steady_clock::now() - epoch->steady) - time;
  if (std::chrono::abs(shift - Duration(shift_.load())) < kKeeps) return;
  shift_.store(shift.count());
  for (auto& mount : radars_) mount->unit.shift_epoch(shift);
  tell_clock(*system_utc_.get());
}

void RadarServer::make_spokes_until(std::size_t own_ship,
                                    std::chrono::steady_clock::time_point end) {
  for (auto& mount : radars_) {
    if (mount->unit.config().own_ship == own_ship) mount->unit.make_spokes_until(end);
  }
}

void RadarServer::leave(const std::string& origin) {
  if (fleet_ == nullptr) return desk_->leave(origin);
  if (desk_->has_a_con(fleet_->known_as(origin))) fleet_->leave(origin);
}

std::string RadarServer::con_shown(std::uint32_t radar) const {
  const std::string con = desk_->con_of(radar);
  return fleet_ ? fleet_->shown(con) : con;
}

std::optional<std::string> RadarServer::drive(std::uint32_t radar, const OwnShipFix& fix) {
  if (radar >= radars_.size()) {
    return fmt::format("no radar {}; there are radars 0 to {}", radar, radars_.size() - 1);
  }
  if (fleet_ != nullptr) {
    return "own ships of a fleet's exercise are not driven from outside: all hosts move them alike";
  }
  const Mount& mount = *radars_[radar];
  try {
    const std::size_t ship = mount.unit.config().own_ship;
    const ScenarioTime now = instant().time;
    const auto giving = inputs_.giving();
    const Timeline::Driven driven = timeline_.drive(ship, fix, now);
    inputs_.driven(driven.tick, ship, fix, now);
    if (driven.begins) {
      spdlog::info("own ship {}: driven from outside from now on", mount.own_ship);
    }
  } catch (const std::invalid_argument& wrong) {
    return wrong.what();
  }
  return std::nullopt;
}

}  // namespace skerry::server
