#include "server/navigation/told_targets.hpp"

#include <algorithm>
#include <tuple>

#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kCollisionAlarm = 3044;  // IEC 62923-2 table A.1

constexpr double kHysteresis = 1.1;  // of range, of who is told already

std::optional<double> scaled(bool is_there, double value, double scale) {
  return is_there ? std::optional(value * scale) : std::nullopt;
}

ToldTarget::Status status_of(const wire::Target& target, const wire::TargetList& list) {
  switch (target.state()) {
    case wire::TARGET_LOST:
      return ToldTarget::Status::lost;
    case wire::TARGET_ACQUIRING:
      return ToldTarget::Status::acquiring;
    default:
      break;
  }
  if (!target.is_dangerous()) return ToldTarget::Status::tracking;
  const bool acknowledged =
      std::any_of(list.alerts().begin(), list.alerts().end(), [&](const wire::Alert& alert) {
        return alert.number() == kCollisionAlarm && alert.target() == target.number() &&
               alert.state() == wire::ALERT_ACKNOWLEDGED;
      });
  return acknowledged ? ToldTarget::Status::alarm_acknowledged : ToldTarget::Status::alarm;
}

ToldTarget told_of(const wire::Target& target, const wire::TargetList& list) {
  ToldTarget told;
  told.status = status_of(target, list);
  told.place = {target.latitude_deg(), target.longitude_deg()};
  told.range_m = target.range_m();
  told.bearing_deg = target.bearing_deg();
  told.course_deg = scaled(target.has_course_deg(), target.course_deg(), 1.0);
  told.speed_mps = scaled(target.has_speed_kn(), target.speed_kn(), kKnot);
  told.through_water = list.stabilisation() == wire::STABILISATION_WATER;
  told.cpa_m = scaled(target.has_cpa_nm(), target.cpa_nm(), Length::kMetresPerNauticalMile);
  told.tcpa_s = scaled(target.has_tcpa_min(), target.tcpa_min(), 60.0);
  told.name = target.name();
  told.by_hand = target.by_hand();
  told.is_reference = target.is_reference();
  told.is_test = target.is_test();
  return told;
}

}  // namespace

std::vector<ToldTarget> true_targets(const std::vector<Track>& tracks, const wire::OwnShip& ship) {
  std::vector<ToldTarget> targets;
  for (const Track& track : tracks) {
    const Approach approach =
        approach_of(track.place, {track.target.course_over_ground_deg, track.target.speed_mps},
                    {ship.course_over_ground_deg(), ship.speed_over_ground_kn() * kKnot});
    ToldTarget told;
    told.number = track.number;
    told.status = track.lost ? ToldTarget::Status::lost : ToldTarget::Status::tracking;
    told.place = track.target.position;
    told.range_m = track.place.range_m;
    told.bearing_deg = track.place.bearing_deg;
    told.course_deg = track.target.course_over_ground_deg;
    told.speed_mps = track.target.speed_mps;
    told.heading_deg = track.target.heading_deg;
    told.cpa_m = approach.cpa_m;
    told.tcpa_s = approach.tcpa_s;
    told.name = track.target.name;
    targets.push_back(std::move(told));
  }
  return targets;
}

PlottedTargets::Kept* PlottedTargets::kept_of(std::uint32_t plotted) {
  for (auto& [number, kept] : kept_) {
    if (kept.plotted == plotted) return &kept;
  }
  return nullptr;
}

PlottedTargets::Kept* PlottedTargets::give_number(std::uint32_t plotted) {
  unsigned number = plotted >= 1 && plotted <= kMostNumber ? plotted : 1;
  for (unsigned tried = 0; tried < kMostNumber; ++tried, number = number % kMostNumber + 1) {
    if (kept_.contains(number)) continue;
    Kept& kept = kept_[number];
    kept.plotted = plotted;
    return &kept;
  }
  return nullptr;
}

std::vector<ToldTarget> PlottedTargets::update(const wire::TargetList& list, ScenarioTime now) {
  std::vector<const wire::Target*> near;
  for (const wire::Target& target : list.targets()) {
    const bool begins_lost =
        target.state() == wire::TARGET_LOST && kept_of(target.number()) == nullptr;
    const double reach_m = kept_of(target.number()) != nullptr ? kHysteresis * range_m_ : range_m_;
    if (target.range_m() <= reach_m && !begins_lost) near.push_back(&target);
  }
  // Who is told keeps her place against one that is only a little nearer.
  const auto rank = [&](const wire::Target* target) {
    const bool is_kept = kept_of(target->number()) != nullptr;
    return std::tuple(!target->is_dangerous(), target->range_m() / (is_kept ? kHysteresis : 1.0),
                      target->number());
  };
  std::sort(near.begin(), near.end(),
            [&](const wire::Target* a, const wire::Target* b) { return rank(a) < rank(b); });
  // Crowded out is not lost.
  for (std::size_t i = most_; i < near.size(); ++i) {
    std::erase_if(kept_,
                  [&](const auto& kept) { return kept.second.plotted == near[i]->number(); });
  }
  if (near.size() > most_) near.resize(most_);

  for (auto& [number, kept] : kept_) kept.seen = false;
  for (const wire::Target* target : near) {
    Kept* kept = kept_of(target->number());
    if (kept == nullptr) kept = give_number(target->number());
    if (kept == nullptr) continue;
    kept->seen = target->state() != wire::TARGET_LOST;
    kept->told = told_of(*target, list);
    if (kept->seen) kept->lost_at.reset();
  }
  for (auto at = kept_.begin(); at != kept_.end();) {
    Kept& kept = at->second;
    if (!kept.seen && !kept.lost_at) kept.lost_at = now;
    if (kept.lost_at && now - *kept.lost_at >= lost_for_) {
      at = kept_.erase(at);
      continue;
    }
    if (kept.lost_at) kept.told.status = ToldTarget::Status::lost;
    ++at;
  }
  std::vector<ToldTarget> targets;
  for (const auto& [number, kept] : kept_) {
    targets.push_back(kept.told);
    targets.back().number = number;
    if (kept.plotted != number) targets.back().label = std::to_string(kept.plotted);
  }
  return targets;
}

}  // namespace skerry::server
