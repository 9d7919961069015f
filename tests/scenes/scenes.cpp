#include "tests/scenes/scenes.hpp"

#include <numbers>

#include "echo/assembly/scene_maker.hpp"
#include "echo/kernel/exact_math.hpp"

namespace skerry::scenes {

echo::ScenePtr scene_at(echo::CoastChart chart, GeoPoint own_ship, RangeScale scale,
                        const ScanGeometry& geometry, std::vector<echo::Hull> hulls,
                        double heading_deg, const echo::CoastRules& rules) {
  echo::CoastPreparer preparer(std::move(chart), own_ship, rules);
  auto scene = echo::scene_of(
      preparer.prepare(own_ship, {scale.length().in_metres(), geometry.cell_size(scale).in_metres(),
                                  360.0 / geometry.spokes_per_turn}),
      {.position = own_ship, .heading_deg = heading_deg}, 50.0);
  scene->seed = 20261121;
  const echo::SinCos course = echo::sin_cos_degrees(heading_deg);
  scene->own_velocity = {6.0 * course.sin, 6.0 * course.cos};
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

namespace {

// Islands of all kinds by turns, a mole, a bridge and a buoy, at half tide in a light swell.
NamedScene kinds_of_coast() {
  const ScanGeometry geometry{1024, 512, 8};
  const RangeScale scale = *RangeScale::find(1.5);
  echo::CoastChart chart = made_up_chart(kBergen, scale.length() * 1.3, 40, 7);
  chart.shores = {{echo::CoastType::artificial, 4.0f},
                  {echo::CoastType::rocky, 0.0f},
                  {echo::CoastType::sandy, 0.0f}};
  for (std::size_t i = 0; i < chart.rings.size(); ++i) {
    chart.rings[i].shores.assign(chart.rings[i].edges.size(), static_cast<std::uint16_t>(i % 3));
  }
  const auto off = [](double north_m, double east_m) {
    return GeoPoint{kBergen.latitude_deg + north_m / 111'400.0,
                    kBergen.longitude_deg + east_m / 55'400.0};
  };
  const auto add = [&](echo::ObjectClass kind, std::vector<GeoPoint> outline, float height) {
    echo::ChartObject object;
    object.kind = kind;
    object.outline = std::move(outline);
    object.height_m = height;
    object.cross_section_m2 = object.outline.size() == 1 ? 5.0f : 0.0f;
    object.identity = chart.objects.size();
    chart.objects.push_back(std::move(object));
  };
  add(echo::ObjectClass::pier, {off(900, -300), off(950, 100), off(1200, 200)}, 3.0f);
  add(echo::ObjectClass::bridge, {off(-700, -600), off(-600, 900)}, 12.0f);
  add(echo::ObjectClass::buoy, {off(300, 400)}, 3.5f);
  auto scene = std::make_shared<echo::Scene>(
      *scene_at(std::move(chart), kBergen, scale, geometry, {}, 31.0));
  scene->water_level_m = -1.5;
  scene->wave_height_m = 0.5;
  return {"kinds", std::move(scene), {}, geometry, 24.0, {scale, 50.0, 20.0, 0.0}};
}

// Rain of every kind, that of cells and showers in two sizes.
NamedScene rain_of_all_kinds() {
  const ScanGeometry geometry{1024, 512, 8};
  const RangeScale scale = *RangeScale::find(6.0);
  auto scene = std::make_shared<echo::Scene>(
      *scene_at(made_up_chart(kBergen, scale.length() * 1.3, 20, 7), kBergen, scale, geometry,
                a_dozen_ships(8000.0), 31.0));
  const PlanePoint ship = scene->own_ship, drift = {7.0, 4.0};
  scene->rain = {
      {ship + PlanePoint{-5000.0, 4000.0}, drift, 4000.0, 8.0, 1, echo::RainKind::cell},
      {ship + PlanePoint{5000.0, -5000.0}, drift, 6000.0, 12.0, 2, echo::RainKind::shower},
      {ship + PlanePoint{4000.0, 4000.0}, drift, 9000.0, 20.0, 3, echo::RainKind::squall_line},
      {ship + PlanePoint{-6000.0, -5000.0}, drift, 1500.0, 16.0, 4, echo::RainKind::even},
      {ship + PlanePoint{-1000.0, -1500.0}, {}, 600.0, 16.0, 5, echo::RainKind::cell},
      {ship + PlanePoint{0.0, -9000.0}, drift, 1200.0, 16.0, 6, echo::RainKind::shower}};
  return {"rain", std::move(scene), {}, geometry, 24.0, {scale, 50.0, 20.0, 0.0}};
}

// Islands by one method.
NamedScene islands_by(std::string name, const echo::CoastStyle& style) {
  const ScanGeometry geometry{1024, 512, 8};
  const RangeScale scale = *RangeScale::find(0.75);
  echo::CoastRules rules{.seed = 1};
  rules.styles.fill(style);
  return {std::move(name),
          scene_at(made_up_chart(kBergen, scale.length() * 1.3, 40, 7), kBergen, scale, geometry,
                   {}, 31.0, rules),
          {},
          geometry,
          24.0,
          {scale, 50.0, 20.0, 0.0}};
}

}  // namespace

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
          make("rain control", 40, true, 3.0, {1024, 512, 8}, {RangeScale{}, 70.0, 40.0, 60.0}),
          kinds_of_coast(),
          rain_of_all_kinds(),
          islands_by("koch", {.method = echo::CoastMethod::regular_koch, .dimension = 1.25}),
          islands_by("midpoint", {.method = echo::CoastMethod::midpoint, .dimension = 1.4}),
          islands_by("weierstrass", {.method = echo::CoastMethod::weierstrass, .dimension = 1.3})};
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
