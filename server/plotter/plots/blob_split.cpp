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

// The deepest valley of a profile, if it is deep enough.
std::optional<Valley> deepest(const std::vector<std::uint32_t>& profile, std::uint16_t first,
                              double most) {
  const std::size_t size = profile.size();
  std::vector<std::uint32_t> after(size);  // the greatest from here on
  std::uint32_t greatest = 0;
  for (std::size_t i = size; i-- > 0;) after[i] = greatest = std::max(greatest, profile[i]);
  std::optional<Valley> best;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i + 1 < size; ++i) {
    const std::uint32_t lower = std::min(before, after[i + 1]);
    if (lower > 0) {
      const double depth = static_cast<double>(profile[i]) / lower;
      if (depth < most && (!best || depth < best->depth))
        best = Valley{static_cast<std::uint16_t>(first + i), depth};
    }
    before = std::max(before, profile[i]);
  }
  return best;
}

template <typename Line>
std::optional<Valley> valley_of(const Cells& cells, Line&& line, double most) {
  std::uint16_t first = 0xffff, last = 0;
  for (const BlobCell& cell : cells) {
    first = std::min(first, line(cell));
    last = std::max(last, line(cell));
  }
  std::vector<std::uint32_t> profile(std::size_t{last} - first + 1);
  for (const BlobCell& cell : cells) profile[std::size_t{line(cell)} - first] += cell.over;
  return deepest(profile, first, most);
}

std::uint16_t row_of(const BlobCell& cell) { return cell.row; }
std::uint16_t cell_of(const BlobCell& cell) { return cell.cell; }

std::optional<std::pair<Cells, Cells>> cut(const Cells& cells, double most) {
  const auto across = valley_of(cells, row_of, most);
  const auto along = valley_of(cells, cell_of, most);
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

std::vector<Cells> split(const Blob& blob, double valley) {
  std::vector<Cells> parts{blob.cells};
  if (blob.extended) return parts;
  for (std::size_t i = 0; i < parts.size() && parts.size() < kMostParts;) {
    auto two = cut(parts[i], valley);
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
