// What is to be told to a mariner: zones, approaches, capacity.
#include <fmt/format.h>

#include <algorithm>

#include "server/tracking/watch/desk.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

// Capacity: the caution begins and ends at these shares of it.  90 % is common; no figure is known
// to be fixed.
constexpr double kNear = 0.9, kNotNear = 0.85;
constexpr Duration kLeftOutFor = std::chrono::seconds(10);

std::string approach_text(const std::string& who, const PlottedApproach& approach) {
  return fmt::format("{}: CPA {:.1f} NM in {:.0f} min", who,
                     metres(approach.range_m).in_nautical_miles(),
                     std::max(0.0, approach.time_s / 60.0));
}

std::string new_text(const std::string& who, PlanePoint from_own_ship) {
  return fmt::format("{} is in a zone, {:.1f} NM, {:03.0f} deg", who,
                     metres(length_of(from_own_ship)).in_nautical_miles(),
                     direction_of(from_own_ship));
}

std::string who_is(const AisRecord& record) {
  return fmt::format("AIS target {} {}", record.contact.mmsi, record.contact.name);
}

}  // namespace

void TargetWatch::Desk::set_alert(bool is_on, AlertKind kind, const AlertSubject& subject,
                                  const std::string& text) {
  if (is_on) {
    alerts_.raise(kind, subject, text);
  } else {
    alerts_.end(kind, subject);
  }
}

void TargetWatch::Desk::watch_zones() {
  if (frozen_since_ || !plane_) return;
  const ZoneTable::Mask laid = zones_.take_laid();
  const auto entered = [&](PlanePoint from_own_ship, ZoneTable::Mask& zones) {
    const ZoneTable::Mask now = zones_.zones_at(
        length_of(from_own_ship), direction_of(from_own_ship), own_.heading_deg, zones);
    const auto into = static_cast<ZoneTable::Mask>(now & ~zones);
    zones = now;
    return into;
  };
  for (auto& [number, watched] : targets_) {
    const PlanePoint from = from_own_ship(watched.track);
    unsigned into = entered(from, watched.zones);
    // In a zone that was laid over it, or acquired there by hand, it is not new.
    if (watched.is_known) into &= ~static_cast<unsigned>(laid);
    if (!watched.is_known && watched.track.by_hand) into = 0;
    watched.is_known = true;
    if (into != 0) {
      alerts_.raise(AlertKind::new_target, subject_of(watched),
                    new_text(fmt::format("Target {}", number), from));
    } else if (watched.zones == 0) {
      alerts_.end(AlertKind::new_target, subject_of(watched));
    }
  }
  for (auto& [mmsi, record] : ais_.records()) {
    if (!record.is_listed || record.is_lost) continue;
    unsigned into = entered(record.from_own_ship, record.zones);
    record.is_activated = record.is_activated || into != 0;
    if (record.is_known) into &= ~static_cast<unsigned>(laid);
    record.is_known = true;
    // The one alert of a pair is the tracked target's.
    if (into != 0 && record.target == 0) {
      alerts_.raise(AlertKind::new_target, subject_of(record),
                    new_text(who_is(record), record.from_own_ship));
    } else if (record.zones == 0) {
      alerts_.end(AlertKind::new_target, subject_of(record));
    }
  }
}

// While targets are frozen nothing is known of approaches: alarms stay as they are.
void TargetWatch::Desk::watch_approaches() {
  const ApproachLimits limits = this->limits();
  if (plane_) {
    for (auto& [mmsi, record] : ais_.records()) {
      if (!record.is_listed || record.is_lost) continue;
      record.guard.update(record.approach, limits, now_);
      record.is_activated = record.is_activated || record.guard.is_on();
      if (record.target != 0) continue;
      set_alert(record.guard.is_on(), AlertKind::approach, subject_of(record),
                approach_text(who_is(record), record.approach.value_or(PlottedApproach{})));
    }
  }
  if (frozen_since_) return;
  for (auto& [number, watched] : targets_) {
    watched.approach.reset();
    if (has_motion(watched)) watched.approach = closest_approach(watched.track);
    watched.guard.update(watched.approach, limits, now_);
    const AisRecord* pair = ais_.find(watched.mmsi);
    const bool by_ais = !watched.guard.is_on() && pair != nullptr && pair->guard.is_on();
    const auto& approach = by_ais ? pair->approach : watched.approach;
    watched.is_dangerous = watched.guard.is_on() || by_ais;
    set_alert(
        watched.is_dangerous, AlertKind::approach, subject_of(watched),
        approach_text(fmt::format("Target {}", number), approach.value_or(PlottedApproach{})));
  }
}

void TargetWatch::Desk::watch_capacity(std::uint64_t left_out) {
  const double tracked = static_cast<double>(targets_.size()), most = rules_.capacity();
  if (left_out > left_out_ && tracked >= most) left_one_out_ = now_;
  left_out_ = left_out;
  const bool is_exceeded = tracked >= most && left_one_out_ && now_ - *left_one_out_ <= kLeftOutFor;
  is_near_capacity_ = tracked >= (is_near_capacity_ ? kNotNear : kNear) * most;
  set_alert(is_exceeded, AlertKind::capacity_exceeded, {0, 0, "targets"},
            fmt::format("{} targets are tracked: no more are acquired", targets_.size()));
  set_alert(is_near_capacity_ && !is_exceeded, AlertKind::capacity_near, {0, 0, "targets"},
            fmt::format("{} of {} targets are tracked", targets_.size(), rules_.capacity()));
  set_alert(
      ais_.left_out() > 0, AlertKind::capacity_exceeded, {0, 0, "AIS"},
      fmt::format("More than {} AIS targets: the farthest are left out", AisBook::kMostListed));
}

}  // namespace skerry::server
