#include "server/plotter/judge/track_error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/length.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr double kSlow_kn = 1.0;  // whose course says little
constexpr double kMostTcpa_min = 60.0;
constexpr double kMile_m = Length::kMetresPerNauticalMile;
constexpr double kPercent = 95.0;

double knots_of(PlanePoint velocity_mps) { return length_of(velocity_mps) / kKnot; }

struct MotionError {
  std::optional<double> course_deg;
  double speed_kn = 0.0;
};
MotionError between(PlanePoint told_mps, PlanePoint true_mps) {
  MotionError error{{}, knots_of(told_mps) - knots_of(true_mps)};
  if (knots_of(true_mps) > kSlow_kn)
    error.course_deg = turn_between(course_of(told_mps), course_of(true_mps));
  return error;
}

// Is the limit broken by more than 5 % of the errors that there are?
bool is_exceeded(const std::optional<double>& error_95, const std::optional<double>& limit) {
  return error_95 && limit && *error_95 > *limit;
}

}  // namespace

TrackError motion_error(const PlaneState& truth, const ToldSeries::Shown& shown,
                        const std::optional<PlaneState>& own) {
  TrackError error;
  error.place_m = length_of(shown.state.place - truth.place);
  if (!shown.has_motion) return error;
  const MotionError ground = between(shown.state.velocity_mps, truth.velocity_mps);
  error.course_deg = ground.course_deg;
  error.speed_kn = ground.speed_kn;
  if (!own) return error;
  const PlanePoint real = truth.velocity_mps - own->velocity_mps;
  const MotionError relative = between(shown.state.velocity_mps - own->velocity_mps, real);
  error.relative_course_deg = relative.course_deg;
  error.relative_speed_kn = relative.speed_kn;
  error.true_relative_kn = knots_of(real);
  return error;
}

void add_forecast_error(TrackError& error, double utc_s, const PlaneState& truth,
                        const ToldSeries::Shown& shown, const PlaneState& own) {
  const PassingForecast real =
      forecast_passing(truth.place - own.place, truth.velocity_mps - own.velocity_mps);
  if (!real.time_s || std::fabs(*real.time_s) > kMostTcpa_min * 60.0) return;
  const PassingForecast made =
      forecast_passing(shown.state.place - own.place, shown.state.velocity_mps - own.velocity_mps);
  if (shown.told->cpa_nm) {
    error.cpa_nm = *shown.told->cpa_nm - real.range_m / kMile_m;
  } else if (shown.has_motion) {
    error.cpa_nm = (made.range_m - real.range_m) / kMile_m;
  }
  if (shown.told->tcpa_min) {
    // What was told is of then, and runs on.
    const double since_min = (utc_s - shown.told->utc_s) / 60.0;
    error.tcpa_min = *shown.told->tcpa_min - since_min - *real.time_s / 60.0;
  } else if (shown.has_motion && made.time_s) {
    error.tcpa_min = (*made.time_s - *real.time_s) / 60.0;
  }
}

std::optional<double> percentile_of(std::vector<double> values, double percent) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()) - 1e-9);
  const auto index = static_cast<std::size_t>(std::max(1.0, rank)) - 1;
  return values[std::min(index, values.size() - 1)];
}

std::optional<double> error_95(std::span<const TrackError> errors,
                               std::optional<double> TrackError::*member) {
  std::vector<double> values;
  for (const TrackError& error : errors)
    if (error.*member) values.push_back(std::fabs(*(error.*member)));
  return percentile_of(std::move(values), kPercent);
}

Accuracy accuracy_after(std::span<const TrackError> errors, Settled at_least,
                        const AccuracyLimits& limits) {
  std::vector<TrackError> settled;
  for (const TrackError& error : errors)
    if (error.settled >= at_least) settled.push_back(error);
  Accuracy out;
  out.steps = settled.size();
  out.relative_course_95_deg = error_95(settled, &TrackError::relative_course_deg);
  out.relative_speed_95_kn = error_95(settled, &TrackError::relative_speed_kn);
  out.course_95_deg = error_95(settled, &TrackError::course_deg);
  out.speed_95_kn = error_95(settled, &TrackError::speed_kn);
  out.cpa_95_nm = error_95(settled, &TrackError::cpa_nm);
  out.tcpa_95_min = error_95(settled, &TrackError::tcpa_min);
  // Each speed has a limit of its own: its error as a share of that.
  std::vector<double> shares;
  for (const TrackError& error : settled) {
    if (!error.relative_speed_kn || !limits.relative_speed_kn) continue;
    const double limit_kn =
        std::max(*limits.relative_speed_kn,
                 limits.relative_speed_share.value_or(0.0) * error.true_relative_kn);
    shares.push_back(std::fabs(*error.relative_speed_kn) / limit_kn);
  }
  for (const bool exceeded :
       {is_exceeded(out.relative_course_95_deg, limits.relative_course_deg),
        is_exceeded(percentile_of(std::move(shares), kPercent), 1.0),
        is_exceeded(out.course_95_deg, limits.course_deg),
        is_exceeded(out.speed_95_kn, limits.speed_kn), is_exceeded(out.cpa_95_nm, limits.cpa_nm),
        is_exceeded(out.tcpa_95_min, limits.tcpa_min)})
    out.exceeded += exceeded ? 1 : 0;
  return out;
}

}  // namespace skerry::server
