#include "server/radar/scene_builder.hpp"

#include <algorithm>
#include <cmath>

#include "echo/beacons/far_echoes.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "server/radar/scene_drift.hpp"
#include "server/radar/set_faults.hpp"

namespace skerry::server {
namespace {

// A scene is used for one tick and the half beam ahead of it, well within this.
constexpr double kSceneLife = 0.5;  // seconds
constexpr double kRoughestSea = 6.0;
// Other radars are heard farther than ships are seen: their pulses come one way, with R^-2.
constexpr double kEmitterReach = 60.0 * 1852.0;         // beyond any antenna's horizon
constexpr double kDuctedEmitterReach = 150.0 * 1852.0;  // in a duct
constexpr double kEmitterScaleNm = 12.0;  // the range scale on which targets have their radars

echo::ShipMotion motion_of(const ShipState& ship) {
  return {ship.position, ship.course_over_ground_deg, ship.pace * ship.speed_mps, ship.heading_deg,
          ship.pace * ship.rate_of_turn_deg_s};
}

}  // namespace

SceneBuilder::Reach SceneBuilder::reach_of(const WorldState& state, double range_m) {
  const Environment& environment = *state.environment;
  const double echoes = 2.0 * range_m + 1000.0;
  if (environment.atmosphere.ducting <= 0.0) return {echoes, kEmitterReach};
  const double farthest = echo::FarEchoes::kFarthest;
  return {environment.artefacts.second_trace ? std::max(echoes, farthest) : echoes,
          kDuctedEmitterReach};
}

void SceneBuilder::lay_own_ship(const WorldState& state, const echo::LocalPlane& plane,
                                echo::Scene& scene) const {
  const ShipState& own = state.own_ships[role_.own_ship];
  echo::lay_own_ship(motion_of(own), plane, scene);
  scene.own_hull = {own.length_m, own.beam_m};
  scene.obstructions = role_.obstructions;
  scene.blanked = blanked_;
  scene.bearing_alignment_deg = bearing_alignment_deg_;
  if (own.faults) scene.bearing_alignment_deg += own.faults->faults.radar_bearing_error_deg();
  const scenario::ShipMotion& motion =
      state.scenario->own_ships(static_cast<int>(role_.own_ship)).motion();
  const double part = std::min(state.environment->sea.state / kRoughestSea, 1.0);
  scene.motion = {motion.roll_deg() * part, motion.roll_period_s(), motion.pitch_deg() * part,
                  motion.pitch_period_s()};
}

void SceneBuilder::find_coast(const CoastInSightPtr& coast, echo::Scene& scene) {
  const echo::CoastPicture& picture = *coast->picture;
  const PlanePoint later = scene.own_ship + scene.own_velocity * kSceneLife;
  const auto serves = [&](const echo::PolarIndex& index) {
    return index.serves(scene.own_ship) && index.serves(later);
  };
  if (coast != coast_) own_index_ = {};
  if (!serves(own_index_.polar ? *own_index_.polar : *coast->index.polar)) {
    const double slack = echo::index_slack_for(picture.range_m, length_of(scene.own_velocity));
    own_index_ = echo::index_of(picture, scene.own_ship, slack);
  }
  echo::lay_coast(coast->picture, own_index_.polar ? own_index_ : coast->index, scene);
}

void SceneBuilder::lay_ships(const WorldState& state, const echo::LocalPlane& plane,
                             const Reach& reach, echo::Scene& scene) const {
  // Identities count targets first, so that a ship keeps hers whoever looks.
  const std::uint64_t first = echo::mixed(role_.seed, 0x5817);
  const auto add = [&](const ShipState& ship, std::uint64_t number) {
    if (!in_plane(plane, ship.position)) return;
    echo::Hull hull = echo::hull_of(motion_of(ship), plane);
    if (length_of(hull.centre - scene.own_ship) >= reach.echoes_m) return;
    hull.length_m = ship.length_m;
    hull.beam_m = ship.beam_m;
    hull.height_m = ship.height_m;
    hull.identity = first + number;
    hull.cross_section_m2 = ship.cross_section_m2;
    hull.wake = ship.wake;
    scene.hulls.push_back(hull);
  };
  const auto targets = static_cast<std::uint64_t>(state.scenario->targets_size());
  for (const ShipState& ship : state.targets) add(ship, ship.number);
  for (const ShipState& ship : state.own_ships) {
    if (ship.number != role_.own_ship) add(ship, targets + ship.number);
  }
}

void SceneBuilder::lay_emitters(const WorldState& state, const std::vector<Emission>& emissions,
                                const echo::LocalPlane& plane, const Reach& reach,
                                echo::Scene& scene) const {
  const auto band_of = [](double hz) { return hz < 6e9 ? echo::Band::s : echo::Band::x; };
  const auto add = [&](echo::Emitter emitter, const ShipState& ship) {
    if (band_of(emitter.frequency_hz) != role_.band || !in_plane(plane, ship.position)) return;
    emitter.place = plane.to_plane(ship.position);
    if (length_of(emitter.place - scene.own_ship) > reach.emitters_m) return;
    emitter.velocity = echo::velocity_in(plane, ship.position, ship.course_over_ground_deg,
                                         ship.pace * ship.speed_mps);
    // Antennas turn from the bow on; her turning since is no more than an offset.
    emitter.bearing_deg += ship.heading_deg + plane.true_north_degrees(ship.position);
    scene.emitters.push_back(emitter);
  };
  for (const Emission& emission : emissions) {
    if (!emission.transmits || emission.own_ship == role_.own_ship) continue;
    const ShipState& ship = state.own_ships[emission.own_ship];
    const echo::RadarFaults faults = radar_faults(ship);
    if (faults.trigger_lost) continue;
    echo::Emitter emitter = emission.emitter;
    if (faults.power_loss_db != 0.0)
      emitter.power_w *= echo::ratio_from_decibels(-faults.power_loss_db);
    add(emitter, ship);
  }
  for (const ShipState& ship : state.targets) {
    if (ship.radar == nullptr) continue;
    echo::EmitterState aboard;
    aboard.identity = identity_of(role_.seed, Fixture::emitter, kFirstTargetEmitter + ship.number);
    echo::Emitter emitter =
        echo::emitter_of(*ship.radar, ship.radar->pulse_for(*RangeScale::find(kEmitterScaleNm)),
                         aboard, kTransmitterSpread);
    // Not all of them at the bow at once.
    emitter.bearing_deg = static_cast<double>(emitter.identity % 360u);
    add(emitter, ship);
  }
}

void SceneBuilder::set_rig(const std::vector<echo::BlankedSector>& blanked,
                           double bearing_alignment_deg) {
  if (blanked == blanked_ && bearing_alignment_deg == bearing_alignment_deg_) return;
  blanked_ = blanked;
  bearing_alignment_deg_ = bearing_alignment_deg;
  scene_ = nullptr;
}

echo::ScenePtr SceneBuilder::build(const WorldStatePtr& state, const CoastInSightPtr& coast,
                                   const EmissionsPtr& emissions) {
  if (scene_ && state == state_ && coast == coast_ && emissions == emissions_) return scene_;
  const echo::LocalPlane& plane = coast->picture->plane;
  if (!fixtures_ || !(fixtures_anchor_ == plane.anchor())) {
    fixtures_.emplace(*state->scenario, role_.seed, plane);
    fixtures_anchor_ = plane.anchor();
  }
  auto scene = std::make_shared<echo::Scene>();
  scene->time = state->time;
  scene->seed = role_.seed;
  const Reach reach = reach_of(*state, coast->picture->range_m);
  lay_own_ship(*state, plane, *scene);
  find_coast(coast, *scene);
  lay_weather(*state, plane, reach.echoes_m, role_.seed, *scene);
  lay_ships(*state, plane, reach, *scene);
  fixtures_->add_to(*scene, reach.echoes_m);
  lay_drifting(*state, plane, reach.echoes_m, role_.seed, *scene);
  lay_emitters(*state, emissions->radars, plane, reach, *scene);
  state_ = state;
  coast_ = coast;
  emissions_ = emissions;
  scene_ = std::move(scene);
  return scene_;
}

}  // namespace skerry::server
