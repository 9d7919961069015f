#include "echo/returns/ray_returns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/pulse_stretch.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/land_returns.hpp"
#include "echo/returns/shore_returns.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kUnitsPerRadian = 4294967296.0 / (2.0 * std::numbers::pi);
// The receiver is blind while the transmitter fires and the TR cell recovers (physics.md B7).
constexpr double kRecovery = 0.1e-6;

std::uint32_t units_of(double radians) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(radians * kUnitsPerRadian));
}

bool add_hulls(const Scene& scene, const HullsInSight& hulls, const RayModel& model,
               std::uint32_t bearing_units, PlanePoint own_ship, double dt, double unit_snr,
               std::vector<Scatterer>& scatterers, std::span<float> power) {
  bool any = false;
  const double ray_units = 4294967296.0 / model.rays_per_turn;
  const double resolution =
      std::max(0.5 * model.cell_m, 0.4 * 0.5 * kLightSpeed * model.pulse.length_s);
  for (const HullsInSight::Entry& entry : hulls.entries) {
    const auto off = static_cast<std::int32_t>(bearing_units - entry.middle_units);
    if (static_cast<std::uint32_t>(std::abs(static_cast<std::int64_t>(off))) > entry.reach_units)
      continue;
    scatterers_of(scene.hulls[entry.hull], own_ship, dt, model.set.antenna_height_m,
                  model.set.frequency_hz, resolution, scatterers);
    for (const Scatterer& s : scatterers) {
      // A point between two rays is shared by them in proportion to nearness.
      const auto away = static_cast<std::int32_t>(units_of(s.bearing_radians) - bearing_units);
      const double share = 1.0 - std::fabs(static_cast<double>(away)) / ray_units;
      const auto cell = static_cast<std::size_t>(s.range_m / model.cell_m);
      if (share <= 0.0 || cell >= power.size()) continue;
      const double r2 = std::max(1.0, s.range_m * s.range_m);
      power[cell] += static_cast<float>(unit_snr * s.cross_section_m2 * share / (r2 * r2));
      any = true;
    }
  }
  return any;
}

// Land of which more is known than where it is, or on which something stands.
bool is_plain_land(const Scene& scene, const RayScratch& scratch, bool structures) {
  if (structures || scene.coast->elevation) return false;
  if (scene.coast->edge_shores.empty()) return true;
  return std::all_of(scratch.land.begin(), scratch.land.end(),
                     [&](const LandInterval& land) { return is_plain(land, scene.coast->shores); });
}

void add_charted_land(const Scene& scene, const LandModel& model, const Ray& ray,
                      std::uint32_t true_units, double range_m, double dt, const LatticePath& path,
                      GroundProfile* profile, RayScratch& scratch, std::span<float> power) {
  const ShoreWater water{scene.water_level_m, scene.wave_height_m,
                         in_seconds(scene.time.time_since_epoch()) + dt, model.seed};
  lay_shores(scratch.land, *scene.coast, ray, model.ray_radians, model.cell_m, range_m, water, path,
             scratch.shores);
  std::optional<ChartedRelief> relief;
  if (scene.coast->elevation) {
    relief.emplace(
        ChartedRelief{*scene.coast->elevation,
                      GroundTrack(scene.own_ship_geo, scene.own_velocity * dt, true_units)});
  }
  add_shores(scratch.shores, model, water, path, relief ? &*relief : nullptr, profile, power);
}

}  // namespace

HullsInSight hulls_in_sight(const Scene& scene, double dt, double span, const RayModel& model) {
  HullsInSight in_sight;
  const double reach = model.cell_m * model.cells;
  for (std::uint32_t i = 0; i < scene.hulls.size(); ++i) {
    const Hull& hull = scene.hulls[i];
    const PlanePoint p =
        hull.centre + hull.velocity * dt - scene.own_ship - scene.own_velocity * dt;
    const double range = std::sqrt(p.east_m * p.east_m + p.north_m * p.north_m);
    // Half the length and half the beam, and the way made to either side of `dt`.
    const PlanePoint v = hull.velocity - scene.own_velocity;
    const double way = 0.5 * span * std::sqrt(v.east_m * v.east_m + v.north_m * v.north_m);
    const double radius = 0.5 * (hull.length_m + hull.beam_m) + 1.0 + way;
    if (range - radius > reach) continue;
    // asin(x) <= 1.0472 x for x <= 1/2; nearer than that it may lie anywhere.
    const double half = range <= 2.0 * radius ? std::numbers::pi : 1.0472 * radius / range;
    const double with_ray = half + 2.0 * (2.0 * std::numbers::pi) / model.rays_per_turn;
    in_sight.entries.push_back({i, units_of(exact_atan2(p.east_m, p.north_m)),
                                with_ray >= std::numbers::pi ? 0x80000000u : units_of(with_ray)});
  }
  return in_sight;
}

bool ray_returns(const Scene& scene, const HullsInSight& hulls, const RayModel& model,
                 std::uint32_t relative_units, double dt, RayScratch& scratch,
                 std::span<float> power) {
  std::fill(power.begin(), power.end(), 0.0f);
  const Angle heading = degrees(scene.heading_deg + scene.turn_rate_deg_s * dt);
  const std::uint32_t true_units = relative_units + TrueBearing::from(heading).units();
  const std::uint32_t plane_units =
      true_units + TrueBearing::from(degrees(scene.true_north_deg)).units();
  const PlanePoint own_ship = scene.own_ship + scene.own_velocity * dt;
  const double unit_snr = unit_signal_to_noise(model.set, model.pulse);

  const Ray ray{own_ship, plane_units};
  const double range = std::min(model.cell_m * model.cells, complete_range(*scene.coast, own_ship));
  find_crossings(*scene.coast, *scene.index, ray, scratch.crossings);
  land_along(scratch.crossings, scene.ashore, range, scratch.land);
  const StructureModel built{model.cell_m, model.set.antenna_height_m, unit_snr,
                             static_cast<std::uint32_t>(0x100000000ull / model.rays_per_turn)};
  bool structures = false;
  if (scene.structure_index) {
    find_structures(*scene.structure_index, ray, built, scratch.structures);
    structures = scratch.structures.any();
  }
  if (!scratch.land.empty()) {
    const LandModel land{model.cell_m, model.set.antenna_height_m,
                         2.0 * std::numbers::pi / model.rays_per_turn, unit_snr,
                         static_cast<std::uint32_t>(mixed(scene.seed, 0x1A9D))};
    const LatticePath path =
        lattice_path(scene.own_ship_geo, scene.own_velocity * dt, true_units, model.cell_m);
    if (is_plain_land(scene, scratch, structures)) {
      add_land(scratch.land, land, path, power);
    } else {
      if (structures) scratch.ground.clear(power.size());
      add_charted_land(scene, land, ray, true_units, range, dt, path,
                       structures ? &scratch.ground : nullptr, scratch, power);
    }
  }
  bool any = !scratch.land.empty();
  if (structures) {
    any |= add_structures(*scene.structure_index, scratch.structures, ray, built,
                          scratch.land.empty() ? nullptr : &scratch.ground, power);
  }
  any |= add_hulls(scene, hulls, model, plane_units, own_ship, dt, unit_snr, scratch.scatterers,
                   power);
  if (!any) return false;
  const double blind = 0.5 * kLightSpeed * (model.pulse.length_s + kRecovery);
  const auto blind_cells = std::min(power.size(), static_cast<std::size_t>(blind / model.cell_m));
  stretch_pulse(power, 0.5 * kLightSpeed * model.pulse.length_s / model.cell_m, scratch.stretch);
  std::fill_n(power.begin(), blind_cells, 0.0f);
  return true;
}

}  // namespace skerry::echo
