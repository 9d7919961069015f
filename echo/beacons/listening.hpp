// What the own radar brings to a sector, for all that answers or sends.
#pragma once

#include "echo/beacons/one_way.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {

// Powers below this share of the noise are left out: 0.04 dB of a cell of noise.
inline constexpr double kLeastHeard = 0.01;
// Powers are cut to this, far over any receiver's saturation.
inline constexpr double kMostHeard = 1e15;

// Of one sector; refers to what lives while it is prepared.
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

}  // namespace skerry::echo
