// RainReturns: the echo of rain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "echo/clutter/speckle.hpp"
#include "echo/kernel/aligned_floats.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Backscatter of rain per volume, 1/m: pi^5 0.93 Z 1e-18 / lambda^4 with Z = 200 R^1.6 mm6/m3
// (Marshall and Palmer 1948, Rayleigh scattering; SOURCES.md "Rain").  X band 4 mm/h: -62.94 dB.
// Error: heavy rain at X band leaves the Rayleigh region by some tenths of a dB.
double rain_reflectivity(double frequency_hz, double rate_mm_h);

// Mean echo over noise at 1 mm/h: unit_snr eta V / R^4 with V = R clutter width * height * c tau /
// 2 and height the smaller of 0.753 vertical beams at that range (Probert-Jones: the lower half of
// the beam is turned up by the sea) and the rain's top.  So R^-2 up to some 14 km, then R^-3.
inline constexpr double kRainTop = 4000.0;  // m, SOURCES.md "Rain"
// `clutter_width`: that of the antenna's pattern, radians (antenna_pattern.hpp).
double rain_level(const RadarModel& model, double clutter_width, double range_m);

// Rates (mm/h) to the power of 1.6, as rain echoes.  As many echoes as rates.
void rain_echoes(std::span<const float> rate_mm_h, std::span<float> echoes);

// The rain along a spoke (echo/propagation/rain_path.hpp): from cell `first` on, every
// `step` (1, 2, 4, 8 or 16) cells to one at or behind `end`.
struct RainKnots {
  std::span<const float> echoes, transmission;
  std::size_t step = 1, first = 0, end = 0;
};

// Rain's echo fluctuates as an exponential; drops that fall and blow about at 1 m/s to either side
// forget their phases in 3.6 ms at X band, in proportion to the wavelength.
class RainReturns {
 public:
  explicit RainReturns(const RadarModel& model);

  // Adds the rain's echo to what the spoke has, and dims all that lies in the rain and behind it.
  // Between knots the echo goes straight.  `seed`: the scene's.  power holds the radar's cells.
  // Thread: any.
  void pass(std::uint64_t seed, const SpokeAim& aim, const RainKnots& rain,
            std::span<float> power) const;

 private:
  std::uint32_t radar_, spokes_per_turn_;
  AlignedFloats level_;
  std::shared_ptr<const Speckle> speckle_;
};

}  // namespace skerry::echo
