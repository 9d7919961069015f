#include "echo/kernel/land_chunk.hpp"

#include <cmath>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// `covered` is known where this is inlined: land without cover does not pay for it.
SKERRY_KERNEL_BODY chunk_part(const LandChunk* __restrict chunk, float* __restrict shadow,
                              LandChunkOut* __restrict out, const bool covered) {
  const LandChunk c = *chunk;
  constexpr auto kCells = static_cast<std::int32_t>(kLandChunk);
  float broad[kLandChunk], fine[kLandChunk], slope[kLandChunk];
  const std::int32_t step = 1 << c.coarse_shift, mask = step - 1;
  const float part = 1.0f / static_cast<float>(step);
  for (std::int32_t k = 0; k < kCells; ++k) {
    const std::int32_t at = k >> c.coarse_shift;
    const float t = static_cast<float>(k & mask) * part;
    broad[k] = c.broad[at] + t * (c.broad[at + 1] - c.broad[at]);
    fine[k] = c.fine[at] + t * (c.fine[at + 1] - c.fine[at]);
  }
  for (std::size_t o = 0; o < c.octave_count; ++o) {
    const OctavePath path = c.octaves[o];
    for (std::int32_t k = 0; k < kCells; ++k) fine[k] += octave_at(path, c.first + k);
  }
  for (std::int32_t k = 0; k < kCells; ++k) {
    const float along = c.cell * static_cast<float>(k);
    const float from_begin = c.from_begin + along, from_end = c.from_end - along;
    const float nearest = from_begin < from_end ? from_begin : from_end;
    const float height = natural_height(nearest > 0.0f ? nearest : 0.0f, broad[k], fine[k]);
    const float range = c.range + along;
    const float top = covered ? height + c.objects[k] : height;
    const float rise = (top - c.antenna) / range - range * c.half_curvature;
    out->height[k] = height;
    slope[k] = k >= c.begin && k < c.end ? rise : kHidesNothing;
  }
  float before = *shadow;
  for (std::int32_t k = 0; k < kCells; ++k) {
    out->shadow[k] = before;
    before = before < slope[k] ? slope[k] : before;
  }
  *shadow = before;
  for (std::int32_t k = 0; k < kCells; ++k) {
    const float range = c.range + c.cell * static_cast<float>(k);
    const float sea_range = range < c.horizon ? range : c.horizon;
    const float sea = -c.antenna / sea_range - sea_range * c.half_curvature;
    const float below = out->shadow[k] < sea ? sea : out->shadow[k];
    const float over = (slope[k] - below) * range;
    const float height = covered ? out->height[k] + c.objects[k] : out->height[k];
    const float gain = covered ? c.gain * c.gains[k] : c.gain;
    const float visible = over < height ? over : height;
    const float shown = visible > 0.0f ? visible : 0.0f;
    out->power[k] = gain * cover_of(fine[k]) * shown / (range * range * range);
  }
}
SKERRY_KERNEL_BODY chunk_body(const LandChunk* __restrict chunk, float* __restrict shadow,
                              LandChunkOut* __restrict out) {
  if (chunk->objects) {
    chunk_part(chunk, shadow, out, true);
  } else {
    chunk_part(chunk, shadow, out, false);
  }
}
SKERRY_KERNEL(chunk,
              (const LandChunk* __restrict chunk, float* __restrict shadow,
               LandChunkOut* __restrict out),
              (chunk, shadow, out))

}  // namespace

void make_land_chunk(const LandChunk& land, float& shadow, LandChunkOut& out) noexcept {
  chunk(&land, &shadow, &out);
}

void make_land_chunk_reference(const LandChunk& c, const double* broad, const double* fine,
                               double& shadow, double* height, double* power) {
  for (int k = c.begin; k < c.end; ++k) {
    const double along = static_cast<double>(c.cell) * k;
    const double inland = std::max(0.0, std::min(static_cast<double>(c.from_begin) + along,
                                                 static_cast<double>(c.from_end) - along));
    height[k] = natural_height(inland, broad[k], fine[k]);
    const double range = static_cast<double>(c.range) + along;
    const double antenna = static_cast<double>(c.antenna),
                 curve = static_cast<double>(c.half_curvature);
    const double top = height[k] + (c.objects ? static_cast<double>(c.objects[k]) : 0.0);
    const double slope = (top - antenna) / range - range * curve;
    const double sea_range = std::min(range, static_cast<double>(c.horizon));
    const double below = std::max(shadow, -antenna / sea_range - sea_range * curve);
    power[k] = 0.0;
    if (slope > below) {
      const double gain =
          static_cast<double>(c.gain) * (c.gains ? static_cast<double>(c.gains[k]) : 1.0);
      power[k] = gain * std::exp2(static_cast<double>(kCoverOctaves) * fine[k]) *
                 std::min(top, (slope - below) * range) / (range * range * range);
    }
    shadow = std::max(shadow, slope);
  }
}

}  // namespace skerry::echo
