#include "server/plotter/plots/row_kernels.hpp"

#include <algorithm>
#include <array>

#include "echo/kernel/isa.hpp"

namespace skerry::server {

// SKERRY_KERNEL asks for the instruction set by its own names.
using echo::active_isa;
using echo::Isa;

namespace {

SKERRY_KERNEL_BODY add_cells_body(const std::uint8_t* __restrict cells,
                                  std::uint16_t* __restrict sums, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + cells[i]);
}

template <std::uint32_t kJoined>
inline __attribute__((always_inline)) void add_means_of(const std::uint8_t* __restrict cells,
                                                        std::uint16_t* __restrict sums,
                                                        std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    std::uint16_t part = 0;
    for (std::size_t k = 0; k < kJoined; ++k)
      part = static_cast<std::uint16_t>(part + cells[i * kJoined + k]);
    sums[i] = static_cast<std::uint16_t>(sums[i] + part / kJoined);
  }
}

SKERRY_KERNEL_BODY add_joined_cells_body(const std::uint8_t* __restrict cells, std::uint32_t joined,
                                         std::uint16_t* __restrict sums,
                                         std::size_t count) noexcept {
  switch (joined) {
    case 1:
      return add_means_of<1>(cells, sums, count);
    case 2:
      return add_means_of<2>(cells, sums, count);
    case 3:
      return add_means_of<3>(cells, sums, count);
    case 4:
      return add_means_of<4>(cells, sums, count);
    case 5:
      return add_means_of<5>(cells, sums, count);
    case 6:
      return add_means_of<6>(cells, sums, count);
    case 7:
      return add_means_of<7>(cells, sums, count);
    default:
      return add_means_of<kMostJoined>(cells, sums, count);
  }
}

SKERRY_KERNEL_BODY scale_sums_body(const std::uint16_t* __restrict sums, std::uint32_t scale,
                                   std::uint8_t* __restrict levels, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i)
    levels[i] = static_cast<std::uint8_t>(std::min((sums[i] * scale) >> 16, 255u));
}

SKERRY_KERNEL_BODY measure_blocks_body(const std::uint8_t* __restrict levels, std::size_t blocks,
                                       std::int16_t* __restrict means,
                                       std::int16_t* __restrict deviations,
                                       std::uint8_t* __restrict greatest) noexcept {
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint8_t* cells = levels + b * kBlockCells;
    std::uint16_t sum = 0;
    std::uint8_t most = 0;
    for (std::size_t i = 0; i < kBlockCells; ++i) {
      sum = static_cast<std::uint16_t>(sum + cells[i]);
      most = std::max(most, cells[i]);
    }
    // 16 times a cell against the sum of 16; their differences sum to at most 16 * 4080.
    std::uint16_t off = 0;
    for (std::size_t i = 0; i < kBlockCells; ++i) {
      const auto cell = static_cast<std::uint16_t>(cells[i] * kBlockCells);
      off = static_cast<std::uint16_t>(off + (std::max(cell, sum) - std::min(cell, sum)));
    }
    means[b] = static_cast<std::int16_t>(sum);
    deviations[b] = static_cast<std::int16_t>(off / kBlockCells);
    greatest[b] = most;
  }
}

constexpr std::size_t kTile = 32;

static inline __attribute__((always_inline)) void order(std::int16_t* __restrict low,
                                                        std::int16_t* __restrict high) {
  for (std::size_t i = 0; i < kTile; ++i) {
    const std::int16_t a = low[i], b = high[i];
    low[i] = a < b ? a : b;
    high[i] = a < b ? b : a;
  }
}

// Of eight neighbours, the usual number: Batcher's merge sort in registers, of which the compiler
// leaves out what the wanted rank does not need.
template <std::size_t kRank>
inline __attribute__((always_inline)) void rank_eight(const std::int16_t* __restrict before,
                                                      const std::int16_t* __restrict after,
                                                      std::size_t blocks,
                                                      std::int16_t* __restrict ranked) {
  for (std::size_t b = 0; b < blocks; ++b) {
    std::int16_t v[8] = {before[b], before[b + 1], before[b + 2], before[b + 3],
                         after[b],  after[b + 1],  after[b + 2],  after[b + 3]};
    const auto order = [&v](std::size_t low, std::size_t high) {
      const std::int16_t x = v[low], y = v[high];
      v[low] = x < y ? x : y;
      v[high] = x < y ? y : x;
    };
    order(0, 1), order(2, 3), order(4, 5), order(6, 7);
    order(0, 2), order(1, 3), order(4, 6), order(5, 7);
    order(1, 2), order(5, 6);
    order(0, 4), order(1, 5), order(2, 6), order(3, 7);
    order(2, 4), order(3, 5);
    order(1, 2), order(3, 4), order(5, 6);
    ranked[b] = v[kRank];
  }
}

// A tile of blocks side by side, whose neighbours are sorted all at once by swaps of neighbours
// (odd-even transposition).
SKERRY_KERNEL_BODY rank_blocks_body(const std::int16_t* __restrict values, std::size_t blocks,
                                    std::size_t near, std::size_t far, std::size_t rank,
                                    std::int16_t* __restrict ranked) noexcept {
  if (far - near == 3) {
    const std::int16_t *before = values - far, *after = values + near;
    switch (rank) {
      case 0:
        return rank_eight<0>(before, after, blocks, ranked);
      case 1:
        return rank_eight<1>(before, after, blocks, ranked);
      case 2:
        return rank_eight<2>(before, after, blocks, ranked);
      case 3:
        return rank_eight<3>(before, after, blocks, ranked);
      case 4:
        return rank_eight<4>(before, after, blocks, ranked);
      case 5:
        return rank_eight<5>(before, after, blocks, ranked);
      case 6:
        return rank_eight<6>(before, after, blocks, ranked);
      default:
        return rank_eight<7>(before, after, blocks, ranked);
    }
  }
  alignas(64) std::array<std::array<std::int16_t, kTile>, kMostRanked> sorted;
  for (std::size_t first = 0; first < blocks; first += kTile) {
    const std::size_t size = std::min(kTile, blocks - first);
    std::size_t count = 0;
    const auto take = [&](const std::int16_t* from) {
      std::int16_t* to = sorted[count++].data();
      if (size == kTile) {
        for (std::size_t i = 0; i < kTile; ++i) to[i] = from[i];
      } else {
        for (std::size_t i = 0; i < kTile; ++i) to[i] = i < size ? from[i] : std::int16_t{0};
      }
    };
    for (std::size_t off = near; off <= far; ++off) {
      take(values + first - off);
      take(values + first + off);
    }
    for (std::size_t round = 0; round < count; ++round)
      for (std::size_t k = round % 2; k + 1 < count; k += 2)
        order(sorted[k].data(), sorted[k + 1].data());
    for (std::size_t i = 0; i < size; ++i) ranked[first + i] = sorted[rank][i];
  }
}

SKERRY_KERNEL_BODY add_spreads_body(const std::int16_t* __restrict uppers,
                                    const std::int16_t* __restrict means, std::int32_t share,
                                    std::size_t blocks,
                                    std::int16_t* __restrict deviations) noexcept {
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::int32_t deviation = deviations[b];
    const std::int32_t over = uppers[b] - means[b] - ((deviation * 5) >> 3);
    const std::int32_t spread = std::min(std::max(over, 0), 2 * deviation);
    deviations[b] =
        static_cast<std::int16_t>(std::min(deviation + ((spread * share) >> 8), 0x7fff));
  }
}

SKERRY_KERNEL_BODY set_block_thresholds_body(
    const std::int16_t* __restrict means, const std::int16_t* __restrict deviations,
    const std::uint8_t* __restrict greatest, std::size_t blocks, std::int32_t most,
    std::int32_t least, std::int32_t times, std::uint8_t* __restrict backgrounds,
    std::uint8_t* __restrict thresholds, std::uint8_t* __restrict over) noexcept {
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::int32_t background = std::min<std::int32_t>(means[b], most);
    const std::int32_t step = std::max(least, (deviations[b] * times) >> 8);
    const std::int32_t threshold = std::min((background + step) >> 4, 255);
    backgrounds[b] = static_cast<std::uint8_t>(background >> 4);
    thresholds[b] = static_cast<std::uint8_t>(threshold);
    over[b] = greatest[b] > threshold ? 1 : 0;
  }
}

}  // namespace

SKERRY_KERNEL(add_cells, (const std::uint8_t* cells, std::uint16_t* sums, std::size_t count),
              (cells, sums, count))

SKERRY_KERNEL(add_joined_cells,
              (const std::uint8_t* cells, std::uint32_t joined, std::uint16_t* sums,
               std::size_t count),
              (cells, joined, sums, count))

SKERRY_KERNEL(scale_sums,
              (const std::uint16_t* sums, std::uint32_t scale, std::uint8_t* levels,
               std::size_t count),
              (sums, scale, levels, count))

SKERRY_KERNEL(measure_blocks,
              (const std::uint8_t* levels, std::size_t blocks, std::int16_t* means,
               std::int16_t* deviations, std::uint8_t* greatest),
              (levels, blocks, means, deviations, greatest))

SKERRY_KERNEL(rank_blocks,
              (const std::int16_t* values, std::size_t blocks, std::size_t near, std::size_t far,
               std::size_t rank, std::int16_t* ranked),
              (values, blocks, near, far, rank, ranked))

SKERRY_KERNEL(add_spreads,
              (const std::int16_t* uppers, const std::int16_t* means, std::int32_t share,
               std::size_t blocks, std::int16_t* deviations),
              (uppers, means, share, blocks, deviations))

SKERRY_KERNEL(set_block_thresholds,
              (const std::int16_t* means, const std::int16_t* deviations,
               const std::uint8_t* greatest, std::size_t blocks, std::int32_t most,
               std::int32_t least, std::int32_t times, std::uint8_t* backgrounds,
               std::uint8_t* thresholds, std::uint8_t* over),
              (means, deviations, greatest, blocks, most, least, times, backgrounds, thresholds,
               over))

}  // namespace skerry::server
