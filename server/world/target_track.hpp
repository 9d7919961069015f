// TargetTrack: where a target ship is, as an exact function of time.
#pragma once

#include <GeographicLib/GeodesicLine.hpp>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Sails at constant speed, without waypoints along the rhumb line of its course for ever (or to the
// pole, where it stops), with waypoints along the geodesics from its position to each of them in
// turn, to stop at the last with the heading it came with.  It turns at a waypoint in no time.
// Error: a few nanometres (GeographicLib), whatever the time.
// Thread: any; at() costs about 1 us.
class TargetTrack {
 public:
  // Requires what load_scenario() checks.
  explicit TargetTrack(const scenario::TargetShip& target);

  struct Point {
    GeoPoint position;
    double heading_deg = 0.0;  // [0, 360)
  };
  Point at(ScenarioTime t) const;

  // Over the time from t to t + dt: less than the speed where the track ends within.  Requires
  // dt > 0.
  double mean_speed_mps(ScenarioTime t, Duration dt) const;

 private:
  struct Leg {
    GeographicLib::GeodesicLine line;
    double start_m = 0.0;  // along the track
    double end_m = 0.0;
  };
  double run_m(ScenarioTime t) const;  // sailed since the start, the end of the track not minded

  GeoPoint start_;
  double course_deg_ = 0.0;
  double speed_mps_ = 0.0;
  double length_m_ = 0.0;  // of the track; may be infinite
  std::vector<Leg> legs_;
};

}  // namespace skerry::server
