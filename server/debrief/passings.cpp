#include "server/debrief/passings.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kMileInMetres = 1852.0;
constexpr double kMostClosing_mps = 140.0;  // more: one of them was put somewhere
constexpr double kRangeEvery_s = 2.0;

PlanePoint relative_way(const ShipState& from, const ShipState& to) {
  const ShortWay way = short_way_between(from.position, to.position);
  return {way.east_m, way.north_m};
}

PlanePoint way_a_second(const ShipState& ship) {
  const double course = degrees(ship.course_over_ground_deg).in_radians();
  return {ship.speed_mps * std::sin(course), ship.speed_mps * std::cos(course)};
}

double bearing_of(PlanePoint way) {
  return wrapped_degrees(std::atan2(way.east_m, way.north_m) * kDegreesPerRadian);
}

}  // namespace

ForecastCpa forecast_cpa(const ShipState& own, const ShipState& other) {
  const PlanePoint way = relative_way(own, other);
  const PlanePoint change = way_a_second(other) - way_a_second(own);
  const double change2 = dot(change, change);
  if (change2 < 1e-12) return {length_of(way), 0.0};
  const double after_s = -dot(way, change) / change2;
  return {length_of(way + change * after_s), after_s};
}

void Passings::look(const WorldState& state, Moment now) {
  const auto pair = [&](std::size_t own, bool other_own, std::size_t other, const ShipState& a,
                        const ShipState& b) {
    const auto [found, is_new] = watched_.try_emplace({own, other_own, other});
    Watched& watched = found->second;
    if (is_new) {
      watched.passing.own_ship = own;
      watched.passing.other_own = other_own;
      watched.passing.other = other;
      watched.passing.own_name = a.name;
      watched.passing.other_name = b.name;
    }
    look(watched, a, b, now, is_new);
  };
  for (std::size_t own = 0; own < state.own_ships.size(); ++own) {
    for (std::size_t other = own + 1; other < state.own_ships.size(); ++other) {
      pair(own, true, other, state.own_ships[own], state.own_ships[other]);
    }
    for (const ShipState& target : state.targets) {
      pair(own, false, target.number, state.own_ships[own], target);
    }
  }
}

void Passings::look(Watched& watched, const ShipState& own, const ShipState& other, Moment now,
                    bool is_new) {
  ShipPassing& passing = watched.passing;
  const PlanePoint way = relative_way(own, other);
  const double seconds = now.exercise_s - watched.looked.exercise_s;
  // The nearest place of the way since the look before.
  double share = 1.0;
  PlanePoint nearest = way;
  const PlanePoint change = way - watched.way;
  const bool sailed =
      !is_new && seconds > 0.0 && length_of(change) <= kMostClosing_mps * std::max(seconds, 0.1);
  if (sailed && dot(change, change) > 0.0) {
    share = std::clamp(-dot(watched.way, change) / dot(change, change), 0.0, 1.0);
    nearest = watched.way + change * share;
  }
  if (is_new || dot(nearest, nearest) < watched.closest_m2) {
    watched.closest_m2 = dot(nearest, nearest);
    passing.when = now;
    if (sailed) {
      passing.when.at_s -= (1.0 - share) * (now.at_s - watched.looked.at_s);
      passing.when.exercise_s -= (1.0 - share) * seconds;
    }
    passing.closest_m = length_of(nearest);
    passing.bearing_deg = bearing_of(nearest);
    passing.own_side_deg = std::remainder(passing.bearing_deg - own.heading_deg, 360.0);
    passing.other_side_deg = std::remainder(passing.bearing_deg + 180.0 - other.heading_deg, 360.0);
  }
  const ForecastCpa forecast = forecast_cpa(own, other);
  const double limit_m = limits_.cpa_nm * kMileInMetres, range_m = length_of(way);
  const bool under = range_m < limit_m || (forecast.range_m < limit_m && forecast.after_s > 0.0 &&
                                           forecast.after_s <= 60.0 * limits_.tcpa_min);
  if (under) {
    const double least_m = forecast.after_s > 0.0 ? forecast.range_m : range_m;
    if (!passing.first_under) {
      passing.first_under = now;
      passing.least_forecast_m = least_m;
    }
    passing.least_forecast_m = std::min(passing.least_forecast_m, least_m);
    if (watched.was_under && seconds > 0.0) passing.under_limit_s += seconds;
  }
  watched.was_under = under;
  const bool shows = range_m <= 2.0 * limits_.near_nm * kMileInMetres;
  if (shows && (passing.ranges.empty() || now.at_s >= passing.ranges.back().at_s + kRangeEvery_s)) {
    passing.ranges.push_back({now.at_s, range_m / kMileInMetres});
  }
  watched.way = way;
  watched.looked = now;
}

std::vector<ShipPassing> Passings::nearest() const {
  std::vector<ShipPassing> out;
  for (const auto& [key, watched] : watched_) {
    if (watched.passing.closest_m <= limits_.near_nm * kMileInMetres)
      out.push_back(watched.passing);
  }
  std::stable_sort(out.begin(), out.end(), [](const ShipPassing& a, const ShipPassing& b) {
    return a.closest_m < b.closest_m;
  });
  return out;
}

}  // namespace skerry::server
