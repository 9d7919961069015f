// RadarModel: a radar on one range scale, with all that does not change from spoke to spoke.
#pragma once

#include <cstdint>

#include "echo/radar/radar_set.hpp"
#include "echo/radar/spoke_clock.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::echo {

struct RadarModel {
  RadarSet set;
  Pulse pulse;
  ScanGeometry geometry;  // of its rows, which may be longer than the range scale
  RangeScale scale;
  SpokeClock clock{24.0, 4096};
  std::uint32_t radar = 0;  // which radar of the host: tells noise and fluctuation apart

  double cell_m = 1.0;           // range of a cell
  double pulse_cells = 1.0;      // c tau / 2 in cells
  double bandwidth_cells = 0.0;  // the pulse's bandwidth times the time of a cell
  double spoke_radians = 0.0;    // arc of a spoke
  double unit_snr = 1.0;  // signal over noise of 1 m2 at 1 m in free space (radar_equation.hpp)

  // First cell that is seen after the transmitter has fired and the TR cell has recovered.
  std::uint32_t blind_cells = 0;
};

// Requires a valid geometry and a set that passes its checks.
RadarModel radar_model(const RadarSet& set, const ScanGeometry& geometry, RangeScale scale,
                       const SpokeClock& clock, std::uint32_t radar,
                       PulseChoice choice = PulseChoice::automatic);

// The model with rows of so many cells of the same length, beyond the range scale or not so far.
RadarModel with_rows_of(RadarModel model, std::uint32_t cells);

// The model in cells of another length, whatever its range scale.
RadarModel with_cells_of(RadarModel model, double cell_m);

}  // namespace skerry::echo
