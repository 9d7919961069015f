#include "server/tracking/watch/trial_path.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

// One quantity that changes evenly until it is what was ordered.
struct Change {
  double from = 0.0, by = 0.0, rate = 0.0;  // rate a second, positive; 0: at once
  double lasts_s() const {
    return by == 0.0 || rate <= 0.0 ? 0.0 : std::min(std::fabs(by) / rate, TrialPath::kLongest_s);
  }
  double at(double time_s) const {
    const double lasts = lasts_s();
    if (rate <= 0.0) return from + by;
    return from + std::copysign(rate * std::min(time_s, lasts), by);
  }
};

// The shorter turn from the one to the other, in (-180, 180].
double turn_between(double from_deg, double to_deg) {
  const double turn = std::remainder(to_deg - from_deg, 360.0);
  return turn <= -180.0 ? 180.0 : turn;
}

// Closest to the origin while it goes from `place` so for `lasts_s`.
TrialPath::Closest closest_on(PlanePoint place, PlanePoint mps, double lasts_s) {
  const double speed2 = dot(mps, mps);
  const double time = speed2 > 0.0 ? std::clamp(-dot(place, mps) / speed2, 0.0, lasts_s) : 0.0;
  return {length_of(place + mps * time), time};
}

}  // namespace

TrialPath::TrialPath(const wire::TrialOrder& order, double course_deg, double speed_mps,
                     double delay_s) {
  const Change course{course_deg, turn_between(course_deg, order.course_deg()),
                      order.turn_rate_deg_min() / 60.0};
  const double wanted_mps = order.speed_kn() * kKnot;
  const Change speed{speed_mps, wanted_mps - speed_mps, order.acceleration_kn_min() * kKnot / 60.0};
  const auto velocity = [&](double t) { return vector_of(course.at(t), speed.at(t)); };

  corners_.push_back({});
  if (delay_s > 0.0) {
    corners_.push_back({delay_s, vector_of(course_deg, speed_mps) * delay_s});
  }
  const double turning_s = course.lasts_s(), changing_s = speed.lasts_s();
  const double fastest_mps = std::max(speed_mps, wanted_mps);
  double done_s = 0.0;
  // First both change, then the one that takes longer.
  for (const double until_s : {std::min(turning_s, changing_s), std::max(turning_s, changing_s)}) {
    if (until_s <= done_s) continue;
    const double turn_rad_s = turning_s > done_s ? course.rate / kDegreesPerRadian : 0.0;
    const double change_mps2 = changing_s > done_s ? speed.rate : 0.0;
    // A curve is off its chord by an eighth of its acceleration times the square of the time.
    const double acceleration = turn_rad_s * fastest_mps + change_mps2;
    double step_s = acceleration > 0.0 ? std::sqrt(8.0 * kBound_m / acceleration) : until_s;
    if (turn_rad_s > 0.0) step_s = std::min(step_s, 0.5 / turn_rad_s);
    const double lasts_s = until_s - done_s;
    const auto steps = static_cast<std::size_t>(std::ceil(lasts_s / step_s));
    const double h = lasts_s / static_cast<double>(steps);
    for (std::size_t k = 0; k < steps; ++k) {
      // Simpson's rule.
      const double t = done_s + h * static_cast<double>(k);
      const PlanePoint way =
          (velocity(t) + velocity(t + 0.5 * h) * 4.0 + velocity(t + h)) * (h / 6.0);
      const Corner& last = corners_.back();
      corners_.push_back({last.time_s + h, last.place + way});
    }
    done_s = until_s;
  }
  last_mps_ = velocity(done_s);
}

TrialPath::Closest TrialPath::closest_to(PlanePoint place, PlanePoint motion_mps) const {
  Closest closest{length_of(place), 0.0};
  const auto look = [&](const Closest& found, double from_s) {
    if (found.range_m < closest.range_m) closest = {found.range_m, from_s + found.time_s};
  };
  for (std::size_t k = 0; k + 1 < corners_.size(); ++k) {
    const Corner &a = corners_[k], &b = corners_[k + 1];
    const double lasts_s = b.time_s - a.time_s;
    const PlanePoint off = place + motion_mps * a.time_s - a.place;
    const PlanePoint own_mps = (b.place - a.place) * (1.0 / lasts_s);
    look(closest_on(off, motion_mps - own_mps, lasts_s), a.time_s);
  }
  const Corner& last = corners_.back();
  look(closest_on(place + motion_mps * last.time_s - last.place, motion_mps - last_mps_, 1e9),
       last.time_s);
  return closest;
}

}  // namespace skerry::server
