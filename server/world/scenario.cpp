#include "server/world/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "protocol/quantity/length.hpp"
#include "server/config/yaml_include.hpp"
#include "server/config/yaml_message.hpp"
#include "server/world/ais_identities.hpp"
#include "server/world/board_registers.hpp"
#include "server/world/exercise_events.hpp"
#include "server/world/exercise_sheet.hpp"
#include "server/world/logged_checks.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/route_checks.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/target_checks.hpp"
#include "server/world/waters/waters_checks.hpp"

namespace skerry::server {
namespace {

constexpr Length kShortestCable = metres(1.0);
constexpr Length kLongestCable = metres(20'000.0);

// Names that must differ, and the paths of those who bear them.
using Names = std::map<std::string, std::string>;

// Adds to the source all that is wrong.  A check is made where all values that it reads are sound,
// whatever is wrong elsewhere; a list that is too long is not looked into.
class ScenarioChecker {
 public:
  explicit ScenarioChecker(YamlSource& source) : source_(source) {}

  void check(scenario::Scenario& scenario) const {
    check_count(scenario.own_ships_size(), kMaxOwnShips, "own_ships");
    check_targets(scenario, source_);
    check_count(scenario.coast().places_size(), kMaxCoastPlaces, "coast.places");
    check_count(scenario.rain_size(), kMaxRainCells, "rain");
    check_count(scenario.wind_turbines_size(), kMaxWindTurbines, "wind_turbines");
    check_count(scenario.cables_size(), kMaxCables, "cables");
    check_count(scenario.sarts_size(), kMaxSarts, "sarts");
    check_waters(scenario, source_);
    check_racons(scenario);
    check_cables(scenario);
    check_radar_count(scenario);
    Names ships, radars;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      const std::string path = fmt::format("own_ships[{}]", i);
      check_unique(scenario.own_ships(i).name(), path, ships);
      check_ship_class(*scenario.mutable_own_ships(i), path, source_);
      check_count(scenario.own_ships(i).route_size(), kMaxWaypoints, path + ".route");
      check_hull(scenario.own_ships(i), path, source_);
      check_radars(*scenario.mutable_own_ships(i), path, radars);
    }
    if (scenario.include_size() > 0) {
      source_.refuse("include", "this text is no file of a folder; allowed: in a scenario's file");
    }
    name_sarts(scenario);
    check_events(scenario, source_);
    // A section that is left out is filled with defaults; an event shall change what it names.
    for (int i = 0; i < scenario.events_size(); ++i) {
      if (!source_.has(fmt::format("events[{}].weather.artefacts", i)) &&
          scenario.events(i).has_weather()) {
        scenario.mutable_events(i)->mutable_weather()->clear_artefacts();
      }
    }
    check_sheet(scenario, source_);
    check_mmsi(scenario);
    fill_in_mmsi(scenario);
    check_any_radar(scenario);
  }

 private:
  void check_count(int count, int most, const std::string& path,
                   const char* what = "entries") const {
    if (count <= most) return;
    source_.refuse(path, fmt::format("{} {}; allowed: at most {}", count, what, most));
  }

  void check_radar_count(const scenario::Scenario& scenario) const {
    if (scenario.own_ships_size() > kMaxOwnShips) return;
    int radars = 0;
    for (const scenario::OwnShip& ship : scenario.own_ships()) radars += ship.radars_size();
    check_count(radars, kMaxRadars, "own_ships", "radars");
  }

  // Comes last: it refuses all own ships.
  void check_any_radar(const scenario::Scenario& scenario) const {
    if (scenario.own_ships().empty()) return;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      if (scenario.own_ships(i).radars_size() > 0) return;
      if (!source_.is_sound(fmt::format("own_ships[{}].radars", i))) return;
    }
    source_.refuse("own_ships", "no own ship has a radar; give one \"radars: [{}]\"");
  }

  // A name that the file does not give stands where its bearer does.
  void check_unique(const std::string& name, const std::string& path, Names& names) const {
    if (!source_.is_sound(path + ".name")) return;
    const auto [other, is_new] = names.emplace(name, path);
    if (is_new) return;
    source_.refuse(path + ".name",
                   fmt::format("\"{}\" is the name of {} too ({}); names must differ", name,
                               other->second, source_.where(other->second + ".name")));
  }

  void check_radars(scenario::OwnShip& ship, const std::string& path, Names& names) const {
    const bool is_named = source_.is_sound(path + ".name");
    for (int i = 0; i < ship.radars_size(); ++i) {
      scenario::Radar& radar = *ship.mutable_radars(i);
      const std::string radar_path = fmt::format("{}.radars[{}]", path, i);
      const bool has_name = !radar.name().empty();
      if (!has_name) radar.set_name(fmt::format("{} {}", ship.name(), i + 1));
      if (has_name || is_named) check_unique(radar.name(), radar_path, names);
      check_equipment(radar, radar_path);
    }
    for (int i = 0; i < ship.radars_size(); ++i) {
      check_board(ship, i, fmt::format("{}.radars[{}]", path, i));
    }
  }

  void check_board(const scenario::OwnShip& ship, int radar, const std::string& path) const {
    const scenario::Board& board = ship.radars(radar).board();
    if (equipment_is_sound(path) && are_sound(path, {".board", ".range_nm", ".pulse"})) {
      refuse(path, complaints_of_board(ship.radars(radar)));
    }
    check_source(ship, board.channel_a(), path + ".board.channel_a");
    check_source(ship, board.channel_b(), path + ".board.channel_b");
  }

  void check_source(const scenario::OwnShip& ship, const scenario::BoardChannel& channel,
                    const std::string& path) const {
    if (!channel.has_source() || !source_.is_sound(path + ".source")) return;
    std::string names;
    for (const scenario::Radar& radar : ship.radars()) {
      if (radar.name() == channel.source()) return;
      names += (names.empty() ? "" : ", ") + radar.name();
    }
    source_.refuse(path + ".source", fmt::format("\"{}\" is no radar of {}; allowed: {}",
                                                 printable(channel.source()), ship.name(), names));
  }

  void check_equipment(const scenario::Radar& radar, const std::string& path) const {
    if (radar.has_set()) check_set_name(radar.set(), path + ".set");
    check_count(radar.pulses_size(), kMaxPulses, path + ".pulses");
    check_count(radar.obstructions_size(), kMaxObstructions, path + ".obstructions");
    check_count(radar.blanked_sectors_size(), kMaxBlankedSectors, path + ".blanked_sectors");
    if (equipment_is_sound(path)) refuse(path, complaints_of(radar));
  }

  // All that radar_set() reads: the pulses and, of the rest, the keys that may be left out.
  bool equipment_is_sound(const std::string& path) const {
    const google::protobuf::Descriptor& schema = *scenario::Radar::descriptor();
    for (int i = 0; i < schema.field_count(); ++i) {
      const google::protobuf::FieldDescriptor& field = *schema.field(i);
      if (!field.has_optional_keyword() && field.number() != scenario::Radar::kPulsesFieldNumber) {
        continue;
      }
      if (!source_.is_sound(path + "." + field.name())) return false;
    }
    return true;
  }

  void refuse(const std::string& path, const std::vector<SetComplaint>& complaints) const {
    for (const SetComplaint& each : complaints) source_.refuse(path + "." + each.key, each.text);
  }

  bool are_sound(const std::string& path, std::initializer_list<const char*> keys) const {
    return std::all_of(keys.begin(), keys.end(),
                       [&](const char* key) { return source_.is_sound(path + key); });
  }

  void check_set_name(const std::string& name, const std::string& path) const {
    if (source_.is_sound(path) && !shipped_set(name)) source_.refuse(path, complain_of_name(name));
  }

  // The first target that has the number, unless an own ship has it: then -1.
  static int first_with(const scenario::Scenario& scenario, std::uint32_t mmsi) {
    for (const auto& ship : scenario.own_ships()) {
      if (ship.has_mmsi() && ship.mmsi() == mmsi) return -1;
    }
    for (int i = 0; i < scenario.targets_size(); ++i) {
      if (scenario.targets(i).has_mmsi() && scenario.targets(i).mmsi() == mmsi) return i;
    }
    return -1;
  }

  void check_mmsi(const scenario::Scenario& scenario) const {
    std::map<std::uint32_t, std::string> paths;
    const auto check = [&](const auto& bearers, const char* list, const auto& may_share) {
      for (int i = 0; i < bearers.size(); ++i) {
        if (!bearers[i].has_mmsi()) continue;
        const std::string path = fmt::format("{}[{}].mmsi", list, i);
        if (!source_.is_sound(path)) continue;
        const auto [other, is_new] = paths.emplace(bearers[i].mmsi(), path);
        if (is_new || may_share(i)) continue;
        source_.refuse(
            path, fmt::format("{} is that of {} too ({}); numbers must differ", bearers[i].mmsi(),
                              other->second, source_.where(other->second)));
      }
    };
    const auto never = [](int) { return false; };
    check(scenario.own_ships(), "own_ships", never);
    // The parts of a ship's log have her number.
    std::map<std::uint32_t, std::vector<int>> logged;
    check(scenario.targets(), "targets", [&](int number) {
      std::vector<int>& parts = logged[scenario.targets(number).mmsi()];
      if (parts.empty()) parts.push_back(first_with(scenario, scenario.targets(number).mmsi()));
      for (const int part : parts) {
        if (part < 0) return false;
        if (!are_parts_of_a_log(scenario.targets(part), scenario.targets(number))) return false;
      }
      parts.push_back(number);
      return true;
    });
    check(scenario.racons(), "racons", never);
  }

  void check_racons(const scenario::Scenario& scenario) const {
    check_count(scenario.racons_size(), kMaxRacons, "racons");
    for (int i = 0; i < scenario.racons_size(); ++i) {
      const scenario::Racon& racon = scenario.racons(i);
      const std::string path = fmt::format("racons[{}]", i);
      if (source_.is_sound(path + ".code") &&
          racon.code().find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != std::string::npos) {
        source_.refuse(path + ".code",
                       fmt::format("\"{}\" is no Morse code; allowed: 1 to 4 letters A to Z",
                                   printable(racon.code())));
      }
      if (are_sound(path, {".on_s", ".period_s"}) && racon.on_s() > racon.period_s()) {
        const char* const key = source_.has(path + ".on_s") ? ".on_s" : ".period_s";
        source_.refuse(path + key,
                       fmt::format("on for {} s of every {} s; allowed: at most the period",
                                   racon.on_s(), racon.period_s()));
      }
      if (are_sound(path, {".x_band", ".s_band"}) && !racon.x_band() && !racon.s_band()) {
        source_.refuse(path + ".s_band",
                       "no band is left; allowed: at least one of x_band "
                       "and s_band true");
      }
    }
  }

  void check_cables(const scenario::Scenario& scenario) const {
    for (int i = 0; i < scenario.cables_size(); ++i) {
      const scenario::OverheadCable& cable = scenario.cables(i);
      const std::string path = fmt::format("cables[{}]", i);
      if (!are_sound(path, {".from", ".to"})) continue;
      const Length length = distance_between(geo_point(cable.from()), geo_point(cable.to()));
      if (length >= kShortestCable && length <= kLongestCable) continue;
      source_.refuse(path + ".to", fmt::format("the cable is {:.0f} m long; allowed: {} to {} m",
                                               length.in_metres(), kShortestCable.in_metres(),
                                               kLongestCable.in_metres()));
    }
  }

  YamlSource& source_;
};

}  // namespace

scenario::Scenario read_scenario(const std::string& text, YamlSource& source) {
  return read_scenario(parse_yaml(text, source), source);
}

scenario::Scenario read_scenario(const YamlNode& root, YamlSource& source) {
  scenario::Scenario scenario;
  read_yaml(root, source, scenario);
  ScenarioChecker(source).check(scenario);
  return scenario;
}

scenario::Scenario parse_scenario(const std::string& text, const std::string& file_name) {
  YamlSource source(file_name);
  scenario::Scenario scenario = read_scenario(text, source);
  source.require_sound();
  return scenario;
}

scenario::Scenario load_scenario(const std::string& path) {
  YamlSource source(path);
  const YamlNode root = parse_yaml_whole(read_yaml_file(path), source);
  scenario::Scenario scenario = read_scenario(root, source);
  source.require_sound();
  return scenario;
}

scenario::Scenario default_scenario() {
  return parse_scenario(default_scenario_yaml(), "built-in bergen.yaml");
}

}  // namespace skerry::server
