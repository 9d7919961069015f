// Spokes of a radar whose noise and echoes add as voltages: what detection is measured with.
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {

// Logarithmic video of 4 levels a decibel; the mean of the noise's power is at `noise_level`.
// Points of equal strength stand every `apart_deg` at `range_m`, from half of that on.
struct PulsedRadar {
  ScanGeometry geometry{2048, 256, 8};
  double range_nm = 0.75;
  double beam_deg = 1.2;
  // A pulse is so many cells long, and so is what noise has in common (a matched receiver).
  std::uint32_t pulse_cells = 3;
  double noise_level = 60.0;
  double snr_db = -100.0;  // of a pulse, in the middle of the beam
  bool fades = false;      // from turn to turn, Swerling 1
  double apart_deg = 11.25, range_m = 900.0;

  Spoke spoke(std::uint64_t n) const {
    Spoke spoke;
    spoke.header.geometry = geometry;
    spoke.header.range_scale = *RangeScale::find(range_nm);
    spoke.header.scan = static_cast<std::uint32_t>(n / geometry.spokes_per_turn);
    spoke.header.index = static_cast<std::uint32_t>(n % geometry.spokes_per_turn);
    spoke.header.own_ship = {50.0, 3.0};
    const double cell_m = spoke.header.cell_size().in_metres();
    std::uint64_t state = noise_of(n);
    std::vector<std::complex<double>> white(geometry.cells + pulse_cells);
    for (auto& each : white) each = voltage(state);
    // The point next to the beam.
    const double bearing = spoke.header.antenna().in_degrees();
    const double point = std::floor(bearing / apart_deg);
    const double off = (bearing - (point + 0.5) * apart_deg) / beam_deg;
    std::uint64_t fading = noise_of(spoke.header.scan * 100000u + static_cast<unsigned>(point));
    const std::complex<double> phase = voltage(fading);
    const double power = std::pow(10.0, (snr_db - 24.0 * off * off) / 10.0);
    const std::complex<double> echo = std::sqrt(power) * (fades ? phase : phase / std::abs(phase));
    const auto first = static_cast<std::int64_t>(range_m / cell_m - pulse_cells / 2.0 + 0.5);
    for (std::int64_t i = 0; i < geometry.cells; ++i) {
      std::complex<double> sum = 0.0;
      for (std::uint32_t k = 0; k < pulse_cells; ++k) sum += white[static_cast<std::size_t>(i) + k];
      sum /= std::sqrt(static_cast<double>(pulse_cells));
      if (i >= first && i < first + pulse_cells) sum += echo;
      const double level = noise_level + 40.0 * std::log10(std::norm(sum) + 1e-12);
      spoke.cells.push_back(static_cast<std::uint8_t>(std::clamp(level + 0.5, 0.0, 255.0)));
    }
    return spoke;
  }

 private:
  // Complex, Gaussian, of a mean power of 1 (Box and Muller).
  static std::complex<double> voltage(std::uint64_t& state) {
    state += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
    const double u = (static_cast<double>(z >> 32) + 0.5) * 0x1p-32;
    const double angle = static_cast<double>(z & 0xffffffffu) * 0x1p-32 * 2.0 * std::numbers::pi;
    return std::polar(std::sqrt(-std::log(u)), angle);
  }
};

}  // namespace skerry::server
