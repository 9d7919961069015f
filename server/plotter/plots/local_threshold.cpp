#include "server/plotter/plots/local_threshold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace skerry::server {
namespace {

constexpr std::uint32_t kFine = 16;  // means and deviations are in 16ths of a level

void require(bool right, std::string_view name, std::string_view range) {
  if (!right) throw std::invalid_argument(fmt::format("{}: must be {}", name, range));
}

// The rank, from 0, of so many values.
std::size_t rank_of(double share, std::size_t count) {
  return static_cast<std::size_t>(share * static_cast<double>(count - 1) + 0.5);
}

// A block of less than kBlockCells cells.
void measure_rest(std::span<const std::uint8_t> cells, std::int16_t& mean, std::int16_t& deviation,
                  std::uint8_t& greatest) {
  const auto count = static_cast<std::uint32_t>(cells.size());
  std::uint32_t sum = 0, off = 0;
  greatest = 0;
  for (const std::uint8_t cell : cells) {
    sum += cell;
    greatest = std::max(greatest, cell);
  }
  for (const std::uint8_t cell : cells)
    off += std::max(cell * count, sum) - std::min(cell * count, sum);
  mean = static_cast<std::int16_t>(sum * kFine / count);
  deviation = static_cast<std::int16_t>(off * kFine / (count * count));
}

// Bit i is set where cells[i] > threshold; of up to a block's.
std::uint32_t cells_above(const std::uint8_t* cells, std::size_t count, std::uint8_t threshold) {
  std::uint32_t above = 0;
  if (count == kBlockCells) {
    for (std::size_t i = 0; i < kBlockCells; ++i) above |= (cells[i] > threshold ? 1u : 0u) << i;
  } else {
    for (std::size_t i = 0; i < count; ++i) above |= (cells[i] > threshold ? 1u : 0u) << i;
  }
  return above;
}

}  // namespace

LocalThreshold::LocalThreshold(const Rule& rule) : rule_(rule) {
  require(rule.statistic <= Statistic::smallest_of, "statistic", "one of the four");
  require(rule.around >= 1 && rule.around <= kMostAround, "around", "1 to 8 blocks");
  require(rule.guard < rule.around, "guard", "less than around");
  require(rule.rank >= 0.0 && rule.rank <= 1.0, "rank", "0 to 1");
  require(rule.roughnesses >= 0.0 && rule.roughnesses <= 100.0, "roughnesses", "0 to 100");
  require(rule.spreads >= 0.0 && rule.spreads <= 20.0, "spreads", "0 to 20");
  require(rule.least_step >= 1, "least_step", "at least 1 level");
}

void LocalThreshold::measure(std::span<const std::uint8_t> levels) {
  const std::size_t full = levels.size() / kBlock;
  blocks_ = (levels.size() + kBlock - 1) / kBlock;
  means_.values.resize(blocks_ + 2 * kMostAround);
  deviations_.values.resize(blocks_ + 2 * kMostAround);
  greatest_.resize(blocks_);
  measure_blocks(levels.data(), full, means_.blocks(), deviations_.blocks(), greatest_.data());
  if (full < blocks_)
    measure_rest(levels.subspan(full * kBlock), means_.blocks()[full], deviations_.blocks()[full],
                 greatest_[full]);
}

void LocalThreshold::rank_all(Padded& of, double share, std::vector<std::int16_t>& into) {
  const std::size_t side = rule_.around - rule_.guard, all = 2 * side;
  const std::size_t rank = rank_of(share, all);
  std::int16_t* values = of.blocks();
  if (blocks_ > 2 * rule_.around) {
    // Beyond the ends stand the smallest and the greatest of values, so many of each that the rank
    // among all of them is the wanted one among those there are.
    std::size_t low = 0;
    for (std::size_t missing = 1; missing <= rule_.around; ++missing) {
      std::int16_t pad = 0;
      if (missing <= side) {
        const std::size_t lows = rank - rank_of(share, all - missing);
        pad = lows > low ? 0 : 0x7fff;
        low = lows;
      } else {  // of the guard: each block beyond misses one more of the far ones instead
        pad = values[-static_cast<std::ptrdiff_t>(missing - side)];
      }
      values[-static_cast<std::ptrdiff_t>(missing)] = pad;
      values[blocks_ + missing - 1] = pad;
    }
    rank_blocks(values, blocks_, rule_.guard + 1, rule_.around, rank, into.data());
    return;
  }
  for (std::size_t b = 0; b < blocks_; ++b) {
    std::array<std::int16_t, 2 * kMostAround> near;
    std::size_t count = 0;
    for (std::size_t i = 0; i < blocks_; ++i) {
      const std::size_t off = i > b ? i - b : b - i;
      if (off > rule_.guard && off <= rule_.around) near[count++] = values[i];
    }
    std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count));
    into[b] = count > 0 ? near[rank_of(share, count)] : std::int16_t{0};
  }
}

void LocalThreshold::average_all(Padded& of, std::vector<std::int16_t>& into) {
  const std::int16_t* values = of.blocks();
  sums_.resize(blocks_ + 1);
  sums_[0] = 0;
  for (std::size_t b = 0; b < blocks_; ++b)
    sums_[b + 1] = sums_[b] + static_cast<std::uint32_t>(values[b]);
  for (std::size_t b = 0; b < blocks_; ++b) {
    const std::size_t from = b > rule_.around ? b - rule_.around : 0;
    const std::size_t to = b > rule_.guard ? b - rule_.guard : 0;
    const std::size_t next = std::min(blocks_, b + rule_.guard + 1);
    const std::size_t end = std::min(blocks_, b + rule_.around + 1);
    const std::uint32_t sum_before = sums_[to] - sums_[from], sum_after = sums_[end] - sums_[next];
    const auto before = static_cast<std::uint32_t>(to - from);
    const auto after = static_cast<std::uint32_t>(end - next);
    std::uint32_t mean = 0;
    if (before == 0 || after == 0 || rule_.statistic == Statistic::cell_mean) {
      mean = before + after > 0 ? (sum_before + sum_after) / (before + after) : 0;
    } else {
      const std::uint32_t one = sum_before / before, other = sum_after / after;
      mean =
          rule_.statistic == Statistic::greatest_of ? std::max(one, other) : std::min(one, other);
    }
    into[b] = static_cast<std::int16_t>(mean);
  }
}

// Into the deviations, in such measure that `roughnesses` of them are `spreads` of it.
void LocalThreshold::add_spread() {
  upper_mean_.resize(blocks_);
  rank_all(means_, kUpperRank, upper_mean_);
  // At most 20 / .01 * 256; a spread is at most twice a deviation, 2 * 2048: below 2^31.
  const auto share =
      static_cast<std::int32_t>(rule_.spreads / std::max(rule_.roughnesses, 0.01) * 256.0 + 0.5);
  // Less what means of noise differ by; and of land on one side no more than clutter has.
  add_spreads(upper_mean_.data(), mean_around_.data(), share, blocks_, deviation_around_.data());
}

void LocalThreshold::set_thresholds() {
  mean_around_.resize(blocks_);
  deviation_around_.resize(blocks_);
  backgrounds_.resize(blocks_);
  thresholds_.resize(blocks_);
  over_.resize(blocks_);
  if (rule_.statistic == Statistic::ordered) {
    rank_all(means_, rule_.rank, mean_around_);
    rank_all(deviations_, rule_.rank, deviation_around_);
    if (rule_.spreads > 0.0) add_spread();
  } else {
    average_all(means_, mean_around_);
    average_all(deviations_, deviation_around_);
  }
  // A deviation is at most 2^15, with 100 roughnesses 8.4e8: below 2^31.
  set_block_thresholds(mean_around_.data(), deviation_around_.data(), greatest_.data(), blocks_,
                       static_cast<std::int32_t>(rule_.most_background * kFine),
                       static_cast<std::int32_t>(rule_.least_step * kFine),
                       static_cast<std::int32_t>(rule_.roughnesses * 256.0 + 0.5),
                       backgrounds_.data(), thresholds_.data(), over_.data());
}

void LocalThreshold::find(std::span<const std::uint8_t> levels, std::vector<Run>& out) {
  measure(levels);
  set_thresholds();
  std::size_t before = 0;  // the block after the last one with a run
  bool open = false;
  for (std::size_t b = 0; b < blocks_; ++b) {
    std::uint64_t eight = 0;
    if (b + sizeof eight <= blocks_) {
      std::memcpy(&eight, &over_[b], sizeof eight);
      if (eight == 0) {  // nearly all
        b += sizeof eight - 1;
        continue;
      }
    }
    if (over_[b] == 0) continue;
    open = open && b == before;
    before = b + 1;
    const std::size_t first = b * kBlock;
    const std::size_t count = std::min<std::size_t>(kBlock, levels.size() - first);
    // Cells above it, as bits: where these change, a run begins or ends.
    const std::uint32_t above = cells_above(levels.data() + first, count, thresholds_[b]);
    std::uint32_t changes = above ^ (above << 1 | (open ? 1u : 0u));
    changes &= (1u << count) - 1;
    for (; changes != 0; changes &= changes - 1) {
      const auto at =
          static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(changes));
      if (open) {
        out.back().end = at;
      } else {
        out.push_back({at, at});
      }
      open = !open;
    }
    if (open) out.back().end = static_cast<std::uint32_t>(first + count);
  }
}

}  // namespace skerry::server
