#include "server/world/traffic/give_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::server {
namespace {

constexpr double kSight_m = 8.0 * Length::kMetresPerNauticalMile;
constexpr double kMetresPerDegree = 111'200.0;  // of latitude, within 1 %: for who is in sight
constexpr double kAbaftBeam_deg = 112.5;
constexpr double kHeadOn_deg = 8.0;  // either side, of bearing and of aspect
constexpr double kNoWay_mps = 0.3;
constexpr double kSlowest = 0.25;  // share of speed
// She does not come back the moment that she may, nor for a hair's breadth.
constexpr double kMargin = 1.2, kMarginToReturn = 1.1;

struct Manners {
  double clear_m, time_s;
};
Manners manners_of(wire::GiveWay manners) {
  return manners == wire::GIVE_WAY_EARLY
             ? Manners{0.5 * Length::kMetresPerNauticalMile, 12.0 * 60.0}
             : Manners{0.25 * Length::kMetresPerNauticalMile, 3.0 * 60.0};
}

PlanePoint way_on(double course_deg, double speed_mps) {
  const echo::SinCos course = echo::sin_cos_degrees(course_deg);
  return {speed_mps * course.sin, speed_mps * course.cos};
}

double bearing_of(PlanePoint way) {
  return echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian;
}

// Another in sight.
struct InSight {
  const SeenShip* ship;
  PlanePoint to_her;
  double clear_m;  // nearest point wanted
  bool gives_way;  // to her, if need be
};

// What she may alter by, in the order in which she tries it: who has altered to port in fog does
// not change sides.
std::vector<double> alterations(OpenSides open, bool has_unseen,
                                const std::optional<Evasion>& now) {
  std::vector<double> out;
  if (now) out.push_back(0.0);
  // Rule 8(b): by so much that a radar shows it at once.
  const double least = has_unseen ? 30.0 : 15.0;
  const auto add = [&](double side) {
    for (double deg = least; deg <= 90.0; deg += 15.0) out.push_back(side * deg);
  };
  const bool holds_port = now && now->alteration_deg < 0.0;
  const bool may_port = open.port && (has_unseen || holds_port);
  if (may_port && holds_port) add(-1.0);
  if (open.starboard) add(1.0);
  if (may_port && !holds_port) add(-1.0);
  return out;
}

}  // namespace

Passing passing_of(PlanePoint to_other, PlanePoint own_way, PlanePoint other_way) {
  const PlanePoint relative = other_way - own_way;
  const double speed2 = dot(relative, relative);
  if (speed2 < 1e-6) return {length_of(to_other), 0.0};
  const double time_s = -dot(to_other, relative) / speed2;
  return {length_of(to_other + relative * time_s), time_s};
}

Encounter encounter_of(const SeenShip& ship, double course_deg, const SeenShip& other,
                       PlanePoint to_other) {
  if (other.speed_mps < kNoWay_mps) return Encounter::privileged;
  const double bearing = bearing_of(to_other);
  const double relative = std::remainder(bearing - course_deg, 360.0);
  const double aspect = std::remainder(bearing + 180.0 - other.course_deg, 360.0);
  const bool abaft_her = std::fabs(aspect) > kAbaftBeam_deg;
  const bool abaft_me = std::fabs(relative) > kAbaftBeam_deg;
  if (abaft_her && !abaft_me && ship.speed_mps > other.speed_mps) return Encounter::overtaking;
  if (abaft_me) return Encounter::none;
  if (ship.privilege != other.privilege) {
    return ship.privilege < other.privilege ? Encounter::privileged : Encounter::none;
  }
  if (std::fabs(relative) < kHeadOn_deg && std::fabs(aspect) < kHeadOn_deg) {
    return Encounter::head_on;
  }
  return relative > 0.0 ? Encounter::crossing : Encounter::none;
}

std::optional<Evasion> look_round(const SeenShip& ship, double course_deg, double speed_mps,
                                  wire::GiveWay manners, const std::optional<Evasion>& now,
                                  std::span<const SeenShip> others, const Visibility& visibility) {
  const Manners when = manners_of(manners);
  const echo::SinCos latitude = echo::sin_cos_degrees(ship.position.latitude_deg);
  const double most_north_deg = kSight_m / kMetresPerDegree;
  std::vector<InSight> in_sight;
  const PlanePoint alone = way_on(course_deg, speed_mps);
  bool must = false;
  double soonest_s = when.time_s;
  const SeenShip* whom = nullptr;
  std::vector<Unseen> unseen;  // those that she has to act for
  for (const SeenShip& other : others) {
    const double north_deg = other.position.latitude_deg - ship.position.latitude_deg;
    if (std::fabs(north_deg) > most_north_deg) continue;
    if (other.number == ship.number && other.own == ship.own) continue;
    const double east_deg =
        std::remainder(other.position.longitude_deg - ship.position.longitude_deg, 360.0);
    const PlanePoint to_her{kMetresPerDegree * latitude.cos * east_deg,
                            kMetresPerDegree * north_deg};
    if (dot(to_her, to_her) > kSight_m * kSight_m) continue;
    InSight seen{&other, to_her, when.clear_m + ship.length_m + other.length_m, false};
    const bool kept_from = now && now->for_number == other.number && now->for_own == other.own;
    const bool by_radar = !visibility.in_sight(length_of(to_her));
    const Encounter encounter = encounter_of(ship, course_deg, other, to_her);
    seen.gives_way = kept_from || by_radar || encounter != Encounter::none;
    in_sight.push_back(seen);
    if (!seen.gives_way) continue;
    Passing approach = passing_of(to_her, alone, other.way);
    if (kept_from) {
      const Passing then = passing_of(to_her, alone, now->way_then);
      if (then.time_s > 0.0 && then.distance_m < approach.distance_m) approach = then;
    }
    if (approach.time_s < 0.0) continue;
    // Who has altered already does not count the minutes again.
    const double limit_m = now ? kMarginToReturn * seen.clear_m : seen.clear_m;
    const double limit_s = now ? 2.0 * when.time_s : when.time_s;
    if (approach.distance_m >= limit_m || approach.time_s > limit_s) continue;
    must = true;
    if (by_radar) {
      unseen.push_back({std::remainder(bearing_of(to_her) - course_deg, 360.0),
                        encounter == Encounter::overtaking});
    }
    if (whom == nullptr || approach.time_s < soonest_s) {
      soonest_s = approach.time_s;
      whom = &other;
    }
  }
  if (!must) return std::nullopt;

  // How far short of clear a course and speed would leave her, at worst; 0: clear of all.
  const auto shortfall = [&](double course, double speed, double margin) {
    const PlanePoint way = way_on(course, speed);
    double worst = 0.0;
    for (const InSight& seen : in_sight) {
      const Passing approach = passing_of(seen.to_her, way, seen.ship->way);
      if (approach.time_s < 0.0 || approach.time_s > 2.0 * when.time_s) continue;
      double wanted = margin * seen.clear_m;
      if (!seen.gives_way) {
        // Who is to keep clear of her will; she only makes it no worse.
        wanted =
            std::min(0.8 * seen.clear_m, passing_of(seen.to_her, alone, seen.ship->way).distance_m);
      }
      worst = std::max(worst, (wanted - approach.distance_m) / seen.clear_m);
    }
    return worst;
  };

  const bool same = now && now->for_number == whom->number && now->for_own == whom->own;
  Evasion best{0.0, 1.0, whom->number, whom->own, same ? now->way_then : whom->way};
  double best_short = 1e9;
  const double held = now ? now->alteration_deg : 0.0;
  const OpenSides open = open_sides(unseen);
  for (const double alteration : alterations(open, !unseen.empty(), now)) {
    // To come back by a step needs more room than to stay.
    const bool comes_back = held < 0.0 ? alteration > held : alteration < held;
    const double margin = comes_back ? kMargin * kMarginToReturn : kMargin;
    const double is_short = shortfall(course_deg + alteration, speed_mps, margin);
    if (is_short <= 0.0 || is_short < best_short - 0.05) {
      best_short = is_short;
      best.alteration_deg = alteration;
      best.share_of_speed = 1.0;
    }
    if (is_short <= 0.0) return best;
  }
  for (const double share : {0.5, kSlowest}) {
    for (const double alteration : {0.0, open.starboard ? 90.0 : open.port ? -90.0 : 0.0}) {
      const double is_short = shortfall(course_deg + alteration, share * speed_mps, kMargin);
      if (is_short >= best_short - 0.05) continue;
      best_short = is_short;
      best.alteration_deg = alteration;
      best.share_of_speed = share;
    }
    if (best_short <= 0.0) return best;
  }
  return best;
}

}  // namespace skerry::server
