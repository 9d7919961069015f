#include "server/net/signalk/signalk_targets.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

// How far from the place pointed at a target may be: what a finger or a coarse cursor misses by.
constexpr double kReach = 150.0, kReachOfDistance = 0.03;

signalk::Movement movement_of(const TrafficItem& item) {
  return {item.position, item.course_over_ground_deg, item.speed_mps};
}

bool tracks_itself(const TrafficItem& item) {
  return item.kind == TrafficKind::ship || item.kind == TrafficKind::boat;
}

}  // namespace

std::vector<signalk::Target> SignalkTargets::update(std::span<const TrafficItem> traffic,
                                                    const signalk::Movement& own, double range_m,
                                                    UtcTime now) {
  struct Near {
    double range_m;
    const TrafficItem* item;
  };
  std::vector<Near> near;
  std::set<std::uint32_t> in_range;
  for (const TrafficItem& item : traffic) {
    const double range = signalk::range_and_bearing(own.position, item.position).range_m;
    if (range > range_m) continue;
    in_range.insert(item.number);
    const auto known = known_.find(item.number);
    const bool by_hand = known != known_.end() && known->second.by_hand;
    if (by_hand || (tracks_itself(item) && !dropped_.contains(item.number))) {
      near.push_back({range, &item});
    }
  }
  std::erase_if(known_, [&](const auto& each) { return !in_range.contains(each.first); });
  std::erase_if(dropped_, [&](std::uint32_t number) { return !in_range.contains(number); });
  std::sort(near.begin(), near.end(),
            [](const Near& a, const Near& b) { return a.range_m < b.range_m; });
  if (near.size() > kMost) near.resize(kMost);

  std::vector<signalk::Target> targets;
  for (const Near& each : near) {
    const Known& known = known_.try_emplace(each.item->number, Known{now}).first->second;
    targets.push_back({.number = each.item->number,
                       .movement = movement_of(*each.item),
                       .acquired_by_hand = known.by_hand,
                       .first_seen = known.first_seen,
                       .last_seen = now});
  }
  std::sort(targets.begin(), targets.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  return targets;
}

std::optional<std::uint32_t> SignalkTargets::acquire(std::span<const TrafficItem> traffic,
                                                     const signalk::Movement& own,
                                                     double bearing_deg, double distance_m,
                                                     UtcTime now) {
  const auto off_by = [&](const TrafficItem& item) {
    const auto at = signalk::range_and_bearing(own.position, item.position);
    const double angle = (at.bearing_deg - bearing_deg) * kRadiansPerDegree;
    return std::sqrt(std::max(0.0, at.range_m * at.range_m + distance_m * distance_m -
                                       2.0 * at.range_m * distance_m * std::cos(angle)));
  };
  const TrafficItem* nearest = nullptr;
  double best = kReach + kReachOfDistance * distance_m;
  for (const TrafficItem& item : traffic) {
    if (const double off = off_by(item); off <= best) {
      best = off;
      nearest = &item;
    }
  }
  if (nearest == nullptr) return std::nullopt;
  dropped_.erase(nearest->number);
  known_.try_emplace(nearest->number, Known{now}).first->second.by_hand = true;
  return nearest->number;
}

bool SignalkTargets::drop(std::uint32_t number) {
  if (known_.erase(number) == 0) return false;
  dropped_.insert(number);
  return true;
}

}  // namespace skerry::server
