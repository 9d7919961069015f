// Echoes of the land behind a coast edge.
#pragma once

#include <span>

#include "echo/kernel/land_chunk.hpp"
#include "echo/kernel/relief_noise.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/shore_profile.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

struct GroundProfile;

// Constants of a ray's land returns.
struct LandModel {
  double cell_m = 1.0;
  double antenna_height_m = 20.0;
  double ray_radians = 0.0015;        // the arc one ray stands for
  double unit_signal_to_noise = 1.0;  // radar_equation.hpp
  std::uint32_t seed = 0;
};

// The octaves of the land's two noises that cells of that size can show: at least two cells to a
// wavelength.  Seeds: the model's, and for the fine ones kFineSeed with it.
std::span<const NoiseOctave> broad_octaves(double cell_m);
std::span<const NoiseOctave> fine_octaves(double cell_m);
inline constexpr std::uint32_t kFineSeed = 0x51F1E;

// Adds to power[i] the mean signal-to-noise ratio of the land in cell i for one ray of the beam.
// Constant gamma: a piece of land returns gamma times the area it shows across the line of sight,
// that is the arc times the height that stands out above everything nearer (terrain and Earth), so
// flats are weak, slopes that face the radar strong, and what lies in shadow silent.  R^-3 in all:
// R^-4 of the radar equation times the arc.  Source: SOURCES.md "Propagation" and "Land" (gamma -8
// dB, wooded hill). The first cell of each stretch holds its bank, so the leading edge stands at
// the crossing. `path` is the ray over the Earth-fixed lattice.  `profile`: null, or cleared for as
// many cells as `power` has (shore_returns.hpp).
void add_land(std::span<const LandInterval> land, const LandModel& model, const LatticePath& path,
              std::span<float> power, GroundProfile* profile = nullptr);

// The lattice path of a ray with that true bearing from `own_ship` after she has `sailed`: north
// and east in metres of an Earth-fixed grid, quadratic in range.  Error: third order, 0.3 m at 12
// NM and 60 deg latitude. Longitudes are scaled by the power of two nearest below cos(latitude of
// the own ship), so the land's texture (never the coast) is another one on crossing 60, 75.5 ...
// deg of latitude and 180 deg of longitude.
LatticePath lattice_path(GeoPoint own_ship, PlanePoint sailed, std::uint32_t true_bearing_units,
                         double cell_m);

}  // namespace skerry::echo
