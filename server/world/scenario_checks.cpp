#include "server/world/scenario_checks.hpp"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>
#include <array>
#include <map>
#include <string>

#include "protocol/quantity/length.hpp"
#include "server/world/ais_identities.hpp"
#include "server/world/board_registers.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/scenario.hpp"
#include "server/world/target_kinds.hpp"

namespace skerry::server {
namespace {

constexpr Length kShortestLeg = metres(1.0);
// Beyond it two places come near to being antipodes, between which the way is arbitrary.
constexpr Length kLongestLeg = nautical_miles(5000.0);
constexpr Length kShortestCable = metres(1.0);
constexpr Length kLongestCable = metres(20'000.0);

// Names that must differ, and the paths of those who bear them.
using Names = std::map<std::string, std::string>;

class ScenarioChecker {
 public:
  explicit ScenarioChecker(const YamlSource& source) : source_(source) {}

  void check(scenario::Scenario& scenario) const {
    check_count(scenario.own_ships_size(), kMaxOwnShips, "own_ships");
    check_targets(*scenario.mutable_targets());
    check_count(scenario.coast().places_size(), kMaxCoastPlaces, "coast.places");
    check_count(scenario.rain_size(), kMaxRainCells, "rain");
    check_count(scenario.wind_turbines_size(), kMaxWindTurbines, "wind_turbines");
    check_count(scenario.cables_size(), kMaxCables, "cables");
    check_count(scenario.sarts_size(), kMaxSarts, "sarts");
    check_racons(scenario);
    check_cables(scenario);
    Names ships, radars;
    for (int i = 0; i < scenario.own_ships_size(); ++i) {
      const std::string path = fmt::format("own_ships[{}]", i);
      check_unique(scenario.own_ships(i).name(), path, ships);
      check_hull(scenario.own_ships(i), path);
      check_radars(*scenario.mutable_own_ships(i), path, radars);
    }
    check_mmsi(scenario);
    fill_in_mmsi(scenario);
    check_count(static_cast<int>(radars.size()), kMaxRadars, "own_ships", "radars");
    if (radars.empty()) {
      throw source_.error("own_ships", "no own ship has a radar; give one \"radars: [{}]\"");
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
      const std::string radar_path = fmt::format("{}.radars[{}]", path, i);
      check_unique(radar.name(), radar_path, names);
      check_equipment(radar, radar_path);
    }
    for (int i = 0; i < ship.radars_size(); ++i) {
      check_board(ship, i, fmt::format("{}.radars[{}]", path, i));
    }
  }

  void check_board(const scenario::OwnShip& ship, int radar, const std::string& path) const {
    const scenario::Board& board = ship.radars(radar).board();
    if (const auto wrong = complaint_of_board(ship.radars(radar))) {
      throw source_.error(path + "." + wrong->key, wrong->text);
    }
    check_source(ship, board.channel_a(), path + ".board.channel_a");
    check_source(ship, board.channel_b(), path + ".board.channel_b");
  }

  void check_source(const scenario::OwnShip& ship, const scenario::BoardChannel& channel,
                    const std::string& path) const {
    if (!channel.has_source()) return;
    std::string names;
    for (const scenario::Radar& radar : ship.radars()) {
      if (radar.name() == channel.source()) return;
      names += (names.empty() ? "" : ", ") + radar.name();
    }
    throw source_.error(path + ".source",
                        fmt::format("\"{}\" is no radar of {}; allowed: {}",
                                    printable(channel.source()), ship.name(), names));
  }

  void check_equipment(const scenario::Radar& radar, const std::string& path) const {
    if (radar.has_set()) check_set_name(radar.set(), path + ".set");
    check_count(radar.pulses_size(), kMaxPulses, path + ".pulses");
    check_count(radar.obstructions_size(), kMaxObstructions, path + ".obstructions");
    check_count(radar.blanked_sectors_size(), kMaxBlankedSectors, path + ".blanked_sectors");
    if (const auto wrong = complaint_of(radar)) {
      throw source_.error(path + "." + wrong->key, wrong->text);
    }
  }

  void check_set_name(const std::string& name, const std::string& path) const {
    if (!shipped_set(name)) throw source_.error(path, complain_of_name(name));
  }

  void check_targets(google::protobuf::RepeatedPtrField<scenario::Target>& targets) const {
    int ships = 0, emitters = 0, sarts = 0;
    for (int i = 0; i < targets.size(); ++i) {
      scenario::Target& target = targets[i];
      const std::string path = fmt::format("targets[{}]", i);
      check_keys_of_kind(target, path);
      if (target.kind() == scenario::Target::ship) {
        ++ships;
        check_hull(target, path);
      } else {
        fill_in_size(target, source_.has(path + ".height_m"));
      }
      if (target.has_radar()) {
        ++emitters;
        check_set_name(target.radar(), path + ".radar");
      }
      if (target.sart()) ++sarts;
      check_waypoints(target, path);
    }
    check_count(ships, kMaxTargets, "targets", "ships");
    check_count(targets.size() - ships, kMaxSmallTargets, "targets", "entries that are not ships");
    check_count(emitters, kMaxEmitters, "targets", "ships with a radar");
    check_count(sarts, kMaxSarts, "targets", "entries with a SART");
  }

  void refuse_for(const scenario::Target& target, const std::string& path, const char* key,
                  const char* allowed) const {
    if (!source_.has(path + "." + key)) return;
    throw source_.error(path + "." + key, fmt::format("given for kind {}; allowed: {}",
                                                      name_of(target.kind()), allowed));
  }

  void check_keys_of_kind(const scenario::Target& target, const std::string& path) const {
    const bool ship = target.kind() == scenario::Target::ship;
    static constexpr std::array kOfShips = {"length_m", "beam_m", "wake", "cross_section_m2",
                                            "radar"};
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
      throw source_.error(
          path + ".speed_kn",
          fmt::format("{} kn for a reflector; allowed: 0, it stands still", target.speed_kn()));
    }
  }

  void check_mmsi(const scenario::Scenario& scenario) const {
    std::map<std::uint32_t, std::string> paths;
    const auto check = [&](const auto& bearers, const char* list) {
      for (int i = 0; i < bearers.size(); ++i) {
        if (!bearers[i].has_mmsi()) continue;
        const std::string path = fmt::format("{}[{}].mmsi", list, i);
        const auto [other, is_new] = paths.emplace(bearers[i].mmsi(), path);
        if (is_new) continue;
        throw source_.error(path, fmt::format("{} is that of {} too (line {}); numbers must differ",
                                              bearers[i].mmsi(), other->second,
                                              source_.place_of(other->second).line));
      }
    };
    check(scenario.own_ships(), "own_ships");
    check(scenario.targets(), "targets");
    check(scenario.racons(), "racons");
  }

  void check_racons(const scenario::Scenario& scenario) const {
    check_count(scenario.racons_size(), kMaxRacons, "racons");
    for (int i = 0; i < scenario.racons_size(); ++i) {
      const scenario::Racon& racon = scenario.racons(i);
      const std::string path = fmt::format("racons[{}]", i);
      if (racon.code().find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") != std::string::npos) {
        throw source_.error(path + ".code",
                            fmt::format("\"{}\" is no Morse code; allowed: 1 to 4 letters A to Z",
                                        printable(racon.code())));
      }
      if (racon.on_s() > racon.period_s()) {
        const char* const key = source_.has(path + ".on_s") ? ".on_s" : ".period_s";
        throw source_.error(path + key,
                            fmt::format("on for {} s of every {} s; allowed: at most the period",
                                        racon.on_s(), racon.period_s()));
      }
      if (!racon.x_band() && !racon.s_band()) {
        throw source_.error(path + ".s_band",
                            "no band is left; allowed: at least one of x_band "
                            "and s_band true");
      }
    }
  }

  void check_cables(const scenario::Scenario& scenario) const {
    for (int i = 0; i < scenario.cables_size(); ++i) {
      const scenario::OverheadCable& cable = scenario.cables(i);
      double length_m = 0.0;
      GeographicLib::Geodesic::WGS84().Inverse(cable.from().lat(), cable.from().lon(),
                                               cable.to().lat(), cable.to().lon(), length_m);
      if (metres(length_m) >= kShortestCable && metres(length_m) <= kLongestCable) continue;
      throw source_.error(fmt::format("cables[{}].to", i),
                          fmt::format("the cable is {:.0f} m long; allowed: {} to {} m", length_m,
                                      kShortestCable.in_metres(), kLongestCable.in_metres()));
    }
  }

  void check_waypoints(const scenario::Target& target, const std::string& path) const {
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

void check_scenario(const YamlSource& source, scenario::Scenario& scenario) {
  ScenarioChecker(source).check(scenario);
}

}  // namespace skerry::server
