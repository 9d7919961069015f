#include "server/world/handling/wave_load.hpp"

#include <numbers>

#include "echo/kernel/hash.hpp"
#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr int kSines = 4;

}  // namespace

Loads wave_load(const WaveShape& shape, double height_m, double from_rad, double time_s,
                std::uint64_t seed) {
  if (height_m <= 0.0) return {};
  const echo::SinCos from = sin_cos(from_rad);
  const double weight = kSeaWater_kg_m3 * kGravity_mps2;
  const double felt = std::min(height_m, 0.1 * shape.length_m);  // higher ones lift all of her
  Loads loads;
  loads.x = -0.64 * squared(felt * shape.beam_m) * weight * shape.block / shape.length_m * 0.5 *
            (1.0 + from.cos);

  const double period = 3.6 * std::sqrt(height_m);
  const double number = 4.0 * squared(std::numbers::pi / period) / kGravity_mps2;  // rad/m
  const double wavelength = kRadiansPerTurn / number;
  double sines = 0.0;
  for (int i = 0; i < kSines; ++i) {
    const double wave = kRadiansPerTurn / period * (0.7 + 0.2 * i);
    const auto phase = echo::as_unit(echo::mixed(seed, static_cast<std::uint64_t>(i)));
    const double turns = wave * time_s / kRadiansPerTurn + phase;
    sines += echo::sin_cos_degrees(360.0 * (turns - std::floor(turns))).sin;
  }
  loads.n = 0.1 * weight * 0.5 * felt * squared(shape.length_m) * shape.draught_m *
            (-2.0 * from.sin * from.cos) / (1.0 + squared(shape.length_m / wavelength)) * sines /
            std::sqrt(0.5 * kSines) * 0.5;
  return loads;
}

}  // namespace skerry::server
