#include "echo/capi/radar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echo/capi/call.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo::capi {
namespace {

// Spokes between two looks at whether the index serves.
constexpr std::uint32_t kSector = 64;
// An index is made to serve at least this long.
constexpr double kIndexSeconds = 0.5;

// Ships farther off than twice the range and this are left out: a scene lasts 10 s.
constexpr double kReachMargin = 2000.0;  // metres

PlanePoint own_ship_at(const Scene& scene, double after_s) {
  return scene.own_ship + scene.own_velocity * after_s;
}

}  // namespace

Radar::Radar(std::shared_ptr<const SharedChart> chart, const CoastRules& rules,
             const RadarMount& mount)
    : chart_(std::move(chart)),
      rules_(rules),
      mount_(mount),
      clock_(mount.set.rpm, mount.geometry.spokes_per_turn),
      renderer_(mount.set, mount.geometry, clock_, mount.number) {}

Radar::View Radar::view_for(const ShipMotion& own_ship, RangeScale scale) const {
  const RadarResolution resolution{scale.length().in_metres(),
                                   mount_.geometry.cell_size(scale).in_metres(),
                                   360.0 / mount_.geometry.spokes_per_turn};
  View view = view_;
  if (!view.preparer || !view.preparer->serves(own_ship.position, resolution.range_m)) {
    view.preparer = prepared_around(*chart_, rules_, own_ship.position, resolution.range_m);
    view.picture = nullptr;
    ++view.charts_read;
  }
  const auto away = [&](const CoastPicture& picture) {
    return length_of(picture.plane.to_plane(own_ship.position) - picture.centre);
  };
  // Half of the slack is left for the way sailed until the next scene.
  if (!view.picture || !(view.resolution == resolution) ||
      away(*view.picture) > 0.5 * view.picture->slack_m) {
    view.picture = view.preparer->prepare(own_ship.position, resolution);
    view.resolution = resolution;
    view.index = {};
    ++view.coasts_made;
  }
  return view;
}

ScenePtr Radar::scene_of(const ShipPositions& positions, View& view) const {
  const CoastPicture& picture = *view.picture;
  const ShipMotion& own = positions.own_ship;
  auto scene = std::make_shared<Scene>();
  scene->time = positions.time;
  scene->seed = rules_.seed;
  lay_own_ship(own, picture.plane, *scene);
  if (!view.index.polar || !view.index.polar->serves(scene->own_ship) ||
      !view.index.polar->serves(own_ship_at(*scene, kIndexSeconds))) {
    view.index =
        index_of(picture, scene->own_ship, index_slack_for(picture.range_m, own.speed_mps));
  }
  lay_coast(view.picture, view.index, *scene);
  scene->water_level_m = sea_.water_level_m;
  scene->wave_height_m = sea_.wave_height_m;
  for (const TargetShip& ship : positions.targets) {
    Hull hull = hull_of(ship.motion, picture.plane);
    if (length_of(hull.centre - scene->own_ship) > 2.0 * picture.range_m + kReachMargin) continue;
    hull.length_m = ship.length_m;
    hull.beam_m = ship.beam_m;
    hull.height_m = ship.height_m;
    hull.identity = ship.identity;
    scene->hulls.push_back(hull);
  }
  return scene;
}

void Radar::set_controls(const ViewControls& controls) {
  if (scene_ && !(controls.range_scale == renderer_.controls().range_scale)) {
    View view = view_for(positions_.own_ship, controls.range_scale);
    ScenePtr scene = scene_of(positions_, view);
    renderer_.set_controls(controls);
    view_ = std::move(view);
    scene_ = std::move(scene);
  } else {
    renderer_.set_controls(controls);
  }
}

void Radar::set_sea(const SeaState& sea) {
  if (scene_) {
    auto scene = std::make_shared<Scene>(*scene_);
    scene->water_level_m = sea.water_level_m;
    scene->wave_height_m = sea.wave_height_m;
    scene_ = std::move(scene);
  }
  sea_ = sea;
}

void Radar::set_positions(ShipPositions positions) {
  View view = view_for(positions.own_ship, renderer_.controls().range_scale);
  ScenePtr scene = scene_of(positions, view);
  positions_ = std::move(positions);
  view_ = std::move(view);
  scene_ = std::move(scene);
}

void Radar::require_served(double from_s, double to_s) const {
  const double off = std::max(std::fabs(from_s), std::fabs(to_s));
  if (off > kSceneSeconds) {
    throw CallError(SKERRY_ECHO_ERROR_STATE,
                    fmt::format("the spokes are up to {:.3f} s from the scene's time; a scene "
                                "serves {} s: call skerry_echo_radar_set_scene",
                                off, kSceneSeconds));
  }
  const CoastPicture& picture = *scene_->coast;
  const double away = std::max(length_of(own_ship_at(*scene_, from_s) - picture.centre),
                               length_of(own_ship_at(*scene_, to_s) - picture.centre));
  if (away > picture.slack_m) {
    throw CallError(SKERRY_ECHO_ERROR_STATE,
                    fmt::format("the own ship sails to {:.1f} m from where the coast was made for "
                                "her, which serves {:.1f} m at this range scale: render fewer "
                                "spokes per scene, or call skerry_echo_radar_set_scene",
                                away, picture.slack_m));
  }
}

void Radar::keep_indexed(double from_s, double to_s) {
  const PlanePoint from = own_ship_at(*scene_, from_s), to = own_ship_at(*scene_, to_s);
  if (scene_->index->serves(from) && scene_->index->serves(to)) return;
  const double slack = index_slack_for(scene_->coast->range_m, length_of(scene_->own_velocity));
  view_.index = index_of(*view_.picture, (from + to) * 0.5, std::max(slack, length_of(to - from)));
  auto scene = std::make_shared<Scene>(*scene_);
  scene->index = view_.index.polar;
  scene->structure_index = view_.index.structures;
  scene_ = std::move(scene);
}

void Radar::render(std::uint64_t first, std::uint32_t count, std::uint8_t* video,
                   std::size_t stride) {
  if (!scene_) {
    throw CallError(SKERRY_ECHO_ERROR_STATE,
                    "no scene is set: call skerry_echo_radar_set_scene first");
  }
  const auto after = [&](std::uint64_t spoke) {
    return in_seconds(clock_.time_of(spoke) - scene_->time);
  };
  require_served(after(first), after(first + count - 1));
  const std::uint32_t cells = mount_.geometry.cells;
  if (stride != cells) rows_.resize(std::size_t{kSector} * cells);
  for (std::uint32_t done = 0; done < count;) {
    const std::uint32_t step = std::min(count - done, kSector);
    keep_indexed(after(first + done), after(first + done + step - 1));
    std::uint8_t* const rows = video + done * stride;
    const std::size_t bytes = std::size_t{step} * cells;
    if (stride == cells) {
      renderer_.render(*scene_, first + done, step, {rows, bytes});
    } else {
      renderer_.render(*scene_, first + done, step, {rows_.data(), bytes});
      for (std::uint32_t k = 0; k < step; ++k) {
        std::copy_n(rows_.data() + std::size_t{k} * cells, cells, rows + k * stride);
      }
    }
    done += step;
  }
}

}  // namespace skerry::echo::capi
