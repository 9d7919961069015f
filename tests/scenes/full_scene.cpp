#include "tests/scenes/full_scene.hpp"

#include <utility>

#include "echo/chart/land_mask.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::scenes {
namespace {

// Places on the water, one after the other.
class Berths {
 public:
  Berths(const echo::CoastChart& chart, const echo::CoastPicture& coast, PlanePoint own_ship,
         double reach_m)
      : chart_(chart), coast_(coast), own_ship_(own_ship), reach_m_(reach_m) {}

  PlanePoint next() {
    for (;;) {
      const std::uint64_t draw = echo::mixed(0xBE27, ++drawn_);
      const echo::SinCos at = echo::sin_cos_degrees(360.0 * echo::as_unit(draw));
      const double range = reach_m_ * (0.03 + 0.97 * echo::as_unit(echo::mixed(draw)));
      const PlanePoint place = own_ship_ + PlanePoint{range * at.sin, range * at.cos};
      if (!echo::is_land(chart_, coast_.plane.to_geo(place))) return place;
    }
  }

 private:
  const echo::CoastChart& chart_;
  const echo::CoastPicture& coast_;
  PlanePoint own_ship_;
  double reach_m_;
  std::uint64_t drawn_ = 0;
};

}  // namespace

std::optional<NamedScene> full_scene(const Traffic& traffic) {
  const RangeScale scale = *RangeScale::find(6.0);
  const double reach = scale.length().in_metres();
  const auto chart = world_chart(kBergen, scale.length() * 1.3);
  if (!chart) return std::nullopt;
  const ScanGeometry geometry;
  auto scene =
      std::make_shared<echo::Scene>(*scene_at(*chart, kBergen, scale, geometry, {}, 345.0));
  const echo::SinCos course = echo::sin_cos_degrees(scene->heading_deg);
  scene->own_velocity = PlanePoint{course.sin, course.cos} * (10.0 * kKnot);
  Berths berths(*chart, *scene->coast, scene->own_ship, reach);
  for (int i = 0; i < traffic.ships; ++i) {
    const auto identity = static_cast<std::uint64_t>(i);
    const double length = 10.0 + 240.0 * echo::as_unit(echo::mixed(0x51, identity));
    const double heading = 360.0 * echo::as_unit(echo::mixed(0x52, identity));
    const echo::SinCos way = echo::sin_cos_degrees(heading);
    echo::Hull hull;
    hull.centre = berths.next();
    hull.velocity = PlanePoint{way.sin, way.cos} * (12.0 * kKnot);
    hull.heading_deg = heading;
    hull.length_m = length;
    hull.beam_m = 0.15 * length + 1.5;
    hull.height_m = 3.0 + 0.1 * length;
    hull.identity = identity;
    scene->hulls.push_back(hull);
  }
  for (int i = 0; i < traffic.buoys; ++i) {
    echo::PointTarget buoy;
    buoy.place = berths.next();
    buoy.identity = 1000 + static_cast<std::uint64_t>(i);
    scene->points.push_back(buoy);
  }
  scene->sea.state = 4.0;
  scene->sea.wind_from_deg = 240.0;
  scene->wave_height_m = 1.9;
  scene->rain = {{scene->own_ship + PlanePoint{3000.0, 4000.0}, {5.0, 3.0}, 3000.0, 8.0, 1},
                 {scene->own_ship + PlanePoint{-5000.0, -2000.0}, {5.0, 3.0}, 2500.0, 16.0, 2}};
  echo::ViewControls controls;
  controls.range_scale = scale;
  controls.sea = 40.0;
  controls.rain = 30.0;
  controls.interference_rejection = 50.0;
  controls.echo_stretch = 30.0;
  controls.integration = 30.0;
  return NamedScene{"full", std::move(scene), {}, geometry, 24.0, controls};
}

}  // namespace skerry::scenes
