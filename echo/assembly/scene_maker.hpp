// The parts of every Scene: own ship, coast and hulls, out of plain values.  Server, C library,
// figures and tests make their scenes with these.
#pragma once

#include <memory>

#include "echo/scene/scene.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

// A ship on the globe.  She moves straight on and turns about her middle.
struct ShipMotion {
  GeoPoint position;
  double course_deg = 0.0;  // over ground, true
  double speed_mps = 0.0;
  double heading_deg = 0.0;  // true
  double turn_rate_deg_s = 0.0;
};

// Radius of the chart window to read for pictures of `range_m`: a quarter more and at least 12 NM,
// so that the own ship sails for a while before the chart is read again.
Length chart_window_for(double range_m);

// How far an own ship may sail before the index is made anew, metres.  More costs each look-up
// more; less than the way of a few seconds makes indices too often.
double index_slack_for(double range_m, double speed_mps);

// The indexes by which a place on a picture is looked up.  Both serve the same positions.
struct CoastIndex {
  std::shared_ptr<const PolarIndex> polar;
  std::shared_ptr<const StructureIndex> structures;  // null: nothing is built there
};
CoastIndex index_of(const CoastPicture& picture, PlanePoint own_ship, double slack_m);

// m/s in the plane, of a true course at that place.
PlanePoint velocity_in(const LocalPlane& plane, GeoPoint place, double course_deg,
                       double speed_mps);

// Adds the own ship's place and motion.
void lay_own_ship(const ShipMotion& ship, const LocalPlane& plane, Scene& scene);
// The coast around her, its charted racons and whether she lies on it.  Requires her laid, and an
// index that serves her.
void lay_coast(CoastPicturePtr picture, const CoastIndex& index, Scene& scene);
// Place and motion of a ship's hull; size and identity are the caller's.
Hull hull_of(const ShipMotion& ship, const LocalPlane& plane);

// A scene of that coast and ship alone, for the caller to fill.
std::shared_ptr<Scene> scene_of(CoastPicturePtr picture, const ShipMotion& own_ship,
                                double index_slack_m);

}  // namespace skerry::echo
