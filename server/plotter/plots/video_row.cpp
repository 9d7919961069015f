#include "server/plotter/plots/video_row.hpp"

#include <algorithm>
#include <cmath>

#include "server/plotter/plots/row_kernels.hpp"

namespace skerry::server {
namespace {

// What a spoke may reach, metres: no radar sees less or more.
constexpr double kLeastReach = 1.0, kMostReach = 1e6;

// Sums of 16 bits hold so many spokes of 255, whose cells are summed in pairs and more before.
constexpr std::uint32_t kMostSpokesARow = 32;

std::uint64_t place_of(const SpokeHeader& header) {
  return std::uint64_t{header.scan} * header.geometry.spokes_per_turn + header.index;
}

// The largest divisor of `count` that is at most `most`.
std::uint32_t divisor_of(std::uint32_t count, std::uint32_t most) {
  for (std::uint32_t d = std::max(most, 1u); d > 1; --d)
    if (count % d == 0) return d;
  return 1;
}

}  // namespace

bool RowMaker::belongs(const SpokeHeader& header) const {
  return begun_ && header.geometry == geometry_ && header.reach().in_metres() == reach_m_;
}

void RowMaker::begin(const SpokeHeader& header) {
  geometry_ = header.geometry;
  reach_m_ = header.reach().in_metres();
  const double spoke_deg = 360.0 / geometry_.spokes_per_turn;
  const auto spokes = static_cast<std::uint32_t>(grain_.width_deg / spoke_deg + 1e-9);
  // Rows of equal width all round, so that one is the same place in every turn.
  spokes_a_row_ = divisor_of(geometry_.spokes_per_turn, std::min(spokes, kMostSpokesARow));
  rows_a_turn_ = geometry_.spokes_per_turn / spokes_a_row_;
  const double cell_m = reach_m_ / geometry_.cells;
  const double most = static_cast<double>(kMostJoined);
  cells_a_cell_ = static_cast<std::uint32_t>(std::clamp(grain_.cell_m / cell_m, 1.0, most));
  sums_.assign(geometry_.cells / cells_a_cell_, 0);
  spokes_ = 0;
  any_before_ = false;
  begun_ = true;
}

bool RowMaker::add(const Spoke& spoke) {
  const SpokeHeader& header = spoke.header;
  if (!header.geometry.valid() || spoke.cells.size() != header.geometry.cells ||
      header.index >= header.geometry.spokes_per_turn ||
      !(header.reach().in_metres() >= kLeastReach && header.reach().in_metres() <= kMostReach)) {
    ++left_out_;
    return false;
  }
  bool closed = false;
  const std::uint64_t place = place_of(header);
  if (!belongs(header)) {
    closed = flush();
    begin(header);
  } else if (place < next_) {
    if (next_ - place < geometry_.spokes_per_turn) {
      ++left_out_;
      return false;
    }
    closed = flush();
    begin(header);
  }
  const std::uint64_t number = place / spokes_a_row_;
  if (spokes_ > 0 && number != number_) closed = close();
  if (spokes_ == 0) {
    number_ = number;
    middle_ = header;
  }
  // The spoke in the middle of the row, or the first one after it.
  if (place % spokes_a_row_ <= spokes_a_row_ / 2) middle_ = header;
  sum(spoke);
  next_ = place + 1;
  return closed;
}

bool RowMaker::flush() { return spokes_ > 0 && close(); }

void RowMaker::sum(const Spoke& spoke) {
  const std::uint8_t* cells = spoke.cells.data();
  std::uint16_t* sums = sums_.data();
  const std::size_t count = sums_.size();
  if (cells_a_cell_ == 1)
    add_cells(cells, sums, count);
  else
    add_joined_cells(cells, cells_a_cell_, sums, count);
  ++spokes_;
}

bool RowMaker::close() {
  levels_.resize(sums_.size());
  // Of 16 bits: sums are below 2^13, so one multiplication by 2^16 / spokes divides them.
  const std::uint32_t scale = (geometry_.bits == 4 ? 17u : 1u) * 65536u / spokes_ + 1;
  scale_sums(sums_.data(), scale, levels_.data(), sums_.size());
  std::fill(sums_.begin(), sums_.end(), std::uint16_t{0});
  // From the spoke that stands for the row to the row's middle.
  const double spokes = 0.5 * (spokes_a_row_ - 1.0) - middle_.index % spokes_a_row_;
  row_.bearing = middle_.bearing() + degrees(spokes * 360.0 / geometry_.spokes_per_turn);
  row_.own_ship = middle_.own_ship;
  row_.time = middle_.scenario_time;
  row_.utc = middle_.utc;
  row_.number = number_;
  row_.width_rad = kRadiansPerTurn / rows_a_turn_;
  row_.cell_m = reach_m_ / geometry_.cells * cells_a_cell_;
  row_.follows = any_before_ && number_ == before_ + 1;
  row_.levels = levels_;
  before_ = number_;
  any_before_ = true;
  spokes_ = 0;
  return true;
}

}  // namespace skerry::server
