// The loops over all cells of a row: sums of spokes, means and deviations of blocks, ranks among
// blocks.  Integers, so every instruction set gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skerry::server {

// Cells of a block of a row.
inline constexpr std::size_t kBlockCells = 16;
// Blocks among which a rank is taken, at most.
inline constexpr std::size_t kMostRanked = 16;

// sums[i] += cells[i].  The caller sees to it that no sum passes 65535.
void add_cells(const std::uint8_t* cells, std::uint16_t* sums, std::size_t count) noexcept;

// sums[i] += the mean, rounded down, of cells[i * joined .. (i + 1) * joined - 1].  Requires 1 <=
// joined <= kMostJoined; as for add_cells().
inline constexpr std::uint32_t kMostJoined = 8;
void add_joined_cells(const std::uint8_t* cells, std::uint32_t joined, std::uint16_t* sums,
                      std::size_t count) noexcept;

// levels[i] = sums[i] * scale / 65536, at most 255.  Requires sums[i] * scale < 2^32.
void scale_sums(const std::uint16_t* sums, std::uint32_t scale, std::uint8_t* levels,
                std::size_t count) noexcept;

// Of `blocks` blocks of kBlockCells cells: the mean, the mean deviation from it, both in 16ths of a
// level (the deviation rounded down), and the greatest cell.
void measure_blocks(const std::uint8_t* levels, std::size_t blocks, std::int16_t* means,
                    std::int16_t* deviations, std::uint8_t* greatest) noexcept;

// ranked[b] = the `rank`-th smallest (from 0) of values[b - far .. b - near] and
// values[b + near .. b + far], for b in [0, blocks).  Requires 1 <= near <= far, 2 * (far - near +
// 1) <= kMostRanked, rank among them, and values that reach so far beyond both ends.  Signed, since
// SSE2 has the lesser of such alone.
void rank_blocks(const std::int16_t* values, std::size_t blocks, std::size_t near, std::size_t far,
                 std::size_t rank, std::int16_t* ranked) noexcept;

// deviations[b] += spread * share / 256, at most 0x7fff, where spread = uppers[b] - means[b] -
// deviations[b] * 5 / 8, from 0 to 2 * deviations[b].  Requires no negative values, and spread *
// share < 2^31.
void add_spreads(const std::int16_t* uppers, const std::int16_t* means, std::int32_t share,
                 std::size_t blocks, std::int16_t* deviations) noexcept;

// thresholds[b] = (min(means[b], most) + max(deviations[b] * times / 256, least)) / 16, at most
// 255; backgrounds[b] = min(means[b], most) / 16; over[b] = 1 where greatest[b] is above the
// threshold, else 0.  Requires no negative means and deviations, and deviations[b] * times < 2^31.
void set_block_thresholds(const std::int16_t* means, const std::int16_t* deviations,
                          const std::uint8_t* greatest, std::size_t blocks, std::int32_t most,
                          std::int32_t least, std::int32_t times, std::uint8_t* backgrounds,
                          std::uint8_t* thresholds, std::uint8_t* over) noexcept;

}  // namespace skerry::server
