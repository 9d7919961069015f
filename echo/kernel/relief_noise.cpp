#include "echo/kernel/relief_noise.hpp"

#include <cmath>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY add_octave_body(OctavePath p, std::uint32_t first, float* __restrict out,
                                   std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    out[k] += octave_at(p, static_cast<std::int32_t>(first + k));
  }
}
SKERRY_KERNEL(add_octave,
              (OctavePath p, std::uint32_t first, float* __restrict out, std::size_t count),
              (p, first, out, count))

}  // namespace

void relief_noise(const LatticePath& path, std::span<const NoiseOctave> octaves, std::uint32_t seed,
                  std::uint32_t first_cell, std::span<float> out,
                  std::uint32_t first_octave) noexcept {
  for (float& value : out) value = 0.0f;
  for (std::size_t o = 0; o < octaves.size(); ++o) {
    add_octave(octave_path(path, octaves[o], seed, first_octave + static_cast<std::uint32_t>(o)),
               first_cell, out.data(), out.size());
  }
}

double relief_noise_reference(double north_m, double east_m, std::span<const NoiseOctave> octaves,
                              std::uint32_t seed) {
  double sum = 0.0;
  for (std::size_t o = 0; o < octaves.size(); ++o) {
    const double n = north_m / octaves[o].wavelength_m, e = east_m / octaves[o].wavelength_m;
    const auto row = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(n)));
    const auto column = static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(e)));
    const double fn = n - std::floor(n), fe = e - std::floor(e);
    const double sn = fn * fn * (3 - 2 * fn), se = fe * fe * (3 - 2 * fe);
    const std::uint32_t s = seed + static_cast<std::uint32_t>(o) * 0x9E3779B9u;
    const std::uint32_t at = row * kRowStep + column * kColumnStep + s;
    const double a = corner(at), b = corner(at + kColumnStep);
    const double c = corner(at + kRowStep), d = corner(at + kRowStep + kColumnStep);
    const double south = a + se * (b - a), north = c + se * (d - c);
    sum += static_cast<double>(octaves[o].amplitude) * (south + sn * (north - south));
  }
  return sum;
}

}  // namespace skerry::echo
