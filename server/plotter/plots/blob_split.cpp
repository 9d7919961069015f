#include "server/plotter/plots/blob_split.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace skerry::server {
namespace {

using Cells = std::vector<BlobCell>;

constexpr std::size_t kMostParts = 8;

struct Valley {
  std::uint16_t at = 0;  // the first line of the farther part
  double depth = 1.0;    // its share of the lower peak
};

// The deepest valley of a profile, if it is deep enough.  `after` is memory to use.
std::optional<Valley> deepest(const std::vector<std::uint32_t>& profile, std::uint16_t first,
                              double most, std::vector<std::uint32_t>& after) {
  const std::size_t size = profile.size();
  if (size < 3) return std::nullopt;
  after.resize(size);  // the greatest from here on
  std::uint32_t greatest = 0;
  for (std::size_t i = size; i-- > 0;) after[i] = greatest = std::max(greatest, profile[i]);
  std::optional<Valley> best;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i + 1 < size; ++i) {
    const std::uint32_t lower = std::min(before, after[i + 1]);
    if (lower > profile[i]) {
      const double depth = static_cast<double>(profile[i]) / lower;
      if (depth < most && (!best || depth < best->depth))
        best = Valley{static_cast<std::uint16_t>(first + i), depth};
    }
    before = std::max(before, profile[i]);
  }
  return best;
}

std::optional<std::pair<Cells, Cells>> cut(const Cells& cells, double most, SplitScratch& scratch) {
  const std::uint16_t first_row = cells.front().row;  // they come by row
  std::uint16_t nearest = 0xffff, farthest = 0;
  for (const BlobCell& cell : cells) {
    nearest = std::min(nearest, cell.cell);
    farthest = std::max(farthest, cell.cell);
  }
  scratch.rows.assign(cells.back().row - first_row + 1u, 0);
  scratch.cells.assign(farthest - nearest + 1u, 0);
  for (const BlobCell& cell : cells) {
    scratch.rows[static_cast<std::size_t>(cell.row - first_row)] += cell.over;
    scratch.cells[static_cast<std::size_t>(cell.cell - nearest)] += cell.over;
  }
  const auto across = deepest(scratch.rows, first_row, most, scratch.after);
  const auto along = deepest(scratch.cells, nearest, most, scratch.after);
  if (!across && !along) return std::nullopt;
  const bool by_row = across && (!along || across->depth <= along->depth);
  std::pair<Cells, Cells> parts;
  for (const BlobCell& cell : cells) {
    const bool nearer = by_row ? cell.row < across->at : cell.cell < along->at;
    (nearer ? parts.first : parts.second).push_back(cell);
  }
  return parts;
}

}  // namespace

std::vector<Cells> split(const Blob& blob, double valley, SplitScratch& scratch) {
  std::vector<Cells> parts;
  if (blob.extended) return parts;
  if (auto two = cut(blob.cells, valley, scratch)) {
    parts.push_back(std::move(two->first));
    parts.push_back(std::move(two->second));
  }
  for (std::size_t i = 0; i < parts.size() && parts.size() < kMostParts;) {
    auto two = cut(parts[i], valley, scratch);
    if (!two) {
      ++i;
      continue;
    }
    parts[i] = std::move(two->first);
    parts.push_back(std::move(two->second));
  }
  return parts;
}

}  // namespace skerry::server
