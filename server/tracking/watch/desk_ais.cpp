// What AIS tells, and which tracked target each of it is.
#include <fmt/format.h>

#include <algorithm>

#include "server/tracking/watch/association.hpp"
#include "server/tracking/watch/desk.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {

void TargetWatch::Desk::watch_ais(std::span<const AisContact> ais) {
  ais_.take(ais, now_);
  if (!plane_) return;
  ais_.place(*plane_, own_.over_ground_mps, now_);
  tell_lost_ais();
}

// Only those that were activated, and that the radar does not have.
void TargetWatch::Desk::tell_lost_ais() {
  for (auto& [mmsi, record] : ais_.records()) {
    const AlertSubject subject = subject_of(record);
    if (!record.is_listed) {  // too far, or others are nearer: nothing more is told of it
      alerts_.remove(subject);
      record.guard.clear();
      record.is_lost = record.is_activated = false;
      continue;
    }
    if (AisBook::is_fresh(record)) {
      if (record.is_lost) alerts_.end(AlertKind::lost_target, subject);
      record.is_lost = false;
      continue;
    }
    if (!record.is_lost && record.is_activated && record.target == 0 && rules_.lost_warnings()) {
      record.is_lost = true;
      record.guard.clear();
      alerts_.remove(subject);
      alerts_.raise(AlertKind::lost_target, subject,
                    fmt::format("AIS target {} {} is lost", mmsi, record.contact.name));
    }
    if (!record.is_lost || !alerts_.has(AlertKind::lost_target, subject)) {
      record.is_listed = record.is_lost = record.is_activated = false;
      record.guard.clear();
      alerts_.remove(subject);
    }
  }
}

void TargetWatch::Desk::set_partner(Watched& watched, std::uint32_t mmsi) {
  if (watched.mmsi == mmsi) return;
  AisRecord* before = ais_.find(watched.mmsi);
  if (before != nullptr) {
    before->target = 0;
    // Two from now on, and nothing new to be told of.
    alerts_.copy(AlertKind::approach, subject_of(watched), subject_of(*before));
  }
  watched.mmsi = mmsi;
  AisRecord* now = ais_.find(mmsi);
  if (now == nullptr) return;
  now->target = watched.track.number;
  for (const AlertKind kind : {AlertKind::approach, AlertKind::new_target}) {
    alerts_.move(kind, subject_of(*now), subject_of(watched));
  }
}

void TargetWatch::Desk::pair_with_ais() {
  if (frozen_since_ || !plane_) return;
  std::vector<Watched*> tracked;
  std::vector<MovingTarget> ours, theirs;
  std::vector<std::uint32_t> numbers;
  std::map<std::uint32_t, std::size_t> place_of;
  for (auto& [mmsi, record] : ais_.records()) {
    record.target = 0;
    if (!record.is_listed || record.is_lost) continue;
    place_of[mmsi] = numbers.size();
    numbers.push_back(mmsi);
    theirs.push_back({record.from_own_ship, record.motion_mps});
  }
  Partners before;
  for (auto& [number, watched] : targets_) {
    tracked.push_back(&watched);
    ours.push_back({from_own_ship(watched.track), has_motion(watched)
                                                      ? std::optional(watched.track.velocity_mps)
                                                      : std::nullopt});
    const auto at = place_of.find(watched.mmsi);
    before.push_back(at == place_of.end() ? std::nullopt : std::optional(at->second));
  }
  Partners now(tracked.size());
  if (rules_.associate()) {
    now = associate(ours, theirs, before, {}, rules_.association_percent() / 100.0);
  }
  // All splits first: what one leaves, another may take.
  for (std::size_t t = 0; t < tracked.size(); ++t) {
    if (before[t] != now[t] || !now[t]) set_partner(*tracked[t], 0);
  }
  for (std::size_t t = 0; t < tracked.size(); ++t) {
    if (!now[t]) continue;
    set_partner(*tracked[t], numbers[*now[t]]);
    ais_.records().at(numbers[*now[t]]).target = tracked[t]->track.number;
  }
}

}  // namespace skerry::server
