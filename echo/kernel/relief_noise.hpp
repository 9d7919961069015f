// Roughness of the land's height, fixed to the Earth.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace skerry::echo {

// A ray's path over the Earth-fixed lattice: at cell i (its middle) it is at
// north(i) = north0 + north1*i + north2*i^2 and the same for east, metres.
struct LatticePath {
  double north0 = 0.0, north1 = 0.0, north2 = 0.0;
  double east0 = 0.0, east1 = 0.0, east2 = 0.0;
};

struct NoiseOctave {
  double wavelength_m = 1.0;
  float amplitude = 1.0f;
};

// out[k] = sum over octaves of amplitude * value noise in [-1, 1] at cell first_cell + k, a pure
// function of the place and the seed.  Value noise: random values on a square lattice one
// wavelength apart, joined by smoothstep.  Error: the path inside a lattice cell is in float, 1e-3
// of a wavelength at 4096 wavelengths from the own ship.  Each octave has a texture of its own by
// its number, which counts from `first_octave`.
void relief_noise(const LatticePath& path, std::span<const NoiseOctave> octaves, std::uint32_t seed,
                  std::uint32_t first_cell, std::span<float> out,
                  std::uint32_t first_octave = 0) noexcept;

// Twin in double, one place.
double relief_noise_reference(double north_m, double east_m, std::span<const NoiseOctave> octaves,
                              std::uint32_t seed);

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
