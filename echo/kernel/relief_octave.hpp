// One octave of value noise along a ray, for the kernels that need it inside their own loops.
#pragma once

#include <cmath>
#include <cstdint>

#include "echo/kernel/relief_noise.hpp"

namespace skerry::echo {

// One octave's path in lattice units: whole start plus float offsets along the ray.
struct OctavePath {
  std::uint32_t row, column;
  float n0, n1, n2, e0, e1, e2;
  float amplitude;
  std::uint32_t seed;
};

inline constexpr std::uint32_t kRowStep = 0x9E3779B1u, kColumnStep = 0x85EBCA77u;

// Random value in [-1, 1] of the corner with row * kRowStep + column * kColumnStep + seed = `x`.
inline __attribute__((always_inline)) float corner(std::uint32_t x) {
  x ^= x >> 15;
  x *= 0x2C1B3C6Du;
  x ^= x >> 13;
  x *= 0x297A2D39u;
  return static_cast<float>(static_cast<std::int32_t>(x)) * 0x1p-31f;
}
inline __attribute__((always_inline)) std::int32_t whole_below(float x) {
  const auto t = static_cast<std::int32_t>(x);
  return t - static_cast<std::int32_t>(static_cast<float>(t) > x);
}

// The octave at cell `cell` of the path.
inline __attribute__((always_inline)) float octave_at(const OctavePath& p, std::int32_t cell) {
  const float i = static_cast<float>(cell);
  const float n = p.n0 + i * (p.n1 + i * p.n2);
  const float e = p.e0 + i * (p.e1 + i * p.e2);
  const std::int32_t in = whole_below(n), ie = whole_below(e);
  const float fn = n - static_cast<float>(in), fe = e - static_cast<float>(ie);
  const float sn = fn * fn * (3.0f - 2.0f * fn), se = fe * fe * (3.0f - 2.0f * fe);
  const std::uint32_t at = (p.row + static_cast<std::uint32_t>(in)) * kRowStep +
                           (p.column + static_cast<std::uint32_t>(ie)) * kColumnStep + p.seed;
  const float a = corner(at), b = corner(at + kColumnStep);
  const float c = corner(at + kRowStep), d = corner(at + kRowStep + kColumnStep);
  const float south = a + se * (b - a), north = c + se * (d - c);
  return p.amplitude * (south + sn * (north - south));
}

inline OctavePath octave_path(const LatticePath& path, const NoiseOctave& octave,
                              std::uint32_t seed, std::uint32_t octave_index) {
  const double scale = 1.0 / octave.wavelength_m;
  const double n = path.north0 * scale, e = path.east0 * scale;
  const double row = std::floor(n), column = std::floor(e);
  return {static_cast<std::uint32_t>(static_cast<std::int64_t>(row)),
          static_cast<std::uint32_t>(static_cast<std::int64_t>(column)),
          static_cast<float>(n - row),
          static_cast<float>(path.north1 * scale),
          static_cast<float>(path.north2 * scale),
          static_cast<float>(e - column),
          static_cast<float>(path.east1 * scale),
          static_cast<float>(path.east2 * scale),
          octave.amplitude,
          seed + octave_index * 0x9E3779B9u};
}

}  // namespace skerry::echo
