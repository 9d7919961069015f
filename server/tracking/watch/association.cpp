#include "server/tracking/watch/association.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {

bool is_same_target(const MovingTarget& tracked, const MovingTarget& ais,
                    const AssociationGates& gates, double factor) {
  const PlanePoint off = tracked.place - ais.place;
  const double place_m = gates.place_m * factor;
  if (!(dot(off, off) <= place_m * place_m)) return false;
  if (!tracked.motion_mps) return true;
  if (!ais.motion_mps) return false;
  const double ours = length_of(*tracked.motion_mps), theirs = length_of(*ais.motion_mps);
  if (!(std::fabs(ours - theirs) <= gates.speed_mps * factor)) return false;
  return std::min(ours, theirs) < gates.speed_mps ||
         degrees_apart(direction_of(*tracked.motion_mps), direction_of(*ais.motion_mps)) <=
             gates.course_deg * factor;
}

Partners associate(std::span<const MovingTarget> tracked, std::span<const MovingTarget> ais,
                   const Partners& before, const AssociationGates& gates, double widened) {
  Partners partners(tracked.size());
  std::vector<bool> taken(ais.size(), false);
  for (std::size_t t = 0; t < std::min(tracked.size(), before.size()); ++t) {
    const auto a = before[t];
    if (!a || *a >= ais.size() || taken[*a]) continue;
    if (!is_same_target(tracked[t], ais[*a], gates, widened * kDissolvesAt)) continue;
    partners[t] = a;
    taken[*a] = true;
  }
  std::vector<std::tuple<double, std::size_t, std::size_t>> near;  // by distance, squared
  for (std::size_t t = 0; t < tracked.size(); ++t) {
    for (std::size_t a = 0; a < ais.size() && !partners[t]; ++a) {
      if (taken[a] || !is_same_target(tracked[t], ais[a], gates, widened)) continue;
      const PlanePoint off = tracked[t].place - ais[a].place;
      near.emplace_back(dot(off, off), t, a);
    }
  }
  std::sort(near.begin(), near.end());
  for (const auto& [distance, t, a] : near) {
    if (partners[t] || taken[a]) continue;
    partners[t] = a;
    taken[a] = true;
  }
  return partners;
}

}  // namespace skerry::server
