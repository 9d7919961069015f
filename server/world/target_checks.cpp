#include "server/world/target_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "protocol/quantity/length.hpp"
#include "server/config/nearest_key.hpp"
#include "server/world/ais_identities.hpp"
#include "server/world/logged_checks.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/route_checks.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/traffic/class_sizes.hpp"
#include "server/world/traffic/traffic_groups.hpp"
#include "server/world/traffic/traffic_ship.hpp"

namespace skerry::server {
namespace {

constexpr double kRounding = 1.0 + 1e-9;  // of speeds

// Height over the water and cross-section of a target smaller than the radar can resolve.
struct KindSize {
  double height_m;
  double x_band_m2, s_band_m2;
  scenario::Target::Fluctuation fluctuation;
};

// What is meant by a buoy, a reflector or a small craft.  Requires a kind other than `ship`.
// Source: the rows of MSC.192(79) Table 2 and its footnotes on cross-section, the latter as
// reported by others (SOURCES.md "Rules"); MSC.164(78) for the reflector.  Fluctuation is this
// project's choice.
KindSize size_of(scenario::Target::Kind kind) {
  switch (kind) {
    case scenario::Target::reflector_buoy:
      return {3.5, 10.0, 1.0, scenario::Target::rayleigh};
    case scenario::Target::small_craft:
      return {2.0, 2.5, 1.4, scenario::Target::rayleigh};
    case scenario::Target::reflector_craft:
      return {4.0, 7.5, 0.5, scenario::Target::rayleigh};
    case scenario::Target::channel_marker:
      return {1.0, 1.0, 0.1, scenario::Target::rayleigh};
    case scenario::Target::reflector:
      return {4.0, 7.5, 0.5, scenario::Target::steady};
    default:
      return {3.5, 5.0, 0.5, scenario::Target::rayleigh};
  }
}

// Sets what the file has not given of a target other than a ship: `height_given` says whether it
// has the height.
void fill_in_size(scenario::Target& target, bool height_given) {
  const KindSize size = size_of(target.kind());
  if (!height_given) target.set_height_m(size.height_m);
  if (!target.has_x_band_m2()) target.set_x_band_m2(size.x_band_m2);
  if (!target.has_s_band_m2()) target.set_s_band_m2(size.s_band_m2);
  if (!target.has_fluctuation()) target.set_fluctuation(size.fluctuation);
}

// Adds to the source all that is wrong, as ScenarioChecker does.
class TargetChecker {
 public:
  explicit TargetChecker(YamlSource& source) : source_(source) {}

  void check(scenario::Scenario& scenario) const {
    auto& targets = *scenario.mutable_targets();
    int ships = 0, emitters = 0, sarts = 0;
    for (const scenario::Target& target : targets) {
      if (target.kind() == scenario::Target::ship) ++ships;
      if (target.has_radar()) ++emitters;
      if (target.sart()) ++sarts;
    }
    check_count(ships, kMaxTargets, "targets", "ships");
    check_count(targets.size() - ships, kMaxSmallTargets, "targets", "entries that are not ships");
    check_count(emitters, kMaxEmitters, "targets", "ships with a radar");
    check_count(sarts, kMaxSarts, "targets", "entries with a SART");
    const bool groups = check_groups(scenario, ships, kMaxTargets, source_);
    for (int i = 0; i < targets.size(); ++i) {
      scenario::Target& target = targets[i];
      const std::string path = fmt::format("targets[{}]", i);
      if (source_.is_sound(path + ".kind")) {
        check_keys_of_kind(target, path);
        if (target.kind() == scenario::Target::ship) {
          check_class(target, path);
          check_ways(scenario, target, path);
          server::check_hull(target, path, source_);
        } else {
          fill_in_size(target, source_.has(path + ".height_m"));
        }
      }
      if (target.has_radar()) check_set_name(target.radar(), path + ".radar");
      check_waypoints(target, path);
    }
    check_followers(scenario);
    if (groups) expand_groups(scenario);
  }

 private:
  void check_count(int count, int most, const std::string& path,
                   const char* what = "entries") const {
    if (count <= most) return;
    source_.refuse(path, fmt::format("{} {}; allowed: at most {}", count, what, most));
  }

  void check_set_name(const std::string& name, const std::string& path) const {
    if (source_.is_sound(path) && !shipped_set(name)) source_.refuse(path, complain_of_name(name));
  }

  void refuse_for(const scenario::Target& target, const std::string& path, const char* key,
                  const char* allowed) const {
    if (!source_.has(path + "." + key)) return;
    source_.refuse(path + "." + key,
                   fmt::format("given for kind {}; allowed: {}",
                               scenario::Target::Kind_Name(target.kind()), allowed));
  }

  void check_keys_of_kind(const scenario::Target& target, const std::string& path) const {
    const bool ship = target.kind() == scenario::Target::ship;
    static constexpr std::array kOfShips = {"length_m",
                                            "beam_m",
                                            "wake",
                                            "cross_section_m2",
                                            "radar",
                                            "ship_class",
                                            "max_rate_of_turn_deg_min",
                                            "gives_way",
                                            "route_end",
                                            "start_min",
                                            "anchored",
                                            "swing_radius_m",
                                            "follows",
                                            "follow_bearing_deg",
                                            "follow_distance_nm",
                                            "fishes_within_nm",
                                            "along_nm",
                                            "as_logged",
                                            "ais_class"};
    static constexpr std::array kOfOthers = {"x_band_m2", "s_band_m2", "fluctuation"};
    if (ship) {
      for (const char* key : kOfOthers) {
        refuse_for(target, path, key, "for buoys, craft, markers and reflectors");
      }
    } else {
      for (const char* key : kOfShips) refuse_for(target, path, key, "for ships");
    }
    refuse_for(target, path, is_aid(target.kind()) ? "ship_type" : "aid_type",
               is_aid(target.kind()) ? "for ships and craft" : "for buoys and markers");
    if (target.kind() == scenario::Target::reflector && target.speed_kn() > 0.0) {
      source_.refuse(
          path + ".speed_kn",
          fmt::format("{} kn for a reflector; allowed: 0, it stands still", target.speed_kn()));
    }
  }

  void check_waypoints(const scenario::Target& target, const std::string& path) const {
    if (target.waypoints().empty()) return;
    check_count(target.waypoints_size(), kMaxWaypoints, path + ".waypoints");
    if (!target.as_logged() && source_.has(path + ".course_deg") &&
        source_.is_sound(path + ".course_deg")) {
      source_.refuse(path + ".course_deg",
                     fmt::format("{} given besides waypoints, which set the course; allowed: "
                                 "one of the two",
                                 target.course_deg()));
    }
    const wire::Waypoint& first = target.waypoints(0);
    if (source_.is_sound(path + ".speed_kn") && target.speed_kn() <= 0.0 && !first.has_speed_kn() &&
        !first.has_arrive_min()) {
      source_.refuse(path + ".speed_kn", "0 with waypoints; allowed: more than 0 kn");
    }
    std::string from_path = path + ".position";
    GeoPoint from = geo_point(target.position());
    for (int i = 0; i < target.waypoints_size(); ++i) {
      const GeoPoint to = geo_point(target.waypoints(i));
      const std::string to_path = fmt::format("{}.waypoints[{}]", path, i);
      // A log may have a ship twice at one place.
      const bool lies = target.as_logged() && distance_between(from, to).in_metres() < 1.0;
      if (!lies && source_.is_sound(from_path) && source_.is_sound(to_path))
        check_leg(from, to, to_path, source_);
      from = to;
      from_path = to_path;
    }
    if (target.kind() == scenario::Target::ship && !target.as_logged() && source_.is_sound(path)) {
      check_timetable(target, path);
    }
  }

  void check_class(scenario::Target& target, const std::string& path) const {
    if (!target.has_ship_class() || !source_.is_sound(path + ".ship_class")) return;
    const TrafficClass* const found = find_traffic_class(target.ship_class());
    if (found == nullptr) {
      source_.refuse(path + ".ship_class", complaint_of_class(target.ship_class()));
      return;
    }
    const auto has = [&](const char* key) { return source_.has(path + key); };
    take_sizes(*found,
               {has(".length_m"), has(".beam_m"), has(".height_m"), has(".wake"), has(".speed_kn")},
               target);
    if (source_.is_sound(path + ".speed_kn") && target.speed_kn() > found->most_kn) {
      source_.refuse(path + ".speed_kn",
                     fmt::format("{} kn for a {}; allowed: up to {} kn", target.speed_kn(),
                                 found->key, found->most_kn));
    }
  }

  // At anchor, on station, fishing, or on a course or route: one of them.
  void check_ways(const scenario::Scenario& scenario, const scenario::Target& target,
                  const std::string& path) const {
    const auto exclude = [&](const char* what, std::initializer_list<const char*> keys) {
      for (const char* key : keys) {
        if (!source_.has(path + key)) continue;
        source_.refuse(path + key, fmt::format("given besides {}; allowed: one of the two", what));
      }
    };
    if (target.as_logged()) return check_logged(target, path, source_);
    if (target.anchored()) {
      exclude("anchored",
              {".speed_kn", ".waypoints", ".follows", ".fishes_within_nm", ".along_nm"});
    }
    if (target.has_follows()) {
      exclude("follows", {".waypoints", ".course_deg", ".fishes_within_nm", ".along_nm"});
      check_leader(scenario, target, path + ".follows");
    } else {
      for (const char* key : {".follow_bearing_deg", ".follow_distance_nm"}) {
        if (source_.has(path + key)) {
          source_.refuse(path + key, "given without follows; allowed: with it");
        }
      }
    }
    if (target.fishes_within_nm() > 0.0) {
      exclude("fishes_within_nm", {".waypoints", ".along_nm"});
    }
    if (target.waypoints().empty()) {
      for (const char* key : {".route_end", ".along_nm"}) {
        if (source_.has(path + key)) {
          source_.refuse(path + key, "given without waypoints; allowed: with them");
        }
      }
    }
  }

  void check_leader(const scenario::Scenario& scenario, const scenario::Target& target,
                    const std::string& path) const {
    if (!source_.is_sound(path) || leader(scenario, target.follows()) != kNone) return;
    std::vector<std::string> names;
    for (const auto& ship : scenario.own_ships()) names.push_back(ship.name());
    for (const auto& ship : scenario.targets()) {
      if (ship.kind() == scenario::Target::ship && &ship != &target) names.push_back(ship.name());
    }
    const std::string near = nearest_key(target.follows(), names);
    source_.refuse(path,
                   fmt::format("there is no ship \"{}\"{}; allowed: the name of an own ship or "
                               "of a target that is a ship",
                               printable(target.follows()),
                               near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near)));
  }

  static constexpr int kNone = -2, kOwn = -1;
  // The place of a ship in the list of targets.
  static int leader(const scenario::Scenario& scenario, const std::string& name) {
    for (const auto& ship : scenario.own_ships()) {
      if (ship.name() == name) return kOwn;
    }
    for (int i = 0; i < scenario.targets_size(); ++i) {
      const scenario::Target& ship = scenario.targets(i);
      if (ship.kind() == scenario::Target::ship && ship.name() == name) return i;
    }
    return kNone;
  }

  // No ship follows herself, over whomever.
  void check_followers(const scenario::Scenario& scenario) const {
    if (scenario.targets_size() > kMaxTargets + kMaxSmallTargets) return;
    std::vector<int> leaders(static_cast<std::size_t>(scenario.targets_size()), kNone);
    for (int i = 0; i < scenario.targets_size(); ++i) {
      const scenario::Target& ship = scenario.targets(i);
      if (ship.has_follows()) {
        leaders[static_cast<std::size_t>(i)] = leader(scenario, ship.follows());
      }
    }
    for (std::size_t i = 0; i < leaders.size(); ++i) {
      int at = leaders[i];
      std::size_t steps = 0;
      while (at >= 0 && at != static_cast<int>(i) && ++steps <= leaders.size()) {
        at = leaders[static_cast<std::size_t>(at)];
      }
      if (at != static_cast<int>(i)) continue;
      const std::string path = fmt::format("targets[{}].follows", i);
      if (source_.is_sound(path)) {
        source_.refuse(path,
                       "she would follow herself in the end; allowed: no circle of followers");
      }
    }
  }

  void check_timetable(const scenario::Target& target, const std::string& path) const {
    const double most_kn = most_speed_mps(target) / knots_in_mps(1.0);
    double leaves_min = target.start_min(), speed_kn = target.speed_kn();
    GeoPoint from = geo_point(target.position());
    for (int i = 0; i < target.waypoints_size(); ++i) {
      const wire::Waypoint& waypoint = target.waypoints(i);
      const std::string to_path = fmt::format("{}.waypoints[{}]", path, i);
      const double leg_nm = distance_between(from, geo_point(waypoint)).in_nautical_miles();
      from = geo_point(waypoint);
      if (waypoint.has_speed_kn()) {
        speed_kn = waypoint.speed_kn();
        if (speed_kn > most_kn * kRounding) {
          source_.refuse(to_path + ".speed_kn", fmt::format("{} kn; allowed: up to {:.1f} kn, what "
                                                            "she can do",
                                                            speed_kn, most_kn));
        }
      }
      if (!waypoint.has_arrive_min()) {
        leaves_min += 60.0 * leg_nm / std::max(speed_kn, 0.1) + waypoint.stop_min();
        continue;
      }
      const double takes_min = waypoint.arrive_min() - leaves_min;
      if (takes_min <= 0.0) {
        source_.refuse(to_path + ".arrive_min",
                       fmt::format("{} min; allowed: later than {:.1f} min, when she leaves for it",
                                   waypoint.arrive_min(), leaves_min));
        return;
      }
      speed_kn = 60.0 * leg_nm / takes_min;
      if (speed_kn > most_kn * kRounding) {
        source_.refuse(to_path + ".arrive_min",
                       fmt::format("she would need {:.1f} kn to be there at {} min; allowed: up to "
                                   "{:.1f} kn",
                                   speed_kn, waypoint.arrive_min(), most_kn));
      }
      leaves_min = waypoint.arrive_min() + waypoint.stop_min();
    }
  }

  YamlSource& source_;
};

template <typename Ship>
void check_hull_of(const Ship& ship, const std::string& path, YamlSource& source) {
  if (!source.is_sound(path + ".beam_m") || !source.is_sound(path + ".length_m")) return;
  if (ship.beam_m() <= ship.length_m()) return;
  const char* const key = source.has(path + ".beam_m") ? ".beam_m" : ".length_m";
  source.refuse(path + key, fmt::format("beam {} m is more than length {} m; allowed: at most the "
                                        "length",
                                        ship.beam_m(), ship.length_m()));
}

}  // namespace

void check_targets(scenario::Scenario& scenario, YamlSource& source) {
  TargetChecker(source).check(scenario);
}

void check_hull(const scenario::OwnShip& ship, const std::string& path, YamlSource& source) {
  check_hull_of(ship, path, source);
}

void check_hull(const scenario::Target& ship, const std::string& path, YamlSource& source) {
  check_hull_of(ship, path, source);
}

}  // namespace skerry::server
