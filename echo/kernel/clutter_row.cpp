#include "echo/kernel/clutter_row.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

constexpr float kLeastClutter = 1e-7f;
constexpr std::size_t kCellBlock = 16;

inline __attribute__((always_inline)) std::int32_t nearest(float x) {
  const float y = x + 0.5f;
  const auto t = static_cast<std::int32_t>(y);
  return t - static_cast<std::int32_t>(static_cast<float>(t) > y);
}

inline __attribute__((always_inline)) std::uint32_t place(const FieldWalk& w, float s,
                                                          std::uint32_t stride) {
  return w.origin + static_cast<std::uint32_t>(nearest(w.along + s * w.along_step)) +
         static_cast<std::uint32_t>(nearest(w.across + s * w.across_step)) * stride;
}

// Out of the four in its word.
inline __attribute__((always_inline)) float packed_value(const std::uint32_t* ring,
                                                         std::uint32_t at) {
  const std::uint32_t top = ring[at >> 2] << (24u - 8u * (at & 3u));
  return static_cast<float>(static_cast<std::int32_t>(top) >> 24);
}

SKERRY_KERNEL_BODY walk_body(const std::uint32_t* ring, std::uint32_t mask, std::uint32_t stride,
                             FieldWalk a, FieldWalk b, std::int32_t first, float* out,
                             std::size_t n) {
  const float weight_a = a.weight * kPackedStep, weight_b = b.weight * kPackedStep;
  for (std::size_t k = 0; k < n; ++k) {
    const auto s = static_cast<float>(first + static_cast<std::int32_t>(k));
    out[k] = weight_a * packed_value(ring, place(a, s, stride) & mask) +
             weight_b * packed_value(ring, place(b, s, stride) & mask);
  }
}
SKERRY_KERNEL(walk,
              (const std::uint32_t* __restrict ring, std::uint32_t mask, std::uint32_t stride,
               FieldWalk a, FieldWalk b, std::int32_t first, float* __restrict out, std::size_t n),
              (ring, mask, stride, a, b, first, out, n))

struct Mix {
  const float *first, *second, *apart2, *spread;
  float share, decay, spread_share;
};

// 1 / sqrt(1 - u) for u in [0, 1/2], minimax; relative error 7.5e-5.
inline __attribute__((always_inline)) float inverse_root(float u) {
  return 1.00007401f +
         u * (0.492999615f + u * (0.478027765f + u * (-0.190692109f + u * 1.14983425f)));
}

SKERRY_KERNEL_BODY texture_body(Mix m, const RankLaw* laws, float* out, std::size_t n) {
  const float rest = 1.0f - m.share;
  const float loss = 2.0f * m.share * rest;
  for (std::size_t begin = 0; begin < n; begin += kSamplesPerLaw) {
    const std::size_t end = begin + kSamplesPerLaw < n ? begin + kSamplesPerLaw : n;
    const RankLaw& law = *laws++;
    const float low = law.low, high = law.high, slope = law.slope, offset = law.offset;
    const float t0 = law.terms[0], t1 = law.terms[1], t2 = law.terms[2], t3 = law.terms[3];
    const float t4 = law.terms[4], t5 = law.terms[5], t6 = law.terms[6];
    for (std::size_t s = begin; s < end; ++s) {
      const float correlation = fast_exp2(-m.decay * m.apart2[s]);
      float x =
          (rest * m.first[s] + m.share * m.second[s]) * inverse_root(loss * (1.0f - correlation));
      x = x > low ? x : low;
      x = x < high ? x : high;
      const float t = slope * x + offset;
      const float sum = (((((t6 * t + t5) * t + t4) * t + t3) * t + t2) * t + t1) * t + t0;
      out[s] = sum + m.spread_share * m.spread[s];
    }
  }
}
SKERRY_KERNEL(texture,
              (Mix m, const RankLaw* __restrict laws, float* __restrict out, std::size_t n),
              (m, laws, out, n))

// cos(2 pi x): sin of a quarter turn less |x|, odd minimax of three terms.
inline __attribute__((always_inline)) float cosine_of_turns(float x) {
  const float r = x - static_cast<float>(nearest(x));
  const float u = 0.25f - (r < 0.0f ? -r : r);
  const float q = u * u;
  return u * (6.28128f + q * (-41.0953f + q * 73.5855f));
}

SKERRY_KERNEL_BODY wave_body(const WaveBlock* blocks, float phase, float step, std::int32_t first,
                             float* octaves, std::size_t n) {
  for (std::size_t begin = 0; begin < n; begin += kSamplesPerLaw) {
    const std::size_t end = begin + kSamplesPerLaw < n ? begin + kSamplesPerLaw : n;
    const WaveBlock b = *blocks++;
    const float begun = phase + b.lead;
    for (std::size_t s = begin; s < end; ++s) {
      const float x = begun + static_cast<float>(first + static_cast<std::int32_t>(s)) * step;
      octaves[s] += b.height * cosine_of_turns(x) - b.mean;
    }
  }
}
SKERRY_KERNEL(wave,
              (const WaveBlock* __restrict blocks, float phase, float step, std::int32_t first,
               float* __restrict octaves, std::size_t n),
              (blocks, phase, step, first, octaves, n))

inline __attribute__((always_inline)) float not_too_little(float x) {
  return x >= kLeastClutter ? x : 0.0f;
}

SKERRY_KERNEL_BODY lay_one_body(const float* octaves, const float* mean, float* row,
                                std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) row[i] = not_too_little(mean[i] * fast_exp2(octaves[i]));
}
SKERRY_KERNEL(lay_one,
              (const float* __restrict octaves, const float* __restrict mean, float* __restrict row,
               std::size_t n),
              (octaves, mean, row, n))

SKERRY_KERNEL_BODY raise_body(float* octaves, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) octaves[i] = fast_exp2(octaves[i]);
}
SKERRY_KERNEL(raise, (float* __restrict octaves, std::size_t n), (octaves, n))

template <std::size_t kCells>
inline __attribute__((always_inline)) void join(const float* samples, const float* mean, float* row,
                                                std::size_t n) {
  std::size_t s = 0, begin = 0;
  for (; begin + kCells <= n; begin += kCells, ++s) {
    const float from = samples[s];
    const float step = (samples[s + 1] - from) * (1.0f / static_cast<float>(kCells));
    for (std::size_t j = 0; j < kCells; ++j) {
      const float along = static_cast<float>(static_cast<std::int32_t>(j));
      row[begin + j] = not_too_little(mean[begin + j] * (from + along * step));
    }
  }
  const float step = (samples[s + 1] - samples[s]) * (1.0f / static_cast<float>(kCells));
  for (std::size_t i = begin; i < n; ++i) {
    const float along = static_cast<float>(static_cast<std::int32_t>(i - begin));
    row[i] = not_too_little(mean[i] * (samples[s] + along * step));
  }
}

SKERRY_KERNEL_BODY lay_more_body(const float* samples, std::uint32_t cells, const float* mean,
                                 float* row, std::size_t n) {
  switch (cells) {
    case 2:
      return join<2>(samples, mean, row, n);
    case 4:
      return join<4>(samples, mean, row, n);
    case 8:
      return join<8>(samples, mean, row, n);
    default:
      return join<16>(samples, mean, row, n);
  }
}
SKERRY_KERNEL(lay_more,
              (const float* __restrict samples, std::uint32_t cells, const float* __restrict mean,
               float* __restrict row, std::size_t n),
              (samples, cells, mean, row, n))

// A whole block of cells of which begin .. end - 1 are meant.
inline __attribute__((always_inline)) void speckled_part(const float* __restrict first,
                                                         const float* __restrict second,
                                                         float share,
                                                         const PackedPower* __restrict speckle,
                                                         float* __restrict power,
                                                         std::int32_t begin, std::int32_t end) {
  for (std::int32_t j = 0; j < static_cast<std::int32_t>(kCellBlock); ++j) {
    const float more = (first[j] + share * (second[j] - first[j])) * unpacked_value(speckle[j]);
    power[j] += j >= begin && j < end ? more : 0.0f;
  }
}

// Works in whole blocks from a line's beginning, and cell by cell in the last, partial one.
SKERRY_KERNEL_BODY speckled_body(const float* __restrict first, const float* __restrict second,
                                 float share, const PackedPower* __restrict speckle,
                                 float* __restrict power, std::size_t begin, std::size_t end,
                                 std::size_t n) {
  const std::size_t whole = n / kCellBlock * kCellBlock;
  std::size_t i = begin / kCellBlock * kCellBlock;
  if (i < begin && i < whole) {
    const std::size_t last = end - i < kCellBlock ? end - i : kCellBlock;
    speckled_part(first + i, second + i, share, speckle + i, power + i,
                  static_cast<std::int32_t>(begin - i), static_cast<std::int32_t>(last));
    i += kCellBlock;
  }
  const std::size_t inner = end / kCellBlock * kCellBlock;
  if (i < inner) {
    for (std::size_t c = i; c < inner; ++c)
      power[c] += (first[c] + share * (second[c] - first[c])) * unpacked_value(speckle[c]);
    i = inner;
  }
  if (i >= end) return;
  if (i < whole) {
    speckled_part(first + i, second + i, share, speckle + i, power + i, 0,
                  static_cast<std::int32_t>(end - i));
    return;
  }
  for (std::size_t c = i > begin ? i : begin; c < end; ++c)
    power[c] += (first[c] + share * (second[c] - first[c])) * unpacked_value(speckle[c]);
}
SKERRY_NARROW_KERNEL(speckled,
                     (const float* __restrict first, const float* __restrict second, float share,
                      const PackedPower* __restrict speckle, float* __restrict power,
                      std::size_t begin, std::size_t end, std::size_t n),
                     (first, second, share, speckle, power, begin, end, n))

}  // namespace

std::vector<std::uint32_t> packed_ring(std::span<const float> values) {
  std::vector<std::uint32_t> ring(values.size() / 4, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float steps = std::clamp(values[i] / kPackedStep, -127.0f, 127.0f);
    const auto whole = static_cast<std::int32_t>(std::floor(steps + 0.5f));
    ring[i / 4] |= (static_cast<std::uint32_t>(whole) & 0xFFu) << (8 * (i % 4));
  }
  return ring;
}

void walk_field(std::span<const std::uint32_t> ring, std::uint32_t stride, const FieldWalk& a,
                const FieldWalk& b, std::uint32_t first, std::span<float> out) noexcept {
  walk(ring.data(), static_cast<std::uint32_t>(4 * ring.size() - 1), stride, a, b,
       static_cast<std::int32_t>(first), out.data(), out.size());
}

void walk_field_reference(std::span<const float> ring, std::uint32_t stride, const FieldWalk& a,
                          const FieldWalk& b, std::span<double> out) {
  const auto value = [&](const FieldWalk& w, double s) {
    const auto u = static_cast<std::int64_t>(std::floor(w.along + s * w.along_step + 0.5));
    const auto v = static_cast<std::int64_t>(std::floor(w.across + s * w.across_step + 0.5));
    const std::uint64_t at = w.origin + static_cast<std::uint64_t>(u + v * std::int64_t{stride});
    return double{w.weight} * ring[at % ring.size()];
  };
  for (std::size_t s = 0; s < out.size(); ++s) {
    out[s] = value(a, static_cast<double>(s)) + value(b, static_cast<double>(s));
  }
}

void texture_octaves(const TextureMix& mix, std::span<const RankLaw> laws,
                     std::span<float> octaves) noexcept {
  texture(
      {
          mix.first.data(),
          mix.second.data(),
          mix.apart2.data(),
          mix.spread.data(),
          mix.share,
          mix.decay,
          mix.spread_share,
      },
      laws.data(), octaves.data(), octaves.size());
}

void texture_octaves_reference(const TextureMix& mix, std::span<const RankLaw> laws,
                               std::span<double> octaves) {
  const double share = mix.share, rest = 1.0 - share;
  for (std::size_t s = 0; s < octaves.size(); ++s) {
    const RankLaw& law = laws[s / kSamplesPerLaw];
    const double correlation = std::exp2(-double{mix.decay} * mix.apart2[s]);
    const double x = (rest * mix.first[s] + share * mix.second[s]) /
                     std::sqrt(1.0 - 2.0 * share * rest * (1.0 - correlation));
    const double t = law.slope * std::clamp(x, double{law.low}, double{law.high}) + law.offset;
    double sum = 0.0;
    for (std::size_t k = law.terms.size(); k-- > 0;) sum = sum * t + law.terms[k];
    octaves[s] = sum + double{mix.spread_share} * mix.spread[s];
  }
}

void add_wave(std::span<const WaveBlock> blocks, float phase, float step, std::uint32_t first,
              std::span<float> octaves) noexcept {
  wave(blocks.data(), phase, step, static_cast<std::int32_t>(first), octaves.data(),
       octaves.size());
}

void add_wave_reference(std::span<const WaveBlock> blocks, double phase, double step,
                        std::span<double> octaves) {
  for (std::size_t s = 0; s < octaves.size(); ++s) {
    const WaveBlock& b = blocks[s / kSamplesPerLaw];
    octaves[s] +=
        b.height * std::cos(kRadiansPerTurn * (phase + b.lead + static_cast<double>(s) * step)) -
        b.mean;
  }
}

void lay_texture(std::span<float> octaves, std::uint32_t cells, std::span<const float> mean,
                 std::span<float> row) noexcept {
  if (cells == 1) return lay_one(octaves.data(), mean.data(), row.data(), row.size());
  raise(octaves.data(), row.size() / cells + 2);
  lay_more(octaves.data(), cells, mean.data(), row.data(), row.size());
}

void lay_texture_reference(std::span<const float> octaves, std::uint32_t cells,
                           std::span<const float> mean, std::span<double> row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double from = std::exp2(double{octaves[i / cells]});
    const double to = cells == 1 ? from : std::exp2(double{octaves[i / cells + 1]});
    const double value = mean[i] * (from + (to - from) * static_cast<double>(i % cells) / cells);
    row[i] = value >= double{kLeastClutter} ? value : 0.0;
  }
}

void add_speckled(std::span<const float> first, std::span<const float> second, float share,
                  std::span<const PackedPower> speckle, std::span<float> power, std::size_t begin,
                  std::size_t end) noexcept {
  if (begin >= end) return;
  speckled(first.data(), second.data(), share, speckle.data(), power.data(), begin, end,
           power.size());
}

}  // namespace skerry::echo
