#include "tests/scenes/scenes.hpp"

#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::scenes {

echo::ScenePtr scene_at(echo::CoastChart chart, GeoPoint own_ship, RangeScale scale,
                        const ScanGeometry& geometry, std::vector<echo::Hull> hulls,
                        double heading_deg) {
  auto scene = std::make_shared<echo::Scene>();
  echo::CoastPreparer preparer(std::move(chart), own_ship, echo::CoastRules{.seed = 1});
  scene->coast =
      preparer.prepare(own_ship, {scale.length().in_metres(), geometry.cell_size(scale).in_metres(),
                                  360.0 / geometry.spokes_per_turn});
  scene->seed = 20261121;
  scene->own_ship_geo = own_ship;
  scene->own_ship = scene->coast->plane.to_plane(own_ship);
  scene->true_north_deg = scene->coast->plane.true_north_degrees(own_ship);
  scene->heading_deg = heading_deg;
  const echo::SinCos course = echo::sin_cos_degrees(heading_deg);
  scene->own_velocity = {6.0 * course.sin, 6.0 * course.cos};
  scene->index = std::make_shared<const echo::PolarIndex>(*scene->coast, scene->own_ship, 50.0);
  scene->ashore = echo::is_ashore(*scene->coast, *scene->index, scene->own_ship);
  scene->hulls = std::move(hulls);
  return scene;
}

std::vector<echo::Hull> a_dozen_ships(double reach_m) {
  std::vector<echo::Hull> hulls;
  for (int i = 0; i < 12; ++i) {
    const echo::SinCos at = echo::sin_cos_degrees(30.0 * i + 7.0);
    const double range = reach_m * (0.1 + 0.075 * i);
    const double length = 12.0 + 22.0 * i;
    const echo::SinCos course = echo::sin_cos_degrees(77.0 * i);
    hulls.push_back({{range * at.sin, range * at.cos},
                     {7.0 * course.sin, 7.0 * course.cos},
                     77.0 * i,
                     0.1 * (i - 6),
                     length,
                     0.16 * length,
                     3.0 + i,
                     static_cast<std::uint64_t>(i)});
  }
  return hulls;
}

std::vector<NamedScene> made_up_scenes() {
  const auto scale = [](double nm) { return *RangeScale::find(nm); };
  const auto make = [&](std::string name, int islands, bool ships, double nm, ScanGeometry geometry,
                        echo::ViewControls controls) {
    controls.range_scale = scale(nm);
    const Length reach = scale(nm).length();
    return NamedScene{
        std::move(name),
        scene_at(made_up_chart(kBergen, reach * 1.3, islands, 7), kBergen, scale(nm), geometry,
                 ships ? a_dozen_ships(reach.in_metres()) : std::vector<echo::Hull>{}, 31.0),
        {},
        geometry,
        24.0,
        controls};
  };
  return {make("open sea", 0, false, 6.0, {2048, 512, 8}, {}),
          make("islands", 60, false, 3.0, {2048, 512, 8}, {}),
          make("traffic", 0, true, 6.0, {2048, 512, 8}, {}),
          make("coarse", 40, true, 12.0, {256, 256, 8}, {}),
          make("fine", 40, true, 1.5, {8192, 4096, 8}, {}),
          make("four bits", 40, true, 3.0, {1024, 1024, 4}, {}),
          make("rain control", 40, true, 3.0, {1024, 512, 8}, {RangeScale{}, 70.0, 40.0, 60.0})};
}

std::optional<NamedScene> bergen() {
  const RangeScale scale = *RangeScale::find(6.0);
  auto chart = world_chart(kBergen, scale.length() * 1.3);
  if (!chart) return std::nullopt;
  const ScanGeometry geometry;
  return NamedScene{"Bergen",
                    scene_at(std::move(*chart), kBergen, scale, geometry,
                             a_dozen_ships(scale.length().in_metres())),
                    {},
                    geometry,
                    24.0,
                    {scale, 50.0, 20.0, 0.0}};
}

std::vector<std::uint8_t> render_scans(const NamedScene& named, std::uint32_t scans,
                                       const echo::ParallelFor& parallel) {
  const std::uint32_t spokes = named.geometry.spokes_per_turn;
  echo::SpokeRenderer renderer(named.set, named.geometry, {named.rpm, spokes}, 0, parallel);
  renderer.set_controls(named.controls);
  std::vector<std::uint8_t> video(std::size_t{scans} * spokes * named.geometry.cells);
  for (std::uint32_t first = 0; first < scans * spokes; first += 16) {
    renderer.render(*named.scene, first, 16,
                    std::span(video).subspan(std::size_t{first} * named.geometry.cells,
                                             std::size_t{16} * named.geometry.cells));
  }
  return video;
}

std::uint64_t hash_of(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (std::uint8_t b : bytes) hash = (hash ^ b) * 0x100000001B3ull;
  return hash;
}

}  // namespace skerry::scenes
