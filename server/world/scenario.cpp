#include "server/world/scenario.hpp"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>
#include <map>

#include "protocol/quantity/length.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

constexpr Length kShortestLeg = metres(1.0);
// Beyond it two places come near to being antipodes, between which the way is arbitrary.
constexpr Length kLongestLeg = nautical_miles(5000.0);

// Names that must differ, and the paths of those who bear them.
using Names = std::map<std::string, std::string>;

class ScenarioChecker {
 public:
  explicit ScenarioChecker(const YamlSource& source) : source_(source) {}

  void check(scenario::Scenario& scenario) const {
    check_count(scenario.own_ships_size(), kMaxOwnShips, "own_ships");
    check_count(scenario.targets_size(), kMaxTargets, "targets");
    check_count(scenario.coast().places_size(), kMaxCoastPlaces, "coast.places");
    Names ships, radars;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      const std::string path = fmt::format("own_ships[{}]", i);
      check_unique(scenario.own_ships(i).name(), path, ships);
      check_hull(scenario.own_ships(i), path);
      check_radars(*scenario.mutable_own_ships(i), path, radars);
    }
    check_count(static_cast<int>(radars.size()), kMaxRadars, "own_ships", "radars");
    if (radars.empty()) {
      throw source_.error("own_ships", "no own ship has a radar; give one \"radars: [{}]\"");
    }
    for (int i = 0; i < scenario.targets_size(); ++i) {
      const std::string path = fmt::format("targets[{}]", i);
      check_hull(scenario.targets(i), path);
      check_waypoints(scenario.targets(i), path);
    }
  }

 private:
  void check_count(int count, int most, const std::string& path,
                   const char* what = "entries") const {
    if (count <= most) return;
    throw source_.error(path, fmt::format("{} {}; allowed: at most {}", count, what, most));
  }

  // A name that the file does not give stands where its bearer does.
  void check_unique(const std::string& name, const std::string& path, Names& names) const {
    const auto [other, is_new] = names.emplace(name, path);
    if (is_new) return;
    throw source_.error(
        path + ".name",
        fmt::format("\"{}\" is the name of {} too (line {}); names must differ", name,
                    other->second, source_.place_of(other->second + ".name").line));
  }

  template <typename Ship>
  void check_hull(const Ship& ship, const std::string& path) const {
    if (ship.beam_m() <= ship.length_m()) return;
    const char* const key = source_.has(path + ".beam_m") ? ".beam_m" : ".length_m";
    throw source_.error(path + key, fmt::format("beam {} m is more than length {} m; allowed: at "
                                                "most the length",
                                                ship.beam_m(), ship.length_m()));
  }

  void check_radars(scenario::OwnShip& ship, const std::string& path, Names& names) const {
    for (int i = 0; i < ship.radars_size(); ++i) {
      scenario::Radar& radar = *ship.mutable_radars(i);
      if (radar.name().empty()) radar.set_name(fmt::format("{} {}", ship.name(), i + 1));
      check_unique(radar.name(), fmt::format("{}.radars[{}]", path, i), names);
    }
  }

  void check_waypoints(const scenario::TargetShip& target, const std::string& path) const {
    if (target.waypoints().empty()) return;
    check_count(target.waypoints_size(), kMaxWaypoints, path + ".waypoints");
    if (source_.has(path + ".course_deg")) {
      throw source_.error(path + ".course_deg",
                          fmt::format("{} given besides waypoints, which set the course; allowed: "
                                      "one of the two",
                                      target.course_deg()));
    }
    if (target.speed_kn() <= 0.0) {
      throw source_.error(path + ".speed_kn", "0 with waypoints; allowed: more than 0 kn");
    }
    const scenario::Position* from = &target.position();
    for (int i = 0; i < target.waypoints_size(); ++i) {
      const scenario::Position& to = target.waypoints(i);
      check_leg(*from, to, fmt::format("{}.waypoints[{}]", path, i));
      from = &to;
    }
  }

  void check_leg(const scenario::Position& from, const scenario::Position& to,
                 const std::string& path) const {
    double leg_m = 0.0;
    GeographicLib::Geodesic::WGS84().Inverse(from.lat(), from.lon(), to.lat(), to.lon(), leg_m);
    if (metres(leg_m) >= kShortestLeg && metres(leg_m) <= kLongestLeg) return;
    throw source_.error(path,
                        fmt::format("the leg to it is {:.3f} NM long; allowed: {} m to {} NM",
                                    metres(leg_m).in_nautical_miles(), kShortestLeg.in_metres(),
                                    kLongestLeg.in_nautical_miles()));
  }

  const YamlSource& source_;
};

}  // namespace

scenario::Scenario parse_scenario(const std::string& text, const std::string& file_name) {
  scenario::Scenario scenario;
  const YamlSource source = load_yaml(text, file_name, scenario);
  ScenarioChecker(source).check(scenario);
  return scenario;
}

scenario::Scenario load_scenario(const std::string& path) {
  scenario::Scenario scenario;
  const YamlSource source = load_yaml_file(path, scenario);
  ScenarioChecker(source).check(scenario);
  return scenario;
}

scenario::Scenario default_scenario() {
  return parse_scenario(default_scenario_yaml(), "built-in bergen.yaml");
}

}  // namespace skerry::server
