#include "server/app/options/radar_config.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "server/app/control/control_ranges.hpp"
#include "server/radar/control_values.hpp"
#include "server/world/radar_sets.hpp"

namespace skerry::server {
namespace {

std::string no_control_text(const std::string& name) {
  return fmt::format("there is no control \"{}\"; allowed: {}", name,
                     fmt::join(control_names(), ", "));
}

}  // namespace

RadarConfig radar_config(const scenario::Radar& radar, std::uint32_t index, std::size_t own_ship,
                         std::uint64_t seed) {
  RadarConfig config;
  config.radar = index;
  config.own_ship = own_ship;
  config.name = radar.name();
  config.set = radar_set(radar);
  config.geometry = {radar.spokes(), radar.cells(), radar.bits()};
  config.controls.range_scale = *RangeScale::find(radar.controls().range_nm());
  read_controls(radar.controls(), config.controls);
  read_controls(radar.controls(), config.radar_controls);
  for (const scenario::Obstruction& said : radar.obstructions()) {
    config.obstructions.push_back(
        {said.bearing_deg(), said.width_m(), said.distance_m(), said.reflectivity()});
  }
  for (const scenario::BlankedSector& said : radar.blanked_sectors()) {
    config.radar_controls.blanked.push_back({said.from_deg(), said.to_deg()});
  }
  config.seed = seed;
  return config;
}

void check_locks(const scenario::Scenario& scenario, YamlSource& source) {
  for (int s = 0; s < scenario.own_ships_size(); ++s) {
    for (int r = 0; r < scenario.own_ships(s).radars_size(); ++r) {
      const std::string path = fmt::format("own_ships[{}].radars[{}].locked", s, r);
      if (!source.is_sound(path)) continue;
      const auto& locked = scenario.own_ships(s).radars(r).locked();
      for (int i = 0; i < locked.size(); ++i) {
        if (is_control(locked[i])) continue;
        source.refuse(fmt::format("{}[{}]", path, i), no_control_text(printable(locked[i], 40)));
      }
    }
  }
}

std::vector<std::vector<std::string>> initial_locks(const scenario::Scenario& scenario) {
  std::vector<std::vector<std::string>> locks;
  for (const scenario::OwnShip& ship : scenario.own_ships()) {
    for (const scenario::Radar& radar : ship.radars()) {
      locks.emplace_back(radar.locked().begin(), radar.locked().end());
      for (const std::string& name : radar.locked()) {
        if (is_control(name)) continue;
        throw std::runtime_error(
            fmt::format("{}: locked: {}", radar.name(), no_control_text(name.substr(0, 40))));
      }
    }
  }
  return locks;
}

}  // namespace skerry::server
