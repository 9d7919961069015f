#include "server/plotter/judge/place_series.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

// Times that are meant to be equal: logs write milliseconds.
constexpr double kSameTime_s = 1e-3;

bool is_sound(double utc_s, GeoPoint place) {
  return std::isfinite(utc_s) && std::fabs(place.latitude_deg) <= 90.0 &&
         std::fabs(place.longitude_deg) <= 360.0;
}

}  // namespace

PlanePoint velocity_of(double course_deg, double speed_kn) {
  const double course = course_deg * kRadiansPerDegree;
  return PlanePoint{std::sin(course), std::cos(course)} * (speed_kn * kKnot);
}

double course_of(PlanePoint velocity_mps) {
  return wrapped_degrees(std::atan2(velocity_mps.east_m, velocity_mps.north_m) * kDegreesPerRadian);
}

double turn_between(double a_deg, double b_deg) {
  return wrapped_degrees(a_deg - b_deg + 180.0) - 180.0;
}

echo::LocalPlane plane_of(const Truth& truth) {
  if (!truth.own_ship.empty()) return echo::LocalPlane(truth.own_ship.front().place);
  for (const TruthTarget& target : truth.targets)
    if (!target.points.empty()) return echo::LocalPlane(target.points.front().place);
  return echo::LocalPlane(GeoPoint{});
}

TruthSeries::TruthSeries(std::span<const TruthPoint> points, const echo::LocalPlane& plane,
                         double beyond_s)
    : beyond_s_(beyond_s) {
  points_.reserve(points.size());
  for (const TruthPoint& point : points) {
    if (!is_sound(point.utc_s, point.place)) continue;
    std::optional<PlanePoint> velocity;
    if (point.course_deg && point.speed_kn)
      velocity = velocity_of(*point.course_deg, *point.speed_kn);
    points_.push_back({point.utc_s, plane.to_plane(point.place), velocity});
  }
  std::stable_sort(points_.begin(), points_.end(),
                   [](const Point& a, const Point& b) { return a.utc_s < b.utc_s; });
  points_.erase(std::unique(points_.begin(), points_.end(),
                            [](const Point& a, const Point& b) { return a.utc_s == b.utc_s; }),
                points_.end());
}

std::size_t TruthSeries::after(double utc_s) const {
  const auto found = std::upper_bound(points_.begin(), points_.end(), utc_s,
                                      [](double t, const Point& p) { return t < p.utc_s; });
  return static_cast<std::size_t>(found - points_.begin());
}

// On the line through points index - 1 and index.
PlanePoint TruthSeries::place_between(std::size_t index, double utc_s) const {
  const Point &a = points_[index - 1], &b = points_[index];
  return a.place + (b.place - a.place) * ((utc_s - a.utc_s) / (b.utc_s - a.utc_s));
}

std::optional<PlaneState> TruthSeries::at(double utc_s) const {
  if (points_.empty() || !(utc_s >= first_s() - beyond_s_) || !(utc_s <= last_s() + beyond_s_))
    return std::nullopt;
  if (points_.size() == 1)
    return PlaneState{points_[0].place, points_[0].velocity_mps.value_or(PlanePoint{})};
  const std::size_t index = std::clamp<std::size_t>(after(utc_s), 1, points_.size() - 1);
  const Point &a = points_[index - 1], &b = points_[index];
  const double gap_s = b.utc_s - a.utc_s;
  if (gap_s > kMostGap_s) {
    // Between two parts of the truth: there is only what is close to one of them.
    const Point& near = utc_s - a.utc_s < b.utc_s - utc_s ? a : b;
    if (std::fabs(utc_s - near.utc_s) > beyond_s_) return std::nullopt;
    const PlanePoint velocity = near.velocity_mps.value_or(PlanePoint{});
    return PlaneState{near.place + velocity * (utc_s - near.utc_s), velocity};
  }
  PlaneState state{place_between(index, utc_s), {}};
  if (a.velocity_mps && b.velocity_mps) {
    const double share = std::clamp((utc_s - a.utc_s) / gap_s, 0.0, 1.0);
    state.velocity_mps = *a.velocity_mps + (*b.velocity_mps - *a.velocity_mps) * share;
    return state;
  }
  double from_s = std::max(first_s(), utc_s - kBase_s / 2.0);
  double until_s = std::min(last_s(), utc_s + kBase_s / 2.0);
  if (until_s - from_s < std::min(kBase_s / 2.0, gap_s)) from_s = a.utc_s, until_s = b.utc_s;
  const auto place = [&](double t) {
    return place_between(std::clamp<std::size_t>(after(t), 1, points_.size() - 1), t);
  };
  state.velocity_mps = (place(until_s) - place(from_s)) * (1.0 / (until_s - from_s));
  return state;
}

bool TruthSeries::is_steady(double utc_s, double window_s) const {
  const auto now = at(utc_s);
  if (!now) return false;
  const double most_mps = std::max(0.3, 0.05 * length_of(now->velocity_mps));
  for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
    const double t = std::clamp(utc_s + share * window_s, first_s(), last_s());
    const auto other = at(t);
    if (!other || length_of(other->velocity_mps - now->velocity_mps) > most_mps) return false;
  }
  return true;
}

ToldSeries::ToldSeries(std::span<const ToldPoint> points, const echo::LocalPlane& plane) {
  for (const ToldPoint& point : points)
    if (is_sound(point.utc_s, point.place)) points_.push_back(point);
  std::stable_sort(points_.begin(), points_.end(),
                   [](const ToldPoint& a, const ToldPoint& b) { return a.utc_s < b.utc_s; });
  std::size_t kept = 0;
  for (const ToldPoint& point : points_) {
    if (kept > 0 && points_[kept - 1].utc_s == point.utc_s) --kept;
    points_[kept++] = point;
  }
  points_.resize(kept);
  places_.reserve(kept);
  for (const ToldPoint& point : points_) places_.push_back(plane.to_plane(point.place));
}

std::optional<ToldSeries::Shown> ToldSeries::at(double utc_s, double hold_s) const {
  const auto found = std::upper_bound(points_.begin(), points_.end(), utc_s + kSameTime_s,
                                      [](double t, const ToldPoint& p) { return t < p.utc_s; });
  if (found == points_.begin()) return std::nullopt;
  const ToldPoint& told = *(found - 1);
  if (told.status != ToldStatus::tracked || utc_s - told.utc_s > hold_s) return std::nullopt;
  Shown shown{{places_[static_cast<std::size_t>(found - 1 - points_.begin())], {}}, false, &told};
  if (told.course_deg && told.speed_kn) {
    shown.has_motion = true;
    shown.state.velocity_mps = velocity_of(*told.course_deg, *told.speed_kn);
    shown.state.place = shown.state.place + shown.state.velocity_mps * (utc_s - told.utc_s);
  }
  return shown;
}

PassingForecast forecast_passing(PlanePoint place, PlanePoint velocity_mps) {
  const double speed_2 = dot(velocity_mps, velocity_mps);
  if (speed_2 < 0.05 * 0.05) return {length_of(place), std::nullopt};
  const double time_s = -dot(place, velocity_mps) / speed_2;
  return {length_of(place + velocity_mps * time_s), time_s};
}

}  // namespace skerry::server
