#include "echo/assembly/scene_maker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/returns/coast_crossings.hpp"

namespace skerry::echo {

Length chart_window_for(double range_m) {
  return metres(std::max(1.25 * range_m + CoastPreparer::kMaxAnchorDistance,
                         nautical_miles(12.0).in_metres()));
}

double index_slack_for(double range_m, double speed_mps) {
  return std::max({10.0, range_m / 400.0, 4.0 * std::fabs(speed_mps)});
}

CoastIndex index_of(const CoastPicture& picture, PlanePoint own_ship, double slack_m) {
  CoastIndex index{std::make_shared<const PolarIndex>(picture, own_ship, slack_m), nullptr};
  if (picture.structures) {
    index.structures =
        std::make_shared<const StructureIndex>(picture.structures, own_ship, slack_m);
  }
  return index;
}

PlanePoint velocity_in(const LocalPlane& plane, GeoPoint place, double course_deg,
                       double speed_mps) {
  const SinCos course = sin_cos_degrees(course_deg + plane.true_north_degrees(place));
  return {speed_mps * course.sin, speed_mps * course.cos};
}

void lay_own_ship(const ShipMotion& ship, const LocalPlane& plane, Scene& scene) {
  scene.own_ship_geo = ship.position;
  scene.own_ship = plane.to_plane(ship.position);
  scene.true_north_deg = plane.true_north_degrees(ship.position);
  scene.own_velocity = velocity_in(plane, ship.position, ship.course_deg, ship.speed_mps);
  scene.heading_deg = ship.heading_deg;
  scene.turn_rate_deg_s = ship.turn_rate_deg_s;
}

void lay_coast(CoastPicturePtr picture, const CoastIndex& index, Scene& scene) {
  scene.coast = std::move(picture);
  scene.index = index.polar;
  scene.structure_index = index.structures;
  scene.racons.insert(scene.racons.end(), scene.coast->racons.begin(), scene.coast->racons.end());
  scene.ashore = is_ashore(*scene.coast, *scene.index, scene.own_ship);
}

Hull hull_of(const ShipMotion& ship, const LocalPlane& plane) {
  Hull hull;
  hull.centre = plane.to_plane(ship.position);
  hull.velocity = velocity_in(plane, ship.position, ship.course_deg, ship.speed_mps);
  hull.heading_deg = ship.heading_deg + plane.true_north_degrees(ship.position);
  hull.turn_rate_deg_s = ship.turn_rate_deg_s;
  return hull;
}

std::shared_ptr<Scene> scene_of(CoastPicturePtr picture, const ShipMotion& own_ship,
                                double index_slack_m) {
  auto scene = std::make_shared<Scene>();
  lay_own_ship(own_ship, picture->plane, *scene);
  const CoastIndex index = index_of(*picture, scene->own_ship, index_slack_m);
  lay_coast(std::move(picture), index, *scene);
  return scene;
}

}  // namespace skerry::echo
