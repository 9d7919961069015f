#include "server/radar/scene_builder.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/returns/coast_crossings.hpp"

namespace skerry::server {
namespace {

// A scene is used for one tick and the half beam ahead of it, well within this.
constexpr double kSceneLife = 0.5;  // seconds

double length_of(PlanePoint v) { return std::sqrt(v.east_m * v.east_m + v.north_m * v.north_m); }

PlanePoint velocity_of(const ShipState& ship, double true_north_deg) {
  const echo::SinCos course = echo::sin_cos_degrees(ship.course_over_ground_deg + true_north_deg);
  return {ship.speed_mps * course.sin, ship.speed_mps * course.cos};
}

echo::Hull hull_of(const ShipState& ship, std::uint64_t identity, const echo::LocalPlane& plane) {
  const double north = plane.true_north_degrees(ship.position);
  return {plane.to_plane(ship.position),
          velocity_of(ship, north),
          ship.heading_deg + north,
          ship.rate_of_turn_deg_s,
          ship.length_m,
          ship.beam_m,
          ship.height_m,
          identity};
}

}  // namespace

echo::ScenePtr SceneBuilder::build(const WorldStatePtr& state, const CoastInSightPtr& coast) {
  if (scene_ && state == state_ && coast == coast_) return scene_;
  const ShipState& own = state->own_ships[own_ship_];
  auto scene = std::make_shared<echo::Scene>();
  scene->time = state->time;
  scene->seed = seed_;
  const echo::CoastPicture& picture = *coast->picture;
  scene->coast = coast->picture;
  scene->own_ship_geo = own.position;
  scene->own_ship = picture.plane.to_plane(own.position);
  scene->true_north_deg = picture.plane.true_north_degrees(own.position);
  scene->own_velocity = velocity_of(own, scene->true_north_deg);
  scene->heading_deg = own.heading_deg;
  scene->water_level_m = state->water_level_m;
  scene->wave_height_m = state->wave_height_m;
  scene->turn_rate_deg_s = own.rate_of_turn_deg_s;

  const PlanePoint later = scene->own_ship + scene->own_velocity * kSceneLife;
  const auto serves = [&](const echo::PolarIndex& index) {
    return index.serves(scene->own_ship) && index.serves(later);
  };
  if (coast != coast_) own_index_ = nullptr;
  scene->index = own_index_ ? own_index_ : coast->index;
  scene->structure_index = own_index_ ? own_structure_index_ : coast->structure_index;
  if (!serves(*scene->index)) {
    const double slack = index_slack_for(picture.range_m, length_of(scene->own_velocity));
    own_index_ = std::make_shared<const echo::PolarIndex>(picture, scene->own_ship, slack);
    own_structure_index_ = structures_in_sight(picture, scene->own_ship, slack);
    scene->index = own_index_;
    scene->structure_index = own_structure_index_;
  }

  scene->ashore = echo::is_ashore(picture, *scene->index, scene->own_ship);

  // Identities count targets first, so that a ship keeps hers whoever looks.
  std::uint64_t identity = echo::mixed(seed_, 0x5817);
  const auto add = [&](const ShipState& ship) {
    // Out of reach of any radar, and of the plane.
    const double apart_deg = std::fabs(ship.position.latitude_deg - own.position.latitude_deg);
    const std::uint64_t mine = identity++;
    if (apart_deg > 3.0) return;
    const echo::Hull hull = hull_of(ship, mine, picture.plane);
    if (length_of(hull.centre - scene->own_ship) < 2.0 * picture.range_m + 1000.0) {
      scene->hulls.push_back(hull);
    }
  };
  for (const ShipState& ship : state->targets) add(ship);
  for (std::size_t i = 0; i < state->own_ships.size(); ++i) {
    if (i == own_ship_) {
      ++identity;
    } else {
      add(state->own_ships[i]);
    }
  }
  state_ = state;
  coast_ = coast;
  scene_ = std::move(scene);
  return scene_;
}

}  // namespace skerry::server
