// AntennaMotionModel: what roll and pitch do to the antenna and its picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// The antenna at the time of one spoke.
struct Motion {
  bool moves = false;      // false: all else is 0, nothing need be done
  double roll_rad = 0.0;   // positive: starboard side down
  double pitch_rad = 0.0;  // positive: bow up
  double tilt_rad = 0.0;   // of the beam's axis at that bearing, positive: up, over the horizon
  double along_m = 0.0;    // how far the antenna has swung toward that bearing
  double across_m = 0.0;   // and to the right of it
  PlanePoint sway;         // the same in the plane
  // True direction of what the spoke sees on the horizon less that which it is shown at, 2^32 = one
  // turn.
  std::int32_t bearing_error_units = 0;
};

// Roll and pitch are sines of the scenario's time; roll is 0 at time 0, pitch has a phase of its
// own from the scene's seed.
//
// Bearing: the beam is a fan whose plane holds the mast.  With the ship rolled by phi and pitched
// by psi what lies on the horizon at bearing beta is seen by the spoke at theta where
//   tan beta = (sin theta cos psi - cos theta sin psi sin phi) / (cos theta cos phi),
// which for roll alone is tan beta = tan theta / cos phi: off by at most phi^2 / 4 radians, 0.44
// deg at 10 deg, on the quarters.  Exact for rigid rotation, for what lies on the horizon.
// Sway: the antenna is antenna_height_m over the axis it turns about, taken in the water line.
// Elevation: one-way Gaussian beam of -3 dB width vertical_beam_deg, at least kElevationFloorDb;
// surface at range R lies at a depression of h / R + R / 2ae.  What a level antenna sees is the
// reference and tilt only takes away: near cells on the up-roll (overshoot), far ones on both; that
// a down-roll would strengthen the nearest cells is left out.  High land is treated as the
// surface it stands on.
// Source: SOURCES.md "Artefacts"; Gaussian beam and floor are assumptions.
// Thread: any.
class AntennaMotionModel {
 public:
  explicit AntennaMotionModel(const RadarModel& model);

  Motion at(const Scene& scene, const SpokeAim& aim) const;

  // The place and direction from which that spoke looks: `aim` swung and turned.  Its relative
  // bearing, by which masts shadow, is the antenna's own and stays.
  static SpokeAim moved(const SpokeAim& aim, const Motion& motion);

  // Multiplies cell i by the two-way gain of its surface's elevation, at most 1.
  void apply(const Motion& motion, std::span<float> power) const;

  // The factor at one cell, in double: the reference for apply().
  double gain(const Motion& motion, std::uint32_t cell) const;

 private:
  double height_m_;
  double fall_;                    // octaves per square radian, two-way
  std::vector<float> depression_;  // per cell
};

// The beam's elevation pattern never falls below this, one way.
inline constexpr double kElevationFloorDb = -20.0;

}  // namespace skerry::echo
