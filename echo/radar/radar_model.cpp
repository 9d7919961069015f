#include "echo/radar/radar_model.hpp"

#include <algorithm>
#include <utility>

#include "echo/radar/radar_equation.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {

RadarModel radar_model(const RadarSet& set, const ScanGeometry& geometry, RangeScale scale,
                       const SpokeClock& clock, std::uint32_t radar, PulseChoice choice) {
  RadarModel model;
  model.set = set;
  model.pulse = set.pulse_for(scale, choice);
  model.geometry = geometry;
  model.scale = scale;
  model.clock = clock;
  model.radar = radar;
  model.spoke_radians = kRadiansPerTurn / geometry.spokes_per_turn;
  model.unit_snr = unit_signal_to_noise(set, model.pulse);
  return with_cells_of(std::move(model), geometry.cell_size(scale).in_metres());
}

RadarModel with_rows_of(RadarModel model, std::uint32_t cells) {
  model.geometry.cells = cells;
  model.blind_cells = std::min(model.blind_cells, cells);
  return model;
}

RadarModel with_cells_of(RadarModel model, double cell_m) {
  model.cell_m = cell_m;
  model.pulse_cells = 0.5 * kLightSpeed * model.pulse.length_s / cell_m;
  model.bandwidth_cells = model.pulse.bandwidth_hz * cell_m / (0.5 * kLightSpeed);
  const double blind = blind_range_m(model.pulse.length_s);
  model.blind_cells = std::min(model.geometry.cells, static_cast<std::uint32_t>(blind / cell_m));
  return model;
}

}  // namespace skerry::echo
