#include "echo/picture_tool/made_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "echo/assembly/scene_maker.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/picture_tool/picture_statistics.hpp"
#include "echo/spoke_renderer.hpp"

namespace skerry::echo {
namespace {

// Fjords, rias, skerries, sounds and lochs: coasts that a radar of 1 to 5 km sees from within.
constexpr std::array kCoasts = {
    GeoPoint{60.27, 5.15},  GeoPoint{48.65, -3.9}, GeoPoint{42.4, -8.9}, GeoPoint{59.4, 18.7},
    GeoPoint{47.6, -122.5}, GeoPoint{50.2, -5.05}, GeoPoint{43.2, 16.4}, GeoPoint{56.2, -5.6},
    GeoPoint{44.1, -68.7},  GeoPoint{58.9, 9.5},   GeoPoint{36.9, 27.2}, GeoPoint{-41.2, 174.1}};
constexpr double kShakeNorth_deg = 0.12, kShakeEast_deg = 0.2;  // from end to end
constexpr std::uint64_t kSceneSeed = 20261121;
constexpr double kAntennaHeight_m = 10.0;
constexpr double kLeastOccupancy = 0.01, kMostOccupancy = 0.7;

GeoPoint place_tried(const StandInWish& wish, std::uint32_t number) {
  const std::uint64_t k = mixed(wish.seed, number);
  GeoPoint at = kCoasts[number % kCoasts.size()];
  at.latitude_deg += (static_cast<double>(k & 0xFFFF) / 65536.0 - 0.5) * kShakeNorth_deg;
  at.longitude_deg += (static_cast<double>(k >> 16 & 0xFFFF) / 65536.0 - 0.5) * kShakeEast_deg;
  return at;
}

std::shared_ptr<Scene> scene_there(const ChartSource& chart, const MadeRadar& radar, GeoPoint at) {
  const double reach = radar.reach_m();
  CoastPreparer preparer(chart.load(at, metres(reach * 1.3)), at, {.seed = 1});
  auto scene = scene_of(preparer.prepare(at, {reach, reach / radar.geometry.cells,
                                              360.0 / radar.geometry.spokes_per_turn}),
                        {.position = at}, 50.0);
  scene->seed = kSceneSeed;
  return scene;
}

double occupancy_of(const TurnsOfPicture& picture) {
  const PictureTurn turn = picture.turn(0, 1.0);
  return share_that_echoes({&turn, 1});
}

// How many times more, or less.
double times_apart(double a, double b) { return std::fabs(std::log(a / b)); }

}  // namespace

MadeRadar radar_like(const TurnsOfPicture& real, const RadarSet& set, double reach_over_scale) {
  MadeRadar radar;
  radar.set = set;
  radar.set.antenna_height_m = kAntennaHeight_m;
  radar.geometry = {real.spokes, real.cells, real.full_scale == 15 ? 4u : 8u};
  if (!radar.geometry.valid())
    throw std::runtime_error(
        fmt::format("{}: {} spokes of {} cells cannot be made; expected {} to {} of {} to {}",
                    real.file, real.spokes, real.cells, ScanGeometry::kMinSpokes,
                    ScanGeometry::kMaxSpokes, ScanGeometry::kMinCells, ScanGeometry::kMaxCells));
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    const double length = scale.length().in_metres();
    const double off = times_apart(length * reach_over_scale, real.reach_m);
    if (length * 2.0 >= real.reach_m && off < best) best = off, radar.controls.range_scale = scale;
  }
  radar.controls.instrumented_range_m = real.reach_m;
  if (!std::isfinite(best) || times_apart(radar.reach_m(), real.reach_m) > 1e-3)
    throw std::runtime_error(
        fmt::format("{}: no range scale reaches {:.0f} m, expected {:.0f} to "
                    "{:.0f} m",
                    real.file, real.reach_m, 0.125 / 16.0 * 1852.0, 2.0 * 96.0 * 1852.0));
  return radar;
}

std::vector<StandIn> find_stand_ins(const ChartSource& chart, const MadeRadar& radar,
                                    const StandInWish& wish, const PictureTelling& tell) {
  struct Tried {
    StandIn place;
    double off;
  };
  std::vector<StandIn> found;
  std::vector<Tried> others;
  const bool known = wish.occupancy > 0.0;
  for (std::uint32_t n = 0; n < wish.most_tried && found.size() < wish.count; ++n) {
    tell(fmt::format("place {} of {}, {} tried", found.size() + 1, wish.count, n));
    const GeoPoint at = place_tried(wish, n);
    const auto scene = scene_there(chart, radar, at);
    if (scene->ashore) continue;
    StandIn place{at, scene};
    const double occupancy = occupancy_of(make_picture(radar, place, 1));
    if (occupancy < kLeastOccupancy || occupancy > kMostOccupancy) continue;
    const double off = known ? times_apart(occupancy, wish.occupancy) : 0.0;
    if (off <= std::log(2.0)) {
      found.push_back(std::move(place));
    } else {
      others.push_back({std::move(place), off});
    }
  }
  std::stable_sort(others.begin(), others.end(),
                   [](const Tried& a, const Tried& b) { return a.off < b.off; });
  for (Tried& other : others) {
    if (found.size() >= wish.count) break;
    found.push_back(std::move(other.place));
  }
  return found;
}

TurnsOfPicture make_picture(const MadeRadar& radar, const StandIn& place, std::uint32_t turns) {
  TurnsOfPicture picture;
  picture.file =
      fmt::format("ours at {:.4f}, {:.4f}", place.at.latitude_deg, place.at.longitude_deg);
  picture.radar = radar.set.name;
  picture.reach_m = radar.reach_m();
  picture.spokes = radar.geometry.spokes_per_turn;
  picture.cells = radar.geometry.cells;
  picture.full_scale = radar.geometry.bits == 4 ? 15 : 255;
  picture.rpm = radar.set.rpm;
  SpokeRenderer renderer(radar.set, radar.geometry, {radar.set.rpm, picture.spokes}, 0);
  renderer.set_controls(radar.controls);
  constexpr std::uint32_t kSector = 16;
  for (std::uint32_t t = 0; t < turns; ++t) {
    std::vector<std::uint8_t> video(std::size_t{picture.spokes} * picture.cells);
    for (std::uint32_t s = 0; s < picture.spokes; s += kSector) {
      const std::uint32_t count = std::min(kSector, picture.spokes - s);
      renderer.render(*place.scene, std::uint64_t{t} * picture.spokes + s, count,
                      std::span(video).subspan(std::size_t{s} * picture.cells,
                                               std::size_t{count} * picture.cells));
    }
    for (std::uint8_t& cell : video) cell = std::min(cell, radar.highest);
    picture.turns.push_back(std::move(video));
    picture.follows.push_back(t > 0);
  }
  return picture;
}

}  // namespace skerry::echo
