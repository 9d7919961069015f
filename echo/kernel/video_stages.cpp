#include "echo/kernel/video_stages.hpp"

#include <algorithm>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

inline __attribute__((always_inline)) std::uint8_t mean_up(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}
// Rounded down, through the complement: processors round such means up only.
inline __attribute__((always_inline)) std::uint8_t mean_down(std::uint8_t a, std::uint8_t b) {
  const auto not_a = static_cast<std::uint8_t>(~a), not_b = static_cast<std::uint8_t>(~b);
  return static_cast<std::uint8_t>(~mean_up(not_a, not_b));
}

SKERRY_KERNEL_BODY mean_of_two_body(const std::uint8_t* a, std::size_t shift,
                                    std::uint8_t* __restrict out, std::size_t n) {
  const std::uint8_t* b = a - shift;
  for (std::size_t i = 0; i < n; ++i) out[i] = mean_up(a[i], b[i]);
}
SKERRY_NARROW_KERNEL(mean_of_two,
                     (const std::uint8_t* a, std::size_t shift, std::uint8_t* __restrict out,
                      std::size_t n),
                     (a, shift, out, n))

// Two steps of doubling at once.
SKERRY_KERNEL_BODY mean_of_four_body(const std::uint8_t* a, std::size_t shift,
                                     std::uint8_t* __restrict out, std::size_t n) {
  const std::uint8_t *b = a - shift, *c = b - shift, *d = c - shift;
  for (std::size_t i = 0; i < n; ++i) out[i] = mean_down(mean_up(a[i], b[i]), mean_up(c[i], d[i]));
}
SKERRY_NARROW_KERNEL(mean_of_four,
                     (const std::uint8_t* a, std::size_t shift, std::uint8_t* __restrict out,
                      std::size_t n),
                     (a, shift, out, n))

inline __attribute__((always_inline)) std::uint8_t less_share(std::uint8_t video, std::uint8_t mean,
                                                              std::uint16_t weight) {
  const auto product = static_cast<std::uint16_t>(mean * weight + 128);
  const auto share = static_cast<std::uint8_t>(product >> 8);
  const std::uint8_t most = video > share ? video : share;
  return static_cast<std::uint8_t>(most - share);
}

SKERRY_KERNEL_BODY take_share_body(std::uint8_t* __restrict video, const std::uint8_t* mean,
                                   std::uint16_t weight, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) video[i] = less_share(video[i], mean[i], weight);
}
SKERRY_NARROW_KERNEL(take_share,
                     (std::uint8_t* __restrict video, const std::uint8_t* mean,
                      std::uint16_t weight, std::size_t n),
                     (video, mean, weight, n))

// The last doubling and the share of it.
SKERRY_KERNEL_BODY take_share_of_two_body(std::uint8_t* __restrict video, const std::uint8_t* a,
                                          std::size_t shift, std::uint16_t weight, std::size_t n) {
  const std::uint8_t* b = a - shift;
  for (std::size_t i = 0; i < n; ++i) video[i] = less_share(video[i], mean_up(a[i], b[i]), weight);
}
SKERRY_NARROW_KERNEL(take_share_of_two,
                     (std::uint8_t* __restrict video, const std::uint8_t* a, std::size_t shift,
                      std::uint16_t weight, std::size_t n),
                     (video, a, shift, weight, n))

template <int kReach>
inline __attribute__((always_inline)) void largest_within(const std::uint8_t* row,
                                                          std::uint8_t* __restrict out,
                                                          std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    std::uint8_t largest = row[i];
    for (int k = 1; k <= kReach; ++k) {
      const std::uint8_t before = (row - k)[i], after = (row + k)[i];
      largest = largest > before ? largest : before;
      largest = largest > after ? largest : after;
    }
    out[i] = largest;
  }
}
#define SKERRY_LARGEST_KERNEL(name, reach)                                              \
  SKERRY_KERNEL_BODY name##_body(const std::uint8_t* row, std::uint8_t* __restrict out, \
                                 std::size_t n) {                                       \
    largest_within<reach>(row, out, n);                                                 \
  }                                                                                     \
  SKERRY_NARROW_KERNEL(                                                                 \
      name, (const std::uint8_t* row, std::uint8_t* __restrict out, std::size_t n), (row, out, n))
SKERRY_LARGEST_KERNEL(largest_within_1, 1)
SKERRY_LARGEST_KERNEL(largest_within_2, 2)
SKERRY_LARGEST_KERNEL(largest_within_3, 3)
#undef SKERRY_LARGEST_KERNEL

SKERRY_KERNEL_BODY grow_body(std::uint8_t* __restrict video, const std::uint8_t* a,
                             const std::uint8_t* b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t ab = a[i] > b[i] ? a[i] : b[i];
    video[i] = video[i] > ab ? video[i] : ab;
  }
}
SKERRY_KERNEL(grow,
              (std::uint8_t* __restrict video, const std::uint8_t* a, const std::uint8_t* b,
               std::size_t n),
              (video, a, b, n))

// out[i] = the mean of rows[0][i] .. rows[2 reach][i], the middle one reach + 1 times, each beside
// it once less; `out` may be one of them.  Rounded: `inverse` is 2^20 / (reach + 1)^2.
inline __attribute__((always_inline)) void triangle_of(const std::uint8_t* const* rows,
                                                       std::size_t reach, std::uint32_t inverse,
                                                       std::uint8_t* out, std::size_t begin,
                                                       std::size_t n) {
  std::uint16_t sum[64] = {};
  for (std::size_t k = 0; k <= 2 * reach; ++k) {
    const auto weight = static_cast<std::uint16_t>(k <= reach ? k + 1 : 2 * reach + 1 - k);
    const std::uint8_t* from = rows[k] + begin;
    for (std::size_t i = 0; i < n; ++i)
      sum[i] = static_cast<std::uint16_t>(sum[i] + weight * from[i]);
  }
  for (std::size_t i = 0; i < n; ++i)
    out[begin + i] = static_cast<std::uint8_t>((sum[i] * inverse + 0x80000u) >> 20);
}
SKERRY_KERNEL_BODY triangle_mean_body(const std::uint8_t* const* rows, std::size_t reach,
                                      std::uint32_t inverse, std::uint8_t* out, std::size_t n) {
  std::size_t begin = 0;
  for (; begin + 64 <= n; begin += 64) triangle_of(rows, reach, inverse, out, begin, 64);
  triangle_of(rows, reach, inverse, out, begin, n - begin);
}
SKERRY_KERNEL(triangle_mean,
              (const std::uint8_t* const* rows, std::size_t reach, std::uint32_t inverse,
               std::uint8_t* out, std::size_t n),
              (rows, reach, inverse, out, n))

SKERRY_KERNEL_BODY upper_half_body(std::uint8_t* video, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) video[i] = static_cast<std::uint8_t>(video[i] >> 4);
}
SKERRY_KERNEL(upper_half, (std::uint8_t * video, std::size_t n), (video, n))

// Never smaller again: what is grown is cleared, and stages of different needs take turns.
void make_room(std::vector<std::uint8_t>& scratch, std::size_t size) {
  if (scratch.size() < size) scratch.resize(size);
}

}  // namespace

// The first doubling, or the first two, of one spoke: nothing lies before its first cell.
void first_means(const std::uint8_t* video, unsigned doublings, std::uint8_t* out,
                 std::size_t cells) {
  if (doublings == 0) {
    std::copy_n(video, cells, out);
    return;
  }
  const std::size_t back = doublings == 2 ? 3 : 1;
  const auto at = [&](std::size_t i, std::size_t k) {
    return i < k ? std::uint8_t{0} : video[i - k];
  };
  for (std::size_t i = 0; i < std::min(back, cells); ++i) {
    const std::uint8_t first = mean_up(at(i, 0), at(i, 1));
    out[i] = doublings == 2 ? mean_down(first, mean_up(at(i, 2), at(i, 3))) : first;
  }
  if (cells <= back) return;
  const auto mean = doublings == 2 ? mean_of_four : mean_of_two;
  mean(video + back, 1, out + back, cells - back);
}

// All spokes lie in one row, each behind so many zeros that its first cells look back on them and
// never on the spoke before.
void differentiate_video(std::span<std::uint8_t> video, std::size_t cells, unsigned octaves,
                         unsigned weight, std::vector<std::uint8_t>& scratch) {
  if (weight == 0 || video.empty()) return;
  const std::size_t length = std::size_t{1} << octaves, pitch = length + cells;
  const std::size_t spokes = video.size() / cells, n = spokes * pitch;
  make_room(scratch, 2 * (length + n));
  std::uint8_t* mean = scratch.data() + length;
  std::uint8_t* next = mean + n + length;
  std::fill(mean - length, mean, std::uint8_t{0});
  std::fill(next - length, next, std::uint8_t{0});
  unsigned done = std::min(octaves, 2u);
  for (std::size_t s = 0; s < spokes; ++s) {
    std::uint8_t* row = std::fill_n(mean + s * pitch, length, std::uint8_t{0});
    first_means(video.data() + s * cells, done, row, cells);
  }
  for (; done + 2 <= octaves; done += 2) {
    mean_of_four(mean, std::size_t{1} << done, next, n);
    std::swap(mean, next);
  }
  for (std::size_t s = 0; s < spokes; ++s) {
    std::uint8_t* const row = video.data() + s * cells;
    const std::uint8_t* const before = mean + s * pitch + length - 1;
    if (done < octaves) {
      take_share_of_two(row, before, std::size_t{1} << done, static_cast<std::uint16_t>(weight),
                        cells);
    } else {
      take_share(row, before, static_cast<std::uint16_t>(weight), cells);
    }
  }
}

void stretch_video(std::span<std::uint8_t> video, std::size_t cells, unsigned reach,
                   std::vector<std::uint8_t>& scratch) {
  if (reach == 0) return;
  constexpr std::size_t kPad = kMaxStretch;  // zeros at both ends
  make_room(scratch, cells + 2 * kPad);
  std::uint8_t* row = scratch.data() + kPad;
  std::fill_n(scratch.data(), kPad, std::uint8_t{0});
  std::fill_n(row + cells, kPad, std::uint8_t{0});
  const auto widen = reach == 1   ? largest_within_1
                     : reach == 2 ? largest_within_2
                                  : largest_within_3;
  for (std::size_t s = 0; s < video.size(); s += cells) {
    std::copy_n(video.data() + s, cells, row);
    widen(row, video.data() + s, cells);
  }
}

void smooth_rows(std::span<const std::uint8_t* const> rows, std::span<std::uint8_t> out) noexcept {
  const auto reach = static_cast<std::uint32_t>(rows.size() / 2), all = (reach + 1) * (reach + 1);
  triangle_mean(rows.data(), reach, (0x100000u + all / 2) / all, out.data(), out.size());
}

void smooth_video(std::span<std::uint8_t> video, std::size_t cells, unsigned cells_together,
                  std::vector<std::uint8_t>& scratch) {
  if (cells_together <= 1) return;
  constexpr std::size_t kPad = kMostSmoothed;  // zeros at both ends
  const std::size_t reach = cells_together - 1;
  make_room(scratch, cells + 2 * kPad);
  std::uint8_t* row = scratch.data() + kPad;
  std::fill_n(scratch.data(), kPad, std::uint8_t{0});
  std::fill_n(row + cells, kPad, std::uint8_t{0});
  const std::uint8_t* rows[2 * kMostSmoothed - 1];
  for (std::size_t k = 0; k <= 2 * reach; ++k) rows[k] = row + k - reach;
  for (std::size_t s = 0; s < video.size(); s += cells) {
    const std::span<std::uint8_t> spoke = video.subspan(s, cells);
    std::copy(spoke.begin(), spoke.end(), row);
    smooth_rows({rows, 2 * reach + 1}, spoke);
  }
}

void keep_largest(std::span<std::uint8_t> video, std::span<const std::uint8_t> a,
                  std::span<const std::uint8_t> b) noexcept {
  grow(video.data(), a.data(), b.data(), video.size());
}

void halve_bits(std::span<std::uint8_t> video) noexcept { upper_half(video.data(), video.size()); }

void differentiate_video_reference(std::span<const std::uint8_t> video, unsigned octaves,
                                   unsigned weight, std::span<double> out) {
  const std::size_t length = std::size_t{1} << octaves;
  for (std::size_t i = 0; i < video.size(); ++i) {
    double sum = 0.0;
    for (std::size_t k = 1; k <= length && k <= i; ++k) sum += video[i - k];
    out[i] = std::max(0.0, video[i] - weight / 256.0 * sum / static_cast<double>(length));
  }
}

void stretch_video_reference(std::span<const std::uint8_t> video, unsigned reach,
                             std::span<std::uint8_t> out) {
  for (std::size_t i = 0; i < video.size(); ++i) {
    out[i] = 0;
    for (std::size_t k = i > reach ? i - reach : 0; k <= i + reach && k < video.size(); ++k)
      out[i] = std::max(out[i], video[k]);
  }
}

void smooth_video_reference(std::span<const std::uint8_t> video, unsigned cells_together,
                            std::span<double> out) {
  const auto n = static_cast<std::ptrdiff_t>(cells_together);
  const auto cells = static_cast<std::ptrdiff_t>(video.size());
  for (std::ptrdiff_t i = 0; i < cells; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, i - n + 1); k < std::min(cells, i + n); ++k)
      sum += static_cast<double>(n - std::abs(k - i)) * video[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(i)] = sum / static_cast<double>(n * n);
  }
}

}  // namespace skerry::echo
