#include "echo/kernel/log_receiver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// The second key enters between the two multiplications, so that spokes whose counters overlap
// still get unrelated noise.
inline __attribute__((always_inline)) std::uint32_t cell_hash(NoiseKey key, std::uint32_t cell) {
  std::uint32_t x = cell * 0x9E3779B9u + key.first;
  x ^= x >> 16;
  x *= 0x7FEB352Du;
  x ^= x >> 15;
  x += key.second;
  x *= 0x846CA68Bu;
  return x ^ (x >> 16);
}

// u = (h + 1/2) / 2^24 lies strictly within (0, 1), so log2(u) < 0; the fast log may come out up to
// its error above the truth, hence the floor: a negative sum would make the next log saturate.
inline __attribute__((always_inline)) float unit_noise(NoiseKey key, std::uint32_t cell) {
  const auto h = static_cast<std::int32_t>(cell_hash(key, cell) >> 8);
  const float u = (static_cast<float>(h) + 0.5f) * 0x1p-24f;
  const float e = -std::numbers::ln2_v<float> * fast_log2(u);
  return e > 1e-7f ? e : 1e-7f;
}

SKERRY_KERNEL_BODY detect_and_quantise_body(const float* power, const float* offset, NoiseKey key,
                                            QuantiserScale scale, std::uint8_t* video,
                                            std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float total = power[i] + unit_noise(key, static_cast<std::uint32_t>(i));
    float v = scale.per_octave * fast_log2(total) + offset[i];
    v = v > 0.0f ? v : 0.0f;
    v = v < scale.top ? v : scale.top;
    video[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(v));
  }
}

SKERRY_KERNEL_BODY detect_body(const float* power, NoiseKey key, float* octaves, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    octaves[i] = fast_log2(power[i] + unit_noise(key, static_cast<std::uint32_t>(i)));
  }
}

SKERRY_KERNEL_BODY quantise_body(const float* octaves, const float* offset, QuantiserScale scale,
                                 std::uint8_t* video, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    float v = scale.per_octave * octaves[i] + offset[i];
    v = v > 0.0f ? v : 0.0f;
    v = v < scale.top ? v : scale.top;
    video[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(v));
  }
}

SKERRY_KERNEL(detect_and_quantise,
              (const float* __restrict power, const float* __restrict offset, NoiseKey key,
               QuantiserScale scale, std::uint8_t* __restrict video, std::size_t n),
              (power, offset, key, scale, video, n))
SKERRY_KERNEL(detect,
              (const float* __restrict power, NoiseKey key, float* __restrict octaves,
               std::size_t n),
              (power, key, octaves, n))
SKERRY_KERNEL(quantise,
              (const float* __restrict octaves, const float* __restrict offset,
               QuantiserScale scale, std::uint8_t* __restrict video, std::size_t n),
              (octaves, offset, scale, video, n))

}  // namespace

NoiseKey noise_key(std::uint64_t seed, std::uint32_t radar, std::uint32_t scan,
                   std::uint32_t spoke) {
  const std::uint64_t h =
      mixed(seed, (std::uint64_t{radar} << 32) | scan, std::uint64_t{spoke} + 0x5EA5);
  return {static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32)};
}

double unit_noise_reference(NoiseKey key, std::uint32_t cell) {
  return -std::log((static_cast<double>(cell_hash(key, cell) >> 8) + 0.5) * 0x1p-24);
}

void detect_and_quantise(std::span<const float> power, std::span<const float> offset, NoiseKey key,
                         QuantiserScale scale, std::span<std::uint8_t> video) noexcept {
  detect_and_quantise(power.data(), offset.data(), key, scale, video.data(), video.size());
}

void detect(std::span<const float> power, NoiseKey key, std::span<float> octaves) noexcept {
  detect(power.data(), key, octaves.data(), octaves.size());
}

void quantise(std::span<const float> octaves, std::span<const float> offset, QuantiserScale scale,
              std::span<std::uint8_t> video) noexcept {
  quantise(octaves.data(), offset.data(), scale, video.data(), video.size());
}

void detect_and_quantise_reference(std::span<const float> power, std::span<const float> offset,
                                   NoiseKey key, QuantiserScale scale, std::span<double> video) {
  for (std::size_t i = 0; i < video.size(); ++i) {
    const double total = power[i] + unit_noise_reference(key, static_cast<std::uint32_t>(i));
    video[i] = std::clamp(scale.per_octave * std::log2(total) + offset[i], 0.0,
                          static_cast<double>(scale.top));
  }
}

}  // namespace skerry::echo
