#include "server/world/scenario.hpp"

#include <fmt/format.h>

#include <map>

#include "server/config/yaml_message.hpp"
#include "server/world/default_scenario_text.hpp"

namespace skerry::server {
namespace {

class ScenarioChecker {
 public:
  explicit ScenarioChecker(const YamlSource& source) : source_(source) {}

  void check(scenario::Scenario& scenario) const {
    check_name(scenario.name(), "name");
    check_count(scenario.own_ships_size(), kMaxOwnShips, "own_ships");
    check_count(scenario.targets_size(), kMaxTargets, "targets");
    std::map<std::string, std::string> names;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      const std::string path = fmt::format("own_ships[{}]", i);
      scenario::OwnShip& ship = *scenario.mutable_own_ships(i);
      check_hull(ship, path);
      check_unique(ship.name(), path + ".name", names);
      check_radars(ship, path);
    }
    for (int i = 0; i < scenario.targets_size(); ++i) {
      const std::string path = fmt::format("targets[{}]", i);
      const scenario::TargetShip& target = scenario.targets(i);
      check_hull(target, path);
      check_count(target.waypoints_size(), kMaxWaypoints, path + ".waypoints");
      if (target.waypoints_size() > 0 && source_.has(path + ".course_deg")) {
        throw source_.error(
            path + ".course_deg",
            fmt::format("{} given besides waypoints, which set the course; allowed: "
                        "one of the two",
                        target.course_deg()));
      }
    }
  }

 private:
  void check_count(int count, int most, const std::string& path) const {
    if (count <= most) return;
    throw source_.error(path, fmt::format("{} entries; allowed: at most {}", count, most));
  }

  void check_name(const std::string& name, const std::string& path) const {
    if (name.size() <= kMaxNameBytes) return;
    throw source_.error(path, fmt::format("\"{}\" has {} bytes; allowed: at most {}",
                                          printable(name), name.size(), kMaxNameBytes));
  }

  void check_unique(const std::string& name, const std::string& path,
                    std::map<std::string, std::string>& names) const {
    const auto [other, first] = names.emplace(name, path);
    if (first) return;
    throw source_.error(
        path, fmt::format("\"{}\" is the name of {} too (line {}); allowed: a name of its own",
                          name, other->second.substr(0, other->second.rfind('.')),
                          source_.place_of(other->second).line));
  }

  template <typename Ship>
  void check_hull(const Ship& ship, const std::string& path) const {
    check_name(ship.name(), path + ".name");
    if (ship.beam_m() <= ship.length_m()) return;
    const std::string key = source_.has(path + ".beam_m") ? ".beam_m" : ".length_m";
    throw source_.error(path + key, fmt::format("beam {} m is more than length {} m; allowed: at "
                                                "most the length",
                                                ship.beam_m(), ship.length_m()));
  }

  void check_radars(scenario::OwnShip& ship, const std::string& ship_path) const {
    check_count(ship.radars_size(), kMaxRadarsPerOwnShip, ship_path + ".radars");
    std::map<std::string, std::string> names;
    for (int i = 0; i < ship.radars_size(); ++i) {
      scenario::Radar& radar = *ship.mutable_radars(i);
      if (radar.name().empty()) radar.set_name(fmt::format("radar {}", i + 1));
      const std::string path = fmt::format("{}.radars[{}].name", ship_path, i);
      check_name(radar.name(), path);
      check_unique(radar.name(), path, names);
    }
  }

  const YamlSource& source_;
};

}  // namespace

scenario::Scenario parse_scenario(const std::string& text, const std::string& name) {
  scenario::Scenario scenario;
  const YamlSource source = load_yaml(text, name, scenario);
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
  return parse_scenario(kDefaultScenarioText, "built-in bergen.yaml");
}

}  // namespace skerry::server
