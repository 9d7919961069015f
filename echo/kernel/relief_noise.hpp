// Roughness of the land's height, fixed to the Earth.
#pragma once

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

}  // namespace skerry::echo
