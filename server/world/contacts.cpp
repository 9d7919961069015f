#include "server/world/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "echo/kernel/exact_math.hpp"
#include "server/world/hull_outline.hpp"
#include "server/world/logged_checks.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

// What any ship may do until the next search: targets what a log may have of them, driven ships 100
// m/s; others at most what is ordered, and of a class little more than they make.
constexpr double kMostTarget_mps = knots_in_mps(kMostLoggedSpeed_kn), kMostDriven_mps = 100.0,
                 kMoreWay_mps = 3.0;
constexpr double kSearchSeconds = 5.0, kMargin_m = 30.0;

double half_size_m(const ShipState& ship) { return 0.5 * (ship.length_m + ship.beam_m); }

double most_mps(const ShipState& own) {
  if (own.driven) return kMostDriven_mps;
  return std::max(std::fabs(own.speed_mps), std::fabs(own.ordered_speed_mps)) + kMoreWay_mps;
}

HullOutline outline_of(const ShipState& ship, double larger_m = 0.0) {
  return hull_outline(ship.length_m + larger_m, ship.beam_m + larger_m, ship.heading_deg);
}

PlanePoint plane_velocity(const ShipState& ship) {
  const echo::SinCos course = echo::sin_cos_degrees(ship.course_over_ground_deg);
  return {ship.speed_mps * course.sin, ship.speed_mps * course.cos};
}

bool may_meet(const ShipState& own, const ShipState& other, double reach_m) {
  const double north_deg = other.position.latitude_deg - own.position.latitude_deg;
  if (std::fabs(north_deg) * kLeastDegree_m > reach_m) return false;
  const PlanePoint way = plane_way_between(own.position, other.position);
  return dot(way, way) <= reach_m * reach_m;
}

}  // namespace

void Contacts::search(const std::vector<ShipState>& own_ships,
                      const std::vector<ShipState>& targets) {
  const std::vector<Pair> before = std::move(pairs_);
  pairs_.clear();
  const auto key = [](const Pair& pair) {
    return std::tuple(pair.own, !pair.other_own, pair.other);
  };
  const auto add = [&](std::size_t own, bool other_own, const ShipState& other, double speed_mps) {
    const ShipState& ship = own_ships[own];
    const double reach_m = half_size_m(ship) + half_size_m(other) + kMargin_m +
                           kSearchSeconds * (most_mps(ship) + speed_mps);
    if (!may_meet(ship, other, reach_m)) return;
    Pair pair{.own = own, .other_own = other_own, .other = other.number, .way = {}};
    const auto known =
        std::lower_bound(before.begin(), before.end(), pair,
                         [&](const Pair& a, const Pair& b) { return key(a) < key(b); });
    pairs_.push_back(known != before.end() && key(*known) == key(pair) ? *known : pair);
  };
  for (std::size_t own = 0; own < own_ships.size(); ++own) {
    for (std::size_t other = own + 1; other < own_ships.size(); ++other) {
      ShipState numbered = own_ships[other];
      numbered.number = other;
      add(own, true, numbered, most_mps(numbered));
    }
    for (const ShipState& target : targets) add(own, false, target, kMostTarget_mps);
  }
}

bool Contacts::look(Pair& pair, const ShipState& own, const ShipState& other, double& share) {
  const PlanePoint way = plane_way_between(own.position, other.position);
  PlanePoint from = pair.looked ? pair.way : way;
  const PlanePoint moved = way - from;
  if (dot(moved, moved) > kMostStep_m * kMostStep_m) from = way;
  pair.way = way;
  pair.looked = true;
  const double near_m = half_size_m(own) + half_size_m(other) + kMostStep_m + kClear_m;
  if (dot(way, way) > near_m * near_m) {
    pair.touching = false;
    return false;
  }
  if (pair.touching) {
    pair.touching = outlines_touch(outline_of(own, kClear_m), outline_of(other, kClear_m), way);
    return false;
  }
  const auto touch = first_touch(outline_of(own), outline_of(other), from, way);
  if (!touch) return false;
  share = *touch;
  return pair.touching = true;
}

std::vector<Contact> Contacts::look(Duration now, Duration step,
                                    const std::vector<ShipState>& own_ships,
                                    const Traffic& traffic) {
  if (left_ <= 0) {
    search(own_ships, traffic.states(now));
    left_ = kSearch;
    for (const ShipState& ship : own_ships) {
      if (ship.driven) left_ = kSearch / 5;  // her fixes may put her somewhere
    }
  }
  --left_;
  std::vector<Contact> contacts;
  std::map<std::size_t, std::optional<ShipState>> targets;
  for (Pair& pair : pairs_) {
    const ShipState* other = nullptr;
    if (pair.other_own) {
      other = &own_ships[pair.other];
    } else {
      const auto [found, is_new] = targets.try_emplace(pair.other);
      if (is_new) found->second = traffic.state(pair.other, now);
      if (!found->second) {  // not on the water
        pair.touching = pair.looked = false;
        continue;
      }
      other = &*found->second;
    }
    const ShipState& own = own_ships[pair.own];
    double share = 0.0;
    if (!look(pair, own, *other, share)) continue;
    const PlanePoint closing = plane_velocity(*other) - plane_velocity(own);
    contacts.push_back(
        {.kind = Contact::Kind::collision,
         .when = now - step + Duration(std::llround(share * static_cast<double>(step.count()))),
         .own_ship = pair.own,
         .other_own = pair.other_own,
         .other = pair.other,
         .own_name = own.name,
         .other_name = other->name,
         .position = own.position,
         .relative_mps = length_of(closing),
         .why = {}});
  }
  return contacts;
}

}  // namespace skerry::server
