#include "server/plotter/plots/blob_builder.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace skerry::server {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
// Memory that ended blobs leave to the next ones: so many of so many cells at most.
constexpr std::size_t kKept = 256, kMostSpare = 64;

}  // namespace

void BlobBuilder::add(const VideoRow& row, std::span<const Run> runs,
                      std::span<const std::uint8_t> thresholds, std::vector<Blob>& out) {
  if (!row.follows) flush(out);
  row_width_rad_ = row.width_rad;
  cell_m_ = row.cell_m;
  if (rows_.size() > kMostRows) {
    rows_.pop_front();
    ++oldest_;
  }
  rows_.push_back({row.bearing, row.own_ship, row.time, row.utc});
  now_.clear();
  from_ = 0;
  for (const Run& run : runs) {
    std::size_t owner = owner_of(run, out);
    if (owner == kNone) {
      owner = take_free();
      if (owner == kNone) {
        ++left_out_;
        continue;
      }
      open_[owner].cut = !row.follows;
    }
    put(open_[owner], row, run, thresholds, out);
    now_.push_back({run, owner});
  }
  // Of those open, each has a run in the row before, or in this one.
  for (const OwnedRun& each : before_) {
    if (open_[each.open].used && open_[each.open].last != next_) end(each.open, out);
  }
  std::swap(before_, now_);
  ++next_;
}

void BlobBuilder::give_back(std::vector<Blob>& blobs) {
  for (Blob& blob : blobs) {
    if (spare_.size() < kMostSpare && blob.cells.capacity() <= kKept)
      spare_.push_back(std::move(blob));
  }
  blobs.clear();
}

void BlobBuilder::flush(std::vector<Blob>& out) {
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (!open_[i].used) continue;
    open_[i].cut = true;
    end(i, out);
  }
  before_.clear();
}

// The blob of those runs before that touch this one; if they are of several, these are joined. Runs
// come nearest first, so those that end before this one touch none that follow, either.
std::size_t BlobBuilder::owner_of(const Run& run, std::vector<Blob>& out) {
  while (from_ < before_.size() && before_[from_].run.end < run.first) ++from_;
  std::size_t owner = kNone;
  for (std::size_t i = from_; i < before_.size() && before_[i].run.first <= run.end; ++i) {
    if (owner == kNone) owner = before_[i].open;
    if (before_[i].open != owner) join(owner, before_[i].open, out);
  }
  return owner;
}

std::size_t BlobBuilder::take_free() {
  if (free_.empty()) {
    if (open_.size() == kMostOpen) return kNone;
    free_.push_back(open_.size());
    open_.emplace_back();
  }
  const std::size_t taken = free_.back();
  free_.pop_back();
  Open& open = open_[taken];
  open.cells.clear();
  open.first = open.last = next_;
  open.extended = open.cut = open.joined = false;
  open.used = true;
  return taken;
}

void BlobBuilder::join(std::size_t into, std::size_t from, std::vector<Blob>& out) {
  Open &to = open_[into], &gone = open_[from];
  to.extended = to.extended || gone.extended || to.cells.size() + gone.cells.size() > kMostCells;
  to.cut = to.cut || gone.cut;
  if (to.extended) {
    gone.extended = true;
    cut_off(to, out);
    cut_off(gone, out);
  } else {
    const std::uint64_t first = std::min(to.first, gone.first);
    const auto shift = [&](BlobCell& cell, std::uint64_t old) {
      cell.row = static_cast<std::uint16_t>(cell.row + (old - first));
    };
    for (BlobCell& cell : to.cells) shift(cell, to.first);
    for (BlobCell& cell : gone.cells) {
      shift(cell, gone.first);
      to.cells.push_back(cell);
    }
    to.joined = true;
    to.first = first;
    to.last = std::max(to.last, gone.last);
  }
  gone.used = false;
  free_.push_back(from);
  for (std::vector<OwnedRun>* list : {&before_, &now_}) {
    for (OwnedRun& each : *list)
      if (each.open == from) each.open = into;
  }
}

void BlobBuilder::put(Open& open, const VideoRow& row, const Run& run,
                      std::span<const std::uint8_t> thresholds, std::vector<Blob>& out) {
  const bool full = open.cells.size() + (run.end - run.first) > kMostCells;
  if (full || next_ - open.first >= kMostRows) {
    open.extended = true;
    cut_off(open, out);
  }
  if (open.cells.empty()) open.first = next_;
  open.last = next_;
  const auto place = static_cast<std::uint16_t>(next_ - open.first);
  const std::size_t before = open.cells.size();
  open.cells.resize(before + (run.end - run.first));
  BlobCell* to = open.cells.data() + before;
  for (std::uint32_t i = run.first; i < run.end; ++i) {
    const int over = row.levels[i] - thresholds[i / LocalThreshold::kBlock];
    *to++ = {place, static_cast<std::uint16_t>(i), row.levels[i], static_cast<std::uint8_t>(over)};
  }
}

void BlobBuilder::cut_off(Open& open, std::vector<Blob>& out) {
  const bool little = open.cells.size() < least_.cells || open.last - open.first + 1 < least_.rows;
  if (open.cells.empty() || (little && !open.extended)) {
    open.cells.clear();
    return;
  }
  if (open.joined) put_in_order(open.cells);
  open.joined = false;
  Blob blob;
  if (!spare_.empty()) {
    blob = std::move(spare_.back());
    spare_.pop_back();
  }
  blob.cells.clear();
  blob.cells.swap(open.cells);
  const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(open.first - oldest_);
  blob.rows.assign(begin, begin + blob.cells.back().row + 1);
  blob.row_width_rad = row_width_rad_;
  blob.cell_m = cell_m_;
  blob.extended = open.extended;
  blob.cut = open.cut;
  out.push_back(std::move(blob));
}

// By counting, since large ones are joined of many.
void BlobBuilder::put_in_order(std::vector<BlobCell>& cells) {
  const auto before = [](const BlobCell& a, const BlobCell& b) {
    return a.row != b.row ? a.row < b.row : a.cell < b.cell;
  };
  if (std::is_sorted(cells.begin(), cells.end(), before)) return;
  std::array<std::uint32_t, kMostRows + 1> first{};
  for (const BlobCell& cell : cells) ++first[cell.row + 1u];
  for (std::size_t row = 0; row < kMostRows; ++row) first[row + 1] += first[row];
  auto next = first;
  ordered_.resize(cells.size());
  for (const BlobCell& cell : cells) ordered_[next[cell.row]++] = cell;
  for (std::size_t row = 0; row < kMostRows; ++row) {
    const auto begin = ordered_.begin() + first[row], end = ordered_.begin() + first[row + 1];
    if (!std::is_sorted(begin, end, before)) std::sort(begin, end, before);
  }
  cells.swap(ordered_);
}

void BlobBuilder::end(std::size_t open, std::vector<Blob>& out) {
  cut_off(open_[open], out);
  open_[open].used = false;
  free_.push_back(open);
}

}  // namespace skerry::server
