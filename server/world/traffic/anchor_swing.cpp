#include "server/world/traffic/anchor_swing.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/handling/hull_math.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kSwing_s = 240.0;  // time constant
constexpr double kFastestSwing_deg_s = 0.3;
constexpr double kFresh_mps = 8.0;               // in this wind she sheers at her most
constexpr double kAir = 1.225, kWater = 1025.0;  // kg/m3
constexpr double kFeltPressure = 0.5;  // Pa times the share of her side: less lays her nowhere

}  // namespace

AnchorSwing::AnchorSwing(GeoPoint anchor, double radius_m, double bow_deg, Windage windage,
                         std::uint64_t seed)
    : anchor_(anchor),
      radius_m_(radius_m),
      windage_(windage),
      mean_deg_(wrapped_degrees(bow_deg + 180.0)),
      sheer_deg_(10.0 + 10.0 * echo::as_unit(echo::mixed(seed, 1))),
      period_s_(180.0 + 180.0 * echo::as_unit(echo::mixed(seed, 2))),
      phase_(echo::as_unit(echo::mixed(seed, 3))) {}

std::optional<AnchorSwing::Pull> AnchorSwing::pull_of(const Environment& environment,
                                                      double time_s) const {
  double wind_mps = 0.0;
  if (environment.wind_kn) {
    wind_mps = knots_in_mps(*environment.wind_kn);
  } else if (environment.sea.state > 0.0) {
    wind_mps = 3.16 * echo::exact_exp2(0.8 * echo::exact_log2(environment.sea.state));
  }
  const CurrentHere flow =
      current_at(environment, anchor_,
                 std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time_s)));
  const echo::SinCos wind = echo::sin_cos_degrees(environment.sea.wind_from_deg + 180.0);
  const echo::SinCos current = echo::sin_cos_degrees(flow.set_deg);
  const double air = 0.5 * kAir * windage_.height_m * wind_mps * wind_mps;
  const double water = 0.5 * kWater * windage_.draught_m * flow.mps * flow.mps;
  const double east = air * wind.sin + water * current.sin;
  const double north = air * wind.cos + water * current.cos;
  const double force = std::sqrt(east * east + north * north);
  if (force < kFeltPressure * windage_.height_m) return std::nullopt;
  return Pull{std::min(1.0, wind_mps / kFresh_mps),
              wrapped_degrees(echo::exact_atan2(east, north) * kDegreesPerRadian)};
}

void AnchorSwing::settle(const Environment& environment, double time_s) {
  const auto pull = pull_of(environment, time_s);
  sheer_ = pull ? pull->sheer : 0.0;
  if (pull) mean_deg_ = pull->to_deg;
}

void AnchorSwing::drop_anchor(GeoPoint ship, double bow_deg) {
  const echo::SinCos ahead = echo::sin_cos_degrees(bow_deg);
  anchor_ = advanced(ship, ShortWay{radius_m_ * ahead.cos, radius_m_ * ahead.sin});
  mean_deg_ = wrapped_degrees(bow_deg + 180.0);
  sheer_ = 0.0;
}

void AnchorSwing::step(const Environment& environment, double time_s, double tick_s) {
  const auto pull = pull_of(environment, time_s);
  const double share = 1.0 - exact_exp(-tick_s / kSwing_s);
  sheer_ += share * ((pull ? pull->sheer : 0.0) - sheer_);
  if (!pull) return;
  const double left = std::remainder(pull->to_deg - mean_deg_, 360.0);
  const double most = kFastestSwing_deg_s * tick_s;
  mean_deg_ = wrapped_degrees(mean_deg_ + std::clamp(share * left, -most, most));
}

double AnchorSwing::bearing_deg(double time_s) const {
  const double turns = std::fmod(time_s / period_s_ + phase_, 1.0);
  return wrapped_degrees(mean_deg_ +
                         sheer_ * sheer_deg_ * echo::sin_cos_degrees(360.0 * turns).sin);
}

GeoPoint AnchorSwing::place(double time_s) const {
  const echo::SinCos to = echo::sin_cos_degrees(bearing_deg(time_s));
  return advanced(anchor_, ShortWay{radius_m_ * to.cos, radius_m_ * to.sin});
}

}  // namespace skerry::server
