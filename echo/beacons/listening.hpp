// Own radar's part in a sector, for everything that answers or sends.
#pragma once

#include <algorithm>
#include <span>

#include "echo/beacons/one_way.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {

// Powers below this share of the noise are left out: 0.04 dB of a cell of noise.
inline constexpr double kLeastHeard = 0.01;
// Powers are cut to this, far over any receiver's saturation.
inline constexpr double kMostHeard = 1e15;

// For one sector; its references live only while the sector is prepared.
struct Listening {
  const Scene& scene;
  const RadarModel& model;
  const OneWayLink& link;
  const BeamBound& bound;
  const Propagation& propagation;
  const HiddenHeight& hidden;
  Sector sector;
  SectorView main_lobe;  // what the main lobe passes

  PlanePoint own_ship() const { return main_lobe.own_ship(); }
  double dt() const { return main_lobe.dt(); }
  ScenarioTime time() const { return scene.time + seconds_as_duration(dt()); }
  double last_range() const { return model.cell_m * model.geometry.cells; }
  bool behind_land(Polar place, double height_m) const {
    return echo::behind_land(hidden, place, height_m, model.set.antenna_height_m, model.cell_m,
                             last_range());
  }
  // Whether anything of at least `level` (of the axis) reaches that bearing in this sector.
  bool reaches(std::uint32_t bearing_units, double level) const {
    return level <= static_cast<double>(bound.most(sector.off(bearing_units)));
  }
};

// Adds `value` to the cells from `from` to `to` (in cells from the antenna), to those covered in
// part in that proportion.  What is shorter than a cell counts as a cell long, from its beginning,
// as a pulse does (pulse_stretch.hpp).  Anything off the row is left out.
inline void add_span(double from, double to, float value, std::span<float> power) {
  const auto cells = static_cast<double>(power.size());
  to = std::min(std::max(to, from + 1.0), cells);
  from = std::max(from, 0.0);
  if (!(from < to)) return;
  const auto first = static_cast<std::size_t>(from);
  const auto last = static_cast<std::size_t>(to);  // the cell `to` ends in
  if (first == last) {
    power[first] += value * static_cast<float>(to - from);
    return;
  }
  power[first] += value * static_cast<float>(static_cast<double>(first + 1) - from);
  for (std::size_t i = first + 1; i < last; ++i) power[i] += value;
  if (last < power.size())
    power[last] += value * static_cast<float>(to - static_cast<double>(last));
}

}  // namespace skerry::echo
