#include "protocol/signalk/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry::signalk {
namespace {

// Radii of curvature of WGS-84 at a latitude, along a meridian and across it, m.
struct Curvature {
  double meridian, across;
};
Curvature curvature_at(double latitude_deg) {
  constexpr double kAxis = 6378137.0, kEccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(latitude_deg * kRadiansPerDegree);
  const double w2 = 1.0 - kEccentricity2 * sine * sine;
  return {kAxis * (1.0 - kEccentricity2) / (w2 * std::sqrt(w2)), kAxis / std::sqrt(w2)};
}

}  // namespace

RangeAndBearing range_and_bearing(GeoPoint from, GeoPoint to) {
  const double a = from.latitude_deg * kRadiansPerDegree, b = to.latitude_deg * kRadiansPerDegree;
  const double east = wrapped_longitude(to.longitude_deg - from.longitude_deg) * kRadiansPerDegree;
  const double half_north = std::sin((b - a) / 2), half_east = std::sin(east / 2);
  const double h = half_north * half_north + std::cos(a) * std::cos(b) * half_east * half_east;
  const double bearing =
      std::atan2(std::sin(east) * std::cos(b),
                 std::cos(a) * std::sin(b) - std::sin(a) * std::cos(b) * std::cos(east));
  // A step of the sphere is longer on the ellipsoid along the curvature it follows.
  const Curvature curve = curvature_at((from.latitude_deg + to.latitude_deg) / 2);
  const double along = curve.meridian * std::cos(bearing), side = curve.across * std::sin(bearing);
  return {2.0 * std::hypot(along, side) * std::asin(std::min(1.0, std::sqrt(h))),
          wrapped_degrees(std::atan2(side, along) / kRadiansPerDegree)};
}

std::optional<ClosestApproach> closest_approach(const Movement& own, const Movement& other) {
  const auto [range, bearing] = range_and_bearing(own.position, other.position);
  const auto east_of = [](double length, double degrees) {
    return length * std::sin(degrees * kRadiansPerDegree);
  };
  const auto north_of = [](double length, double degrees) {
    return length * std::cos(degrees * kRadiansPerDegree);
  };
  const double x = east_of(range, bearing), y = north_of(range, bearing);
  const double u =
      east_of(other.speed_mps, other.course_deg) - east_of(own.speed_mps, own.course_deg);
  const double v =
      north_of(other.speed_mps, other.course_deg) - north_of(own.speed_mps, own.course_deg);
  const double speed2 = u * u + v * v;
  constexpr double kStill = 1e-4;  // m2/s2: 0.01 m/s
  if (speed2 < kStill) return std::nullopt;
  const double seconds = -(x * u + y * v) / speed2;
  if (seconds <= 0.0) return std::nullopt;
  return ClosestApproach{std::hypot(x + u * seconds, y + v * seconds), seconds};
}

Json target_document(const Target& target, const Movement& own) {
  const auto [range, bearing] = range_and_bearing(own.position, target.movement.position);
  Json document{{"id", target.number},
                {"status", "tracking"},
                {"position",
                 {{"bearing", bearing * kRadiansPerDegree},
                  {"distance", range},
                  {"latitude", target.movement.position.latitude_deg},
                  {"longitude", target.movement.position.longitude_deg}}},
                {"motion",
                 {{"course", wrapped_degrees(target.movement.course_deg) * kRadiansPerDegree},
                  {"speed", target.movement.speed_mps}}}};
  if (const auto nearest = closest_approach(own, target.movement)) {
    document["danger"] = {{"cpa", nearest->distance_m}, {"tcpa", nearest->seconds}};
  }
  document["acquisition"] = target.acquired_by_hand ? "manual" : "auto";
  document["firstSeen"] = iso_time(target.first_seen);
  document["lastSeen"] = iso_time(target.last_seen);
  return document;
}

std::string iso_time(UtcTime time) {
  namespace chrono = std::chrono;
  const auto day = chrono::floor<chrono::days>(time);
  const chrono::year_month_day date(day);
  const chrono::hh_mm_ss clock(chrono::floor<chrono::milliseconds>(time - day));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", int{date.year()},
                     unsigned{date.month()}, unsigned{date.day()}, clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

}  // namespace skerry::signalk
