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

// Batcher's merge sort of eight, the usual number: 19 steps instead of 28.
constexpr std::array<std::array<std::uint8_t, 2>, 19> kOrderOfEight{{{0, 1},
                                                                     {2, 3},
                                                                     {4, 5},
                                                                     {6, 7},
                                                                     {0, 2},
                                                                     {1, 3},
                                                                     {4, 6},
                                                                     {5, 7},
                                                                     {1, 2},
                                                                     {5, 6},
                                                                     {0, 4},
                                                                     {1, 5},
                                                                     {2, 6},
                                                                     {3, 7},
                                                                     {2, 4},
                                                                     {3, 5},
                                                                     {1, 2},
                                                                     {3, 4},
                                                                     {5, 6}}};

// A tile of blocks side by side, whose neighbours are sorted all at once by swaps of neighbours
// (odd-even transposition).
SKERRY_KERNEL_BODY rank_blocks_body(const std::int16_t* __restrict values, std::size_t blocks,
                                    std::size_t near, std::size_t far, std::size_t rank,
                                    std::int16_t* __restrict ranked) noexcept {
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
    if (count == 8) {
      for (const auto& [low, high] : kOrderOfEight) order(sorted[low].data(), sorted[high].data());
    } else {
      for (std::size_t round = 0; round < count; ++round)
        for (std::size_t k = round % 2; k + 1 < count; k += 2)
          order(sorted[k].data(), sorted[k + 1].data());
    }
    for (std::size_t i = 0; i < size; ++i) ranked[first + i] = sorted[rank][i];
  }
}

}  // namespace

SKERRY_KERNEL(add_cells, (const std::uint8_t* cells, std::uint16_t* sums, std::size_t count),
              (cells, sums, count))

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

}  // namespace skerry::server
