// Spokes of a made-up radar: noise, sea and echoes of known places, with beams and pulses.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::server {

struct MadeEcho {
  double bearing_deg = 0.0, range_m = 0.0;
  double level = 200.0;
  double length_m = 0.0, width_m = 0.0;  // a block of this size
};

// Of zero mean and a variance of 1, nearly Gaussian: four bytes of a hash (splitmix64).
inline double next_draw(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15u;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  const double sum =
      static_cast<double>((z & 255) + (z >> 8 & 255) + (z >> 16 & 255) + (z >> 24 & 255));
  return (sum - 510.0) / 147.8;
}

// Where the draws of spoke `n` begin: not n times the step of next_draw(), or each spoke would have
// the noise of the one before it, moved by a cell.
inline std::uint64_t noise_of(std::uint64_t n) {
  std::uint64_t z = (n + 1) * 0xD1342543DE82EF95u;
  z = (z ^ (z >> 32)) * 0xDABA0B6EB09322E3u;
  z = (z ^ (z >> 32)) * 0xDABA0B6EB09322E3u;
  return z ^ (z >> 32);
}

struct MadeRadar {
  ScanGeometry geometry{2048, 1024, 8};
  double range_nm = 3.0;
  double beam_deg = 1.2, pulse_m = 20.0;
  double noise_mean = 12.0, noise_sigma = 6.0;
  double heading_deg = 0.0, turn_deg_s = 0.0;
  double rpm = 24.0;
  std::vector<MadeEcho> echoes;

  // Spoke `n` since the beginning; the same n, the same spoke.  The bow is at `heading_deg` at n =
  // 0.
  Spoke spoke(std::uint64_t n) const {
    const double turn_s = 60.0 / rpm, spoke_s = turn_s / geometry.spokes_per_turn;
    Spoke spoke;
    spoke.header.geometry = geometry;
    spoke.header.range_scale = *RangeScale::find(range_nm);
    spoke.header.scan = static_cast<std::uint32_t>(n / geometry.spokes_per_turn);
    spoke.header.index = static_cast<std::uint32_t>(n % geometry.spokes_per_turn);
    spoke.header.sequence = n;
    const double t = spoke_s * static_cast<double>(n);
    spoke.header.scenario_time =
        ScenarioTime(std::chrono::duration_cast<Duration>(std::chrono::duration<double>(t)));
    spoke.header.heading = TrueBearing::from(degrees(heading_deg + turn_deg_s * t));
    spoke.header.own_ship = {50.0, 3.0};
    const double bearing = spoke.header.bearing().in_degrees();
    const double cell_m = spoke.header.cell_size().in_metres();
    std::vector<double> levels(geometry.cells);
    if (noise_mean > 0.0) {
      std::uint64_t state = noise_of(n);
      for (double& level : levels) level = noise_mean + noise_sigma * next_draw(state);
    }
    for (const MadeEcho& echo : echoes) {
      const double width_deg = echo.width_m / echo.range_m * kDegreesPerRadian;
      double off = std::fabs(std::remainder(bearing - echo.bearing_deg, 360.0)) - width_deg / 2.0;
      off = std::max(off, 0.0);
      // Logarithmic video: the beam's two-way Gaussian is a parabola in decibels, 4 levels a dB.
      const double fall = 4.0 * 24.0 * (off / beam_deg) * (off / beam_deg);
      const double level = echo.level - fall;
      if (level <= 0.0) continue;
      const double from = echo.range_m - echo.length_m / 2.0;
      const double to = echo.range_m + echo.length_m / 2.0 + pulse_m;
      for (auto i = static_cast<std::int64_t>(from / cell_m); static_cast<double>(i) * cell_m < to;
           ++i) {
        if (i < 0 || i >= static_cast<std::int64_t>(geometry.cells)) continue;
        const double middle = (static_cast<double>(i) + 0.5) * cell_m;
        if (middle < from || middle > to) continue;
        double& cell = levels[static_cast<std::size_t>(i)];
        cell = std::max(cell, level);
      }
    }
    const double most = geometry.bits == 4 ? 15.0 : 255.0;
    for (const double level : levels) {
      const double value = geometry.bits == 4 ? level / 17.0 : level;
      spoke.cells.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, most)));
    }
    return spoke;
  }
};

}  // namespace skerry::server
