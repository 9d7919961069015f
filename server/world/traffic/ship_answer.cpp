#include "server/world/traffic/ship_answer.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr double kAtRest = 0.3;              // of the greatest rate of turn
constexpr double kFullRateFrom = 1.0 / 3.0;  // of the service speed
// Up to this turn she comes out on the next leg; to turn back she goes on to the waypoint first,
// and returns to the line after it.
constexpr double kSteepest_deg = 120.0;
constexpr double kTurned_deg = 0.5;
constexpr int kLongestTurn_s = 1800;

}  // namespace

double ShipAnswer::rate_limit_deg_s(double speed_mps) const {
  const double share = std::fabs(speed_mps) / (kFullRateFrom * service_mps);
  return most_rate_deg_s * std::clamp(share, kAtRest, 1.0);
}

TickMotion tick_motion(const ShipAnswer& answer, WayAndTurn now, const Wanted& wanted,
                       double tick_s) {
  const double limit = wanted.share_of_rate * answer.rate_limit_deg_s(now.speed_mps);
  const double gain = 0.25 / (answer.turn_s + tick_s);
  const double commanded = std::clamp(gain * wanted.left_deg, -limit, limit);
  const double kept = exact_exp(-tick_s / answer.turn_s);
  const double mean_kept = (1.0 - kept) * answer.turn_s / tick_s;
  TickMotion motion;
  motion.end.rate_deg_s = commanded + (now.rate_deg_s - commanded) * kept;
  motion.mean.rate_deg_s = commanded + (now.rate_deg_s - commanded) * mean_kept;
  if (wanted.brake_mps2 > 0.0) {
    motion.end.speed_mps = std::max(0.0, now.speed_mps - wanted.brake_mps2 * tick_s);
    motion.mean.speed_mps = 0.5 * (now.speed_mps + motion.end.speed_mps);
    return motion;
  }
  const double way_kept = exact_exp(-tick_s / answer.speed_s);
  const double mean_way_kept = (1.0 - way_kept) * answer.speed_s / tick_s;
  const double off = now.speed_mps - wanted.speed_mps;
  motion.end.speed_mps = wanted.speed_mps + off * way_kept;
  motion.mean.speed_mps = wanted.speed_mps + off * mean_way_kept;
  return motion;
}

double wheel_over_m(const ShipAnswer& answer, double speed_mps, double turn_deg) {
  const double turn = std::min(std::fabs(turn_deg), kSteepest_deg);
  const double share =
      std::clamp((180.0 - std::fabs(turn_deg)) / (180.0 - kSteepest_deg), 0.0, 1.0);
  if (turn < kTurned_deg || speed_mps <= 0.0) return 0.0;
  double heading = 0.0, ahead_m = 0.0, aside_m = 0.0;
  WayAndTurn motion{speed_mps, 0.0};
  for (int s = 0; s < kLongestTurn_s && turn - heading > kTurned_deg; ++s) {
    const TickMotion tick = tick_motion(answer, motion, {turn - heading, speed_mps}, 1.0);
    const echo::SinCos mean = echo::sin_cos_degrees(heading + 0.5 * tick.mean.rate_deg_s);
    ahead_m += speed_mps * mean.cos;
    aside_m += speed_mps * mean.sin;
    heading += tick.mean.rate_deg_s;
    motion = tick.end;
  }
  // The end of the turn lies on the next leg.
  const echo::SinCos next = echo::sin_cos_degrees(turn);
  return share * std::max(0.0, ahead_m - aside_m * next.cos / next.sin);
}

}  // namespace skerry::server
