#include "server/radar/scene_drift.hpp"

#include <cmath>

#include "echo/assembly/scene_maker.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "server/radar/laid_fixtures.hpp"

namespace skerry::server {
namespace {

constexpr double kSartOnShipM = 4.0;  // over the water: on a wing of the bridge or held by hand

}  // namespace

void lay_weather(const WorldState& state, const echo::LocalPlane& plane, double reach_m,
                 std::uint64_t seed, echo::Scene& scene) {
  const Environment& environment = *state.environment;
  scene.atmosphere = environment.atmosphere;
  scene.artefacts = environment.artefacts;
  scene.water_level_m = state.water_level_m;
  scene.wave_height_m = environment.wave_height_m;
  scene.sea = environment.sea;
  scene.sea.wind_from_deg += scene.true_north_deg;
  scene.sea.swell.from_deg += scene.true_north_deg;
  for (const RainState& rain : state.rain) {
    if (!in_plane(plane, rain.centre)) continue;
    echo::RainCell cell;
    cell.centre = plane.to_plane(rain.centre);
    cell.radius_m = rain.cloud->radius_m;
    if (length_of(cell.centre - scene.own_ship) > reach_m + cell.radius_m) continue;
    cell.velocity = echo::velocity_in(plane, rain.centre, rain.cloud->course_deg,
                                      state.pace * rain.cloud->speed_mps);
    cell.facing = echo::velocity_in(plane, rain.centre, rain.cloud->course_deg, 1.0);
    cell.rate_mm_h = rain.cloud->rate_mm_h;
    cell.kind = rain.cloud->kind;
    cell.identity = identity_of(seed, Fixture::rain, rain.cloud->id);
    scene.rain.push_back(cell);
  }
}

void lay_drifting(const WorldState& state, const echo::LocalPlane& plane, double reach_m,
                  std::uint64_t seed, echo::Scene& scene) {
  for (const SmallTargetState& small : state.adrift) {
    if (!in_plane(plane, small.position)) continue;
    const PlanePoint place = plane.to_plane(small.position);
    if (length_of(place - scene.own_ship) > reach_m) continue;
    scene.points.push_back(
        point_of(state.scenario->targets(static_cast<int>(small.number)), seed, small.number));
    scene.points.back().place = place;
    scene.points.back().velocity = echo::velocity_in(
        plane, small.position, small.course_over_ground_deg, small.pace * small.speed_mps);
  }
  std::uint64_t number = 0;
  const auto add_sart = [&](GeoPoint position, double course_deg, double speed_mps,
                            double height_m) {
    const std::uint64_t mine = number++;
    if (!in_plane(plane, position)) return;
    const PlanePoint place = plane.to_plane(position);
    if (length_of(place - scene.own_ship) > reach_m) return;
    scene.sarts.push_back({place, echo::velocity_in(plane, position, course_deg, speed_mps),
                           height_m, identity_of(seed, Fixture::sart, mine)});
  };
  for (const SartState& sart : state.sarts) {
    add_sart(sart.position, sart.course_over_ground_deg, sart.pace * sart.speed_mps, sart.height_m);
  }
  for (const ShipState& ship : state.targets) {
    if (ship.sart) {
      add_sart(ship.position, ship.course_over_ground_deg, ship.pace * ship.speed_mps,
               kSartOnShipM);
    }
  }
}

}  // namespace skerry::server
