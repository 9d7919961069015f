#include "tests/validation/table2_targets.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "echo/kernel/hash.hpp"
#include "echo/scene/coast_rules.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/validation/target_trial.hpp"

namespace skerry::validation {
namespace {

// A rocky island 4 km across whose bank, `height_m` high, faces the own ship.
void put_shore(echo::Scene& scene, double range_m, double bearing_deg, float height_m) {
  const echo::LocalPlane& plane = scene.coast->plane;
  const PlanePoint middle = off(scene.own_ship, range_m, bearing_deg);
  const PlanePoint left = off(middle, 2000.0, bearing_deg - 90.0);
  const PlanePoint right = off(middle, 2000.0, bearing_deg + 90.0);
  echo::CoastChart chart;
  chart.centre = scene.own_ship_geo;
  chart.radius_m = 1.3 * range_m + 5000.0;
  chart.source = "made up";
  chart.shores = {{echo::CoastType::rocky, height_m}};
  echo::CoastRing ring;
  // Land on the left.
  for (const PlanePoint p :
       {right, left, off(left, 2000.0, bearing_deg), off(right, 2000.0, bearing_deg)}) {
    ring.vertices.push_back(plane.to_geo(p));
  }
  std::reverse(ring.vertices.begin(), ring.vertices.end());
  ring.edges.assign(4, echo::EdgeKind::shoreline);
  for (std::uint64_t i = 0; i < 4; ++i) ring.vertex_ids.push_back(echo::mixed(0x5402E, i));
  ring.shores.assign(4, 0);
  chart.rings.push_back(std::move(ring));
  echo::CoastRules rules{.seed = 1};
  rules.styles.fill({.method = echo::CoastMethod::straight, .dimension = 1.0});
  const RangeScale scale = scale_for(range_m);
  const GeoPoint at = scene.own_ship_geo;
  const echo::ScenePtr made =
      scenes::scene_at(std::move(chart), at, scale, ScanGeometry{}, {}, 0.0, rules);
  const std::uint64_t seed = scene.seed;
  scene.coast = made->coast;
  scene.index = made->index;
  scene.own_ship = made->own_ship;
  scene.ashore = made->ashore;
  scene.seed = seed;
}

void put_ship(echo::Scene& scene, double range_m, double bearing_deg, double length_m,
              double beam_m, double height_m) {
  echo::Hull hull;
  hull.centre = off(scene.own_ship, range_m, bearing_deg);
  hull.heading_deg = bearing_deg + 30.0;  // neither broadside nor end on
  hull.length_m = length_m;
  hull.beam_m = beam_m;
  hull.height_m = height_m;
  hull.identity = 7;
  scene.hulls.push_back(hull);
}

void put_point(echo::Scene& scene, double range_m, double bearing_deg, double height_m, double x_m2,
               double s_m2) {
  echo::PointTarget point;
  point.place = off(scene.own_ship, range_m, bearing_deg);
  point.height_m = height_m;
  point.x_band_m2 = x_m2;
  point.s_band_m2 = s_m2;
  point.identity = 11;
  scene.points.push_back(point);
}

std::vector<Table2Target> all() {
  const auto shore = [](float height) {
    return [height](echo::Scene& s, double r, double b) { put_shore(s, r, b, height); };
  };
  const auto ship = [](double length, double beam, double height) {
    return [=](echo::Scene& s, double r, double b) { put_ship(s, r, b, length, beam, height); };
  };
  const auto point = [](double height, double x, double s_band) {
    return [=](echo::Scene& s, double r, double b) { put_point(s, r, b, height, x, s_band); };
  };
  return {{"shore rising to 60 m", 20.0, 20.0, shore(60.0f)},
          {"shore rising to 6 m", 8.0, 8.0, shore(6.0f)},
          {"shore rising to 3 m", 6.0, 6.0, shore(3.0f)},
          {"SOLAS ship over 5000 GT", 11.0, 11.0, ship(110.0, 18.0, 10.0)},
          {"SOLAS ship over 500 GT", 8.0, 8.0, ship(50.0, 9.0, 5.0)},
          {"small craft with reflector", 5.0, 3.7, point(4.0, 7.5, 0.5)},
          {"buoy with corner reflector", 4.9, 3.6, point(3.5, 10.0, 1.0)},
          {"typical buoy", 4.6, 3.0, point(3.5, 5.0, 0.5)},
          {"10 m craft", 3.4, 3.0, point(2.0, 2.5, 1.4)},
          {"channel marker", 2.0, 1.0, point(1.0, 1.0, 0.1)}};
}

}  // namespace

std::vector<std::string> table2_names() {
  std::vector<std::string> names;
  for (const Table2Target& target : all()) names.push_back(target.name);
  return names;
}

Table2Target table2_target(const std::string& name) {
  for (Table2Target& target : all()) {
    if (target.name == name) return target;
  }
  throw std::invalid_argument("table 2 has no '" + name + "'");
}

RangeScale scale_for(double range_m) {
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    if (scale.length().in_metres() > range_m * 1.05) return scale;
  }
  throw std::invalid_argument("no range scale reaches that far");
}

}  // namespace skerry::validation
