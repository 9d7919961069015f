#include "server/world/traffic/traffic_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"
#include "server/world/traffic/class_sizes.hpp"

namespace skerry::server {
namespace {

using Group = scenario::TrafficGroup;

constexpr std::uint64_t kGroupStream = 0x67726f7570;
constexpr double kNauticalMile = Length::kMetresPerNauticalMile;
constexpr double kApart_m = 0.15 * kNauticalMile;
constexpr int kTries = 12;
constexpr double kLies_min = 5.0;
constexpr double kFerryWidth = 0.2;  // of a lane's: ferries keep to their line

std::vector<std::string_view> usual_classes(Group::Kind kind) {
  switch (kind) {
    case Group::anchorage:
      return {"bulker", "tanker", "product_tanker", "container", "coaster"};
    case Group::fishing:
      return {"fishing"};
    case Group::crossing:
      return {"ferry", "fast_ferry"};
    default:
      return {"container", "bulker", "product_tanker", "coaster", "coaster", "tanker"};
  }
}

// What chance says of one ship.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : seed_(seed) {}
  double unit() { return echo::as_unit(echo::mixed(seed_, ++drawn_)); }
  double between(double from, double to) { return from + (to - from) * unit(); }
  std::size_t one_of(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(unit() * static_cast<double>(count)));
  }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

template <typename Place>
void set_place(GeoPoint at, Place& place) {
  place.set_lat(std::clamp(at.latitude_deg, -90.0, 90.0));
  place.set_lon(at.longitude_deg);
}

GeoPoint aside(GeoPoint from, double course_deg, double to_starboard_m) {
  const echo::SinCos right = echo::sin_cos_degrees(course_deg + 90.0);
  return advanced(from, ShortWay{to_starboard_m * right.cos, to_starboard_m * right.sin});
}

double way_length(GeoPoint from, GeoPoint to) {
  const ShortWay way = short_way_between(from, to);
  return std::sqrt(way.north_m * way.north_m + way.east_m * way.east_m);
}

double way_course(GeoPoint from, GeoPoint to) {
  const ShortWay way = short_way_between(from, to);
  return echo::exact_atan2(way.east_m, way.north_m) * kDegreesPerRadian;
}

GeoPoint within(GeoPoint middle, double radius_m, Chance& chance) {
  const double away_m = radius_m * std::sqrt(chance.unit());
  const echo::SinCos to = echo::sin_cos_degrees(360.0 * chance.unit());
  return advanced(middle, ShortWay{away_m * to.cos, away_m * to.sin});
}

class GroupMaker {
 public:
  GroupMaker(const Group& group, std::uint64_t seed) : group_(group), seed_(seed) {
    for (const std::string& key : group.ship_classes()) classes_.emplace_back(key);
    if (classes_.empty()) classes_ = usual_classes(group.kind());
    way_.push_back(geo_point(group.from()));
    for (const scenario::Position& place : group.via()) way_.push_back(geo_point(place));
    if (group.has_to()) way_.push_back(geo_point(group.to()));
  }

  scenario::Target ship(int number) {
    Chance chance(echo::mixed(seed_, static_cast<std::uint64_t>(number)));
    const TrafficClass& her_class = *find_traffic_class(classes_[chance.one_of(classes_.size())]);
    scenario::Target target;
    target.set_name(fmt::format("{} {}", group_.name(), number + 1));
    target.set_ship_class(std::string(her_class.key));
    target.set_gives_way(group_.has_gives_way() ? group_.gives_way() : scenario::never);
    const double from_kn =
        group_.has_speed_from_kn() ? group_.speed_from_kn() : 0.8 * her_class.service_kn;
    const double to_kn =
        group_.has_speed_to_kn() ? group_.speed_to_kn() : std::max(from_kn, her_class.service_kn);
    target.set_speed_kn(
        std::min(her_class.most_kn, chance.between(std::min(from_kn, to_kn), to_kn)));
    lay_out(number, chance, target);
    take_sizes(her_class, {.speed = true}, target);
    return target;
  }

 private:
  void lay_out(int number, Chance& chance, scenario::Target& target) {
    const double radius_m = group_.radius_nm() * kNauticalMile;
    switch (group_.kind()) {
      case Group::anchorage: {
        target.set_anchored(true);
        target.set_speed_kn(0.0);
        target.set_course_deg(360.0 * chance.unit());
        target.set_swing_radius_m(std::min(120.0, 0.2 * radius_m));
        GeoPoint place{};
        for (int i = 0; i < kTries; ++i) {
          place = within(way_.front(), radius_m, chance);
          if (std::none_of(berths_.begin(), berths_.end(),
                           [&](GeoPoint berth) { return way_length(berth, place) < kApart_m; })) {
            break;
          }
        }
        berths_.push_back(place);
        set_place(place, *target.mutable_position());
        break;
      }
      case Group::fishing:
        target.set_fishes_within_nm(std::min(50.0, group_.radius_nm() / 3.0));
        target.set_course_deg(360.0 * chance.unit());
        set_place(within(way_.front(), radius_m * 2.0 / 3.0, chance), *target.mutable_position());
        break;
      case Group::crossing: {
        const bool back = number % 2 == 1;
        sail(back, kFerryWidth, chance, target);
        target.set_route_end(scenario::back);
        target.mutable_waypoints(target.waypoints_size() - 1)->set_stop_min(kLies_min);
        break;
      }
      default:
        sail(false, 1.0, chance, target);
        target.set_route_end(scenario::again);
        break;
    }
  }

  // Along the way, which runs aside of the group's by as much everywhere.
  void sail(bool back, double share_of_width, Chance& chance, scenario::Target& target) {
    std::vector<GeoPoint> way = way_;
    if (back) std::reverse(way.begin(), way.end());
    const double aside_m =
        share_of_width * group_.width_nm() * kNauticalMile * (chance.unit() - 0.5);
    double length_m = 0.0;
    std::vector<GeoPoint> hers;
    for (std::size_t i = 0; i < way.size(); ++i) {
      const double before = way_course(way[i > 0 ? i - 1 : 0], way[i > 0 ? i : 1]);
      const double after = i + 1 < way.size() ? way_course(way[i], way[i + 1]) : before;
      const double mean = before + 0.5 * std::remainder(after - before, 360.0);
      hers.push_back(aside(way[i], mean, aside_m));
      if (i > 0) length_m += way_length(hers[i - 1], hers[i]);
    }
    set_place(hers.front(), *target.mutable_position());
    for (std::size_t i = 1; i < hers.size(); ++i) set_place(hers[i], *target.add_waypoints());
    target.set_along_nm(length_m * chance.unit() / kNauticalMile);
  }

  const Group& group_;
  std::uint64_t seed_;
  std::vector<std::string_view> classes_;
  std::vector<GeoPoint> way_, berths_;
};

}  // namespace

bool check_groups(const scenario::Scenario& scenario, int ships, int most_ships,
                  YamlSource& source) {
  bool sound = source.is_sound("traffic");
  const auto refuse = [&](const std::string& path, const std::string& text) {
    source.refuse(path, text);
    sound = false;
  };
  for (int i = 0; i < scenario.traffic_size(); ++i) {
    const Group& group = scenario.traffic(i);
    const std::string path = fmt::format("traffic[{}]", i);
    if (!source.is_sound(path)) sound = false;
    ships += static_cast<int>(std::min(group.count(), 1000u));
    const bool sails = group.kind() == Group::lane || group.kind() == Group::crossing;
    if (sails && !group.has_to()) {
      refuse(path, fmt::format("a {} without `to`; expected where it leads",
                               Group::Kind_Name(group.kind())));
    }
    if (!sails && (group.has_to() || group.via_size() > 0)) {
      refuse(path + (group.has_to() ? ".to" : ".via"),
             fmt::format("given for kind {}; allowed: for lanes and crossings",
                         Group::Kind_Name(group.kind())));
    }
    const auto too_far = [&](const scenario::Position& to, const scenario::Position& from) {
      const double length = way_length(geo_point(from), geo_point(to));
      return length < 100.0 || length > 1000.0 * kNauticalMile;
    };
    const scenario::Position* last = &group.from();
    for (int j = 0; j < group.via_size() && sails; ++j) {
      if (too_far(group.via(j), *last)) {
        refuse(fmt::format("{}.via[{}]", path, j), "the leg to it; allowed: 100 m to 1000 NM long");
      }
      last = &group.via(j);
    }
    if (sails && group.has_to() && too_far(group.to(), *last)) {
      refuse(path + ".to", "the leg to it; allowed: 100 m to 1000 NM long");
    }
    if (group.has_speed_from_kn() && group.has_speed_to_kn() &&
        group.speed_from_kn() > group.speed_to_kn()) {
      refuse(path + ".speed_to_kn", fmt::format("{} kn; allowed: at least speed_from_kn, {} kn",
                                                group.speed_to_kn(), group.speed_from_kn()));
    }
    for (int j = 0; j < group.ship_classes_size(); ++j) {
      if (find_traffic_class(group.ship_classes(j)) != nullptr) continue;
      refuse(fmt::format("{}.ship_classes[{}]", path, j),
             complaint_of_class(group.ship_classes(j)));
    }
  }
  if (scenario.traffic_size() > 0 && ships > most_ships) {
    refuse("traffic", fmt::format("{} ships with those among the targets; allowed: at most {}",
                                  ships, most_ships));
  }
  return sound;
}

void expand_groups(scenario::Scenario& scenario) {
  for (int i = 0; i < scenario.traffic_size(); ++i) {
    const Group group = scenario.traffic(i);
    GroupMaker maker(group,
                     echo::mixed(scenario.seed(), kGroupStream, static_cast<std::uint64_t>(i)));
    for (int j = 0; j < static_cast<int>(group.count()); ++j) {
      *scenario.add_targets() = maker.ship(j);
    }
  }
}

}  // namespace skerry::server
