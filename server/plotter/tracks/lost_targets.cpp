#include "server/plotter/tracks/lost_targets.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace skerry::server {
void LostTargets::keep(const Target& target, std::uint32_t number, bool by_hand) {
  if (length_of(target.state().velocity()) < kLeastSpeed_mps) return;
  if (lost_.size() >= kMost) lost_.erase(lost_.begin());
  lost_.push_back({target.state(), target.time(), target.last_seen(), number, by_hand});
}

std::optional<LostTargets::Lost> LostTargets::take(const Target& target) {
  const ScenarioTime now = target.time();
  std::erase_if(lost_, [&](const Lost& lost) {
    return !(std::fabs(in_seconds(now - lost.seen)) <= kRemembered_s);
  });
  auto best = lost_.end();
  double least = 2.0 * kGate;
  for (auto lost = lost_.begin(); lost != lost_.end(); ++lost) {
    if (target.first_seen() < lost->seen) continue;
    const double t = in_seconds(now - lost->time);
    const double unseen_s = in_seconds(now - lost->seen);
    const PlanePoint off =
        target.state().place() - lost->state.place() - lost->state.velocity() * t;
    if (length_of(off) > kFurthest_m) continue;
    const MotionMatrix& p = lost->state.covariance;
    const MotionMatrix& q = target.state().covariance;
    PlaceMatrix place = p.topLeftCorner<2, 2>() + q.topLeftCorner<2, 2>() +
                        t * t * p.block<2, 2>(2, 2) +
                        t * (p.block<2, 2>(0, 2) + p.block<2, 2>(2, 0));
    place.diagonal().array() += kTurnAhead * unseen_s * unseen_s * unseen_s;
    PlaceMatrix speed = p.block<2, 2>(2, 2) + q.block<2, 2>(2, 2);
    speed.diagonal().array() += kOtherSpeed_mps * kOtherSpeed_mps;
    const PlanePoint faster = target.state().velocity() - lost->state.velocity();
    const PlaceVector x(off.east_m, off.north_m), v(faster.east_m, faster.north_m);
    const double place2 = x.dot(place.inverse() * x), speed2 = v.dot(speed.inverse() * v);
    if (!(place2 <= kGate && speed2 <= kGate && place2 + speed2 < least)) continue;
    least = place2 + speed2;
    best = lost;
  }
  if (best == lost_.end()) return std::nullopt;
  const Lost found = *best;
  lost_.erase(best);
  return found;
}

}  // namespace skerry::server
