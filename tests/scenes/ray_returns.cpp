#include "tests/scenes/ray_returns.hpp"

#include <algorithm>

#include "echo/kernel/pulse_stretch.hpp"
#include "echo/radar/radar_equation.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

bool ray_returns(const Scene& scene, const RayModel& model, std::uint32_t relative_units, double dt,
                 RayScratch& scratch, std::span<float> power) {
  std::fill(power.begin(), power.end(), 0.0f);
  const Angle heading = degrees(scene.heading_deg + scene.turn_rate_deg_s * dt);
  const std::uint32_t true_units = relative_units + TrueBearing::from(heading).units();
  const std::uint32_t plane_units =
      true_units + TrueBearing::from(degrees(scene.true_north_deg)).units();
  const PlanePoint own_ship = scene.own_ship + scene.own_velocity * dt;
  const double unit_snr = unit_signal_to_noise(model.set, model.pulse);

  StaticView view;
  view.coast = scene.coast.get();
  view.structures = scene.structure_index.get();
  view.at = own_ship;
  view.geo = scene.own_ship_geo;
  view.sailed = scene.own_velocity * dt;
  view.north_units = plane_units - true_units;
  view.ashore = scene.ashore;
  view.water = {scene.water_level_m, scene.wave_height_m,
                in_seconds(scene.time.time_since_epoch()) + dt, land_seed(scene.seed)};
  find_crossings(*scene.coast, *scene.index, {own_ship, plane_units}, scratch.crossings);
  const bool any = add_static_ray(
      view, {model.cell_m, model.set.antenna_height_m, unit_snr, model.rays_per_turn}, plane_units,
      false, scratch, power);
  if (!any) return false;
  const double blind = blind_range_m(model.pulse.length_s);
  const auto blind_cells = std::min(power.size(), static_cast<std::size_t>(blind / model.cell_m));
  stretch_pulse(power, 0.5 * kLightSpeed * model.pulse.length_s / model.cell_m, scratch.stretch);
  std::fill_n(power.begin(), blind_cells, 0.0f);
  return true;
}

}  // namespace skerry::echo
