#include "echo/kernel/moved_row.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

inline __attribute__((always_inline)) PackedPower packed_of(float x, float least) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x < least ? 0.0f : x);
  return static_cast<PackedPower>((bits + 0x8000u) >> 16);
}

SKERRY_KERNEL_BODY pack_body(const float* __restrict power, std::size_t n, float least,
                             PackedPower* __restrict packed, float* __restrict peaks) {
  for (std::size_t i = 0; i < n; ++i) packed[i] = packed_of(power[i], least);
  for (std::size_t b = 0; b * kPackBlock < n; ++b) {
    const float* block = power + b * kPackBlock;
    float peak = 0.0f;
    if ((b + 1) * kPackBlock <= n) {
      float lanes[4] = {};
      for (std::size_t k = 0; k < kPackBlock; k += 4) {
        for (std::size_t l = 0; l < 4; ++l)
          lanes[l] = lanes[l] < block[k + l] ? block[k + l] : lanes[l];
      }
      for (const float lane : lanes) peak = peak < lane ? lane : peak;
    } else {
      for (std::size_t k = 0; b * kPackBlock + k < n; ++k) peak = peak < block[k] ? block[k] : peak;
    }
    peaks[b] = peak;
  }
}
SKERRY_KERNEL(pack,
              (const float* __restrict power, std::size_t n, float least,
               PackedPower* __restrict packed, float* __restrict peaks),
              (power, n, least, packed, peaks))

inline __attribute__((always_inline)) float moved(const PackedPower* row, const RowShift& s,
                                                  std::int32_t i) {
  const float gain = s.gain + s.gain_step * static_cast<float>(i);
  return (s.near_weight * unpacked_value(row[i]) + s.far_weight * unpacked_value(row[i + 1])) *
         gain;
}

// Cell i of a block where it counts, else 0.
inline __attribute__((always_inline)) float if_counted(float value, std::int32_t i,
                                                       std::int32_t count) {
  // All ones where it counts: a branch here would keep the loop from the vector units.
  const auto counts = static_cast<std::uint32_t>((i - count) >> 31);
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & counts);
}

constexpr std::int32_t kRunLanes = 16;
static_assert(kRunLanes <= static_cast<std::int32_t>(kRowPadding));

// Parts of rows are short: whole blocks, of which what does not count adds nothing, save the
// last cells of all, one by one.
SKERRY_KERNEL_BODY add_mean_body(const MovedRun* __restrict runs, std::size_t run_count,
                                 float* __restrict all, std::int32_t room) {
  for (std::size_t r = 0; r < run_count; ++r) {
    const RowShift s = runs[r].shift;
    const PackedPower* __restrict row = runs[r].row;
    const auto first = static_cast<std::int32_t>(runs[r].first);
    const auto count = static_cast<std::int32_t>(runs[r].count);
    std::int32_t i = 0;
    for (; i < count && first + i + kRunLanes <= room; i += kRunLanes) {
      float sum[kRunLanes];
      for (std::int32_t k = 0; k < kRunLanes; ++k) {
        sum[k] = all[first + i + k] + if_counted(moved(row, s, i + k), i + k, count);
      }
      std::memcpy(all + first + i, sum, sizeof(sum));
    }
    for (; i < count; ++i) all[first + i] += moved(row, s, i);
  }
}
SKERRY_NARROW_KERNEL(add_mean,
                     (const MovedRun* __restrict runs, std::size_t run_count,
                      float* __restrict power, std::int32_t room),
                     (runs, run_count, power, room))

// Over a row of zeros; whole blocks, and in the last of a run zeros behind it.
SKERRY_KERNEL_BODY lay_runs_body(const MovedRun* __restrict runs, std::size_t run_count,
                                 const PackedPower* __restrict speckle, float share,
                                 float* __restrict power, std::size_t cells) {
  for (std::size_t i = 0; i < cells; ++i) power[i] = 0.0f;
  const float steady = 1.0f - share;
  for (std::size_t r = 0; r < run_count; ++r) {
    const RowShift s = runs[r].shift;
    const PackedPower* __restrict row = runs[r].row;
    const PackedPower* __restrict from = speckle + runs[r].first;
    float* __restrict to = power + runs[r].first;
    const auto count = static_cast<std::int32_t>(runs[r].count);
    const std::int32_t whole = count / kRunLanes * kRunLanes;
    for (std::int32_t i = 0; i < whole; ++i)
      to[i] = moved(row, s, i) * (steady + share * unpacked_value(from[i]));
    if (whole == count) continue;
    for (std::int32_t i = whole; i < whole + kRunLanes; ++i)
      to[i] = if_counted(moved(row, s, i) * (steady + share * unpacked_value(from[i])), i, count);
  }
}
SKERRY_NARROW_KERNEL(lay_runs,
                     (const MovedRun* __restrict runs, std::size_t run_count,
                      const PackedPower* __restrict speckle, float share, float* __restrict power,
                      std::size_t cells),
                     (runs, run_count, speckle, share, power, cells))

SKERRY_KERNEL_BODY lay_runs_twice_body(const MovedRun* __restrict runs, std::size_t run_count,
                                       const PackedPower* __restrict speckle_a,
                                       const PackedPower* __restrict speckle_b, float share,
                                       float* __restrict a, float* __restrict b,
                                       std::size_t cells) {
  for (std::size_t i = 0; i < cells; ++i) a[i] = b[i] = 0.0f;
  const float steady = 1.0f - share;
  for (std::size_t r = 0; r < run_count; ++r) {
    const RowShift s = runs[r].shift;
    const PackedPower* __restrict row = runs[r].row;
    const std::size_t first = runs[r].first;
    const PackedPower* __restrict from_a = speckle_a + first;
    const PackedPower* __restrict from_b = speckle_b + first;
    float* __restrict to_a = a + first;
    float* __restrict to_b = b + first;
    const auto count = static_cast<std::int32_t>(runs[r].count);
    const std::int32_t whole = count / kRunLanes * kRunLanes;
    for (std::int32_t i = 0; i < whole; ++i) {
      const float mean = moved(row, s, i);
      to_a[i] = mean * (steady + share * unpacked_value(from_a[i]));
      to_b[i] = mean * (steady + share * unpacked_value(from_b[i]));
    }
    if (whole == count) continue;
    for (std::int32_t i = whole; i < whole + kRunLanes; ++i) {
      const float mean = moved(row, s, i);
      to_a[i] = if_counted(mean * (steady + share * unpacked_value(from_a[i])), i, count);
      to_b[i] = if_counted(mean * (steady + share * unpacked_value(from_b[i])), i, count);
    }
  }
}
SKERRY_NARROW_KERNEL(lay_runs_twice,
                     (const MovedRun* __restrict runs, std::size_t run_count,
                      const PackedPower* __restrict speckle_a,
                      const PackedPower* __restrict speckle_b, float share, float* __restrict a,
                      float* __restrict b, std::size_t cells),
                     (runs, run_count, speckle_a, speckle_b, share, a, b, cells))

}  // namespace

void pack_power(std::span<const float> power, float least, std::span<PackedPower> packed,
                std::span<float> peaks) noexcept {
  pack(power.data(), power.size(), least, packed.data(), peaks.data());
}

void add_moved(std::span<const MovedRun> runs, std::span<float> power) noexcept {
  add_mean(runs.data(), runs.size(), power.data(), static_cast<std::int32_t>(power.size()));
}

void lay_moved(std::span<const MovedRun> runs, float share, const SpeckledRow& row) noexcept {
  lay_runs(runs.data(), runs.size(), row.speckle.data(), share, row.power.data(), row.power.size());
}

void lay_moved(std::span<const MovedRun> runs, float share, const SpeckledRow& a,
               const SpeckledRow& b) noexcept {
  lay_runs_twice(runs.data(), runs.size(), a.speckle.data(), b.speckle.data(), share,
                 a.power.data(), b.power.data(), a.power.size());
}

double unpacked_reference(PackedPower packed) {
  const int exponent = packed >> 7;
  const int mantissa = packed & 0x7F;
  return exponent == 0 ? 0.0 : std::ldexp(1.0 + mantissa / 128.0, exponent - 127);
}

void add_moved_reference(std::span<const MovedRun> runs, std::span<const float> speckle,
                         float share, std::span<double> power) {
  for (const MovedRun& run : runs) {
    const RowShift& shift = run.shift;
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const double gain = static_cast<double>(shift.gain) +
                          static_cast<double>(shift.gain_step) * static_cast<double>(i);
      double value = (static_cast<double>(shift.near_weight) * unpacked_reference(run.row[i]) +
                      static_cast<double>(shift.far_weight) * unpacked_reference(run.row[i + 1])) *
                     gain;
      if (!speckle.empty()) {
        value *= 1.0 - static_cast<double>(share) +
                 static_cast<double>(share) * static_cast<double>(speckle[run.first + i]);
      }
      power[run.first + i] += value;
    }
  }
}

}  // namespace skerry::echo
