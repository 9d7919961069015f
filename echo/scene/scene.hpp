// Scene: all that echoes around one own ship, at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "echo/scene/artefacts.hpp"
#include "echo/scene/beacons.hpp"
#include "echo/scene/coast_picture.hpp"
#include "echo/scene/own_rig.hpp"
#include "echo/scene/polar_index.hpp"
#include "echo/scene/structure_index.hpp"
#include "echo/scene/targets.hpp"
#include "echo/scene/weather.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// Immutable once published.  Good for a second or so around `time`: motion is extrapolated, which
// costs speed * turn rate * dt^2 / 2 across (0.02 m at 10 m/s, 6 deg/s, 0.2 s).
struct Scene {
  ScenarioTime time{};
  std::uint64_t seed = 0;
  CoastPicturePtr coast;                    // never null
  std::shared_ptr<const PolarIndex> index;  // of `coast`, serving the own ship's position

  GeoPoint own_ship_geo;
  PlanePoint own_ship;
  PlanePoint own_velocity;   // m/s in the plane
  bool ashore = false;       // the own ship lies on land (coast_crossings.hpp, is_ashore)
  double heading_deg = 0.0;  // true
  double turn_rate_deg_s = 0.0;
  double true_north_deg = 0.0;  // of the plane, at the own ship

  std::vector<Hull> hulls;

  // The index of coast->structures at the own ship's position; null: no structure echoes.
  std::shared_ptr<const StructureIndex> structure_index = nullptr;

  double water_level_m = 0.0;  // over the level of the chart's coastline (high water): -17 to 15
  double wave_height_m = 0.0;  // significant, on the beaches: 0 to 15

  // Each costs nothing while it is empty or calm.
  Atmosphere atmosphere = {};
  SeaSurface sea = {};
  std::vector<RainCell> rain = {};
  std::vector<PointTarget> points = {};
  std::vector<WindTurbine> turbines = {};
  std::vector<OverheadCable> cables = {};
  std::vector<Racon> racons = {};
  std::vector<Sart> sarts = {};
  std::vector<Emitter> emitters = {};  // other radars, never the own one
  std::vector<Obstruction> obstructions = {};
  std::vector<BlankedSector> blanked = {};
  // How far the picture is turned clockwise: spoke 0 then looks so far to port of the bow.
  double bearing_alignment_deg = 0.0;
  AntennaMotion motion = {};
  OwnHull own_hull = {};
  Artefacts artefacts = {};
};
using ScenePtr = std::shared_ptr<const Scene>;

}  // namespace skerry::echo
