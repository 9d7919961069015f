#include "echo/returns/packed_rows.hpp"

#include <algorithm>

namespace skerry::echo {
namespace {

constexpr std::int32_t kLineCells = 64 / sizeof(PackedPower);  // of a cache line

}  // namespace

void PackedRows::reset(std::uint32_t rows) {
  rows_.resize(rows);
  for (Row& row : rows_) {
    row.made = false;
    row.count = 0;
  }
  made_ = 0;
  block_ = used_ = 0;
}

void PackedRows::pack(std::uint32_t index, std::uint32_t first, std::span<const float> power,
                      std::vector<PackedPower>& cells) {
  Row& row = rows_[index];
  row.count = 0;
  cells.clear();
  if (power.empty()) return;
  thread_local std::vector<PackedPower> packed;
  thread_local std::vector<float> peaks;
  packed.resize(power.size());
  peaks.resize((power.size() + kPackBlock - 1) / kPackBlock);
  pack_power(power, kLeast, packed, peaks);
  const auto block_at = [&](std::size_t block) {
    return static_cast<std::uint16_t>(first + std::min(power.size(), block * kPackBlock));
  };
  for (std::size_t b = 0; b < peaks.size(); ++b) {
    if (peaks[b] < kLeast) continue;
    Stretch* last = row.count > 0 ? &row.stretches[row.count - 1u] : nullptr;
    if (last && (block_at(b) < last->last + kGap || row.count == Row::kMostStretches)) {
      last->last = block_at(b + 1);
    } else {
      row.stretches[row.count++] = {block_at(b), block_at(b + 1), 0};
    }
  }
  for (std::size_t i = 0; i < row.count; ++i) {
    Stretch& stretch = row.stretches[i];
    stretch.at = static_cast<std::uint32_t>(cells.size());
    cells.push_back(0);
    cells.insert(cells.end(), packed.begin() + (stretch.first - first),
                 packed.begin() + (stretch.last - first));
    cells.push_back(0);
  }
  if (row.count > 0) cells.insert(cells.end(), kRowPadding, 0);
}

void PackedRows::keep(std::uint32_t index, std::span<const PackedPower> cells) {
  Row& row = rows_[index];
  row.made = true;
  ++made_;
  PackedPower* kept = take(cells.size());
  std::copy(cells.begin(), cells.end(), kept);
  row.cells = kept;
}

PackedPower* PackedRows::take(std::size_t count) {
  if (used_ + count > kBlock) {
    ++block_;
    used_ = 0;
  }
  if (block_ == blocks_.size())
    blocks_.push_back(std::make_unique_for_overwrite<PackedPower[]>(kBlock));
  PackedPower* taken = blocks_[block_].get() + used_;
  used_ += count;
  return taken;
}

void PackedRows::find(const RowPart& part, std::vector<MovedRun>& runs) const {
  const Row& row = rows_[part.row];
  if (row.count == 0) return;
  const std::int32_t shift = whole_cells(part.shift);
  // Cell i reads the row's cells i + shift and the next.
  const std::int32_t from = static_cast<std::int32_t>(part.first) + shift;
  const std::int32_t to = static_cast<std::int32_t>(part.last) + shift;
  const auto moved = static_cast<float>(part.shift);
  const auto fraction = static_cast<float>(part.shift - static_cast<double>(shift));
  const auto gain_at = [&](std::int32_t cell) {
    const float ratio = 1.0f + moved / (static_cast<float>(cell) + 0.5f);
    return ratio > 0.0f ? ratio * ratio * ratio : 0.0f;
  };
  std::size_t s = 0;
  while (s < row.count && row.stretches[s].last <= from) ++s;
  for (; s < row.count && row.stretches[s].first <= to; ++s) {
    const Stretch& stretch = row.stretches[s];
    const std::int32_t begin = std::max(from, stretch.first - 1) - shift;
    const std::int32_t end = std::min<std::int32_t>(to, stretch.last) - shift;
    if (begin >= end) continue;
    const float gain = gain_at(begin);
    const float step = (gain_at(end) - gain) / static_cast<float>(end - begin);
    const PackedPower* cells =
        row.cells + stretch.at + static_cast<std::size_t>(begin + shift - stretch.first + 1);
    // A turn's rows are larger than the near caches: all lines of the stretch are fetched at once.
    for (std::int32_t i = 0; i <= end - begin; i += kLineCells) __builtin_prefetch(cells + i);
    runs.push_back({cells,
                    {1.0f - fraction, fraction, gain, step},
                    static_cast<std::uint32_t>(begin),
                    static_cast<std::uint32_t>(end - begin)});
  }
}

std::size_t PackedRows::bytes() const {
  return rows_.capacity() * sizeof(Row) + blocks_.size() * kBlock * sizeof(PackedPower);
}

}  // namespace skerry::echo
