// How far a track is from its target, and whether that is as near as radars must be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {

// For how long one track has been the target's while both ships kept course and speed.
enum class Settled : std::uint8_t { no, one_minute, three_minutes };

// At a step; told less true.
struct TrackError {
  double utc_s = 0.0;
  std::size_t track = 0;  // of ToldScore
  Settled settled = Settled::no;
  double place_m = 0.0;
  // Over ground; courses only where the target makes more than 1 kn.
  std::optional<double> course_deg = {}, speed_kn = {};
  // Relative to own ship, whose own motion is taken as known; courses as above.
  std::optional<double> relative_course_deg = {}, relative_speed_kn = {};
  double true_relative_kn = 0.0;
  std::optional<double> cpa_nm = {}, tcpa_min = {};
};

// Place, course and speed; those relative to own ship if its place is known.
TrackError motion_error(const PlaneState& truth, const ToldSeries::Shown& shown,
                        const std::optional<PlaneState>& own);
// Adds those of CPA and TCPA, against the truth of both going on straight: of what was told, or
// else of what the told motion gives.  None where ships stay as they are to each other, or the true
// TCPA is more than an hour away.
void add_forecast_error(TrackError& error, double utc_s, const PlaneState& truth,
                        const ToldSeries::Shown& shown, const PlaneState& own);

// The value that `percent` of the values do not exceed (nearest rank); nothing of none.
std::optional<double> percentile_of(std::vector<double> values, double percent);
// 95 % of the amounts of one kind of error.
std::optional<double> error_95(std::span<const TrackError> errors,
                               std::optional<double> TrackError::*member);

// What 95 % of the errors must not exceed.  Of a speed the greater of both.
struct AccuracyLimits {
  std::optional<double> relative_course_deg, relative_speed_kn, relative_speed_share;
  std::optional<double> course_deg, speed_kn, cpa_nm, tcpa_min;
};
// After one and after three minutes of steady tracking (MSC.192(79) table 3).
inline constexpr AccuracyLimits kAfterOneMinute = {11.0, 1.5, 0.10, {}, {}, 1.0, {}};
inline constexpr AccuracyLimits kAfterThreeMinutes = {3.0, 0.8, 0.01, 5.0, 0.5, 0.3, 0.5};

struct Accuracy {
  std::size_t steps = 0;  // at which the track was settled so long
  std::optional<double> relative_course_95_deg = {}, relative_speed_95_kn = {};
  std::optional<double> course_95_deg = {}, speed_95_kn = {}, cpa_95_nm = {}, tcpa_95_min = {};
  std::size_t exceeded = 0;  // limits that were not kept; of those for which there are errors
};
Accuracy accuracy_after(std::span<const TrackError> errors, Settled at_least,
                        const AccuracyLimits& limits);

}  // namespace skerry::server
