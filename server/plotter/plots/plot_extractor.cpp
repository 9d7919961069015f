#include "server/plotter/plots/plot_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "server/plotter/plots/blob_split.hpp"

namespace skerry::server {
namespace {

// An echo in a single row is noise, or another radar's pulse.
constexpr int kLeastRows = 2;

// Weighted mean and standard deviation of one coordinate.
struct Spread {
  double mean = 0.0, sigma = 0.0;
  std::uint16_t first = 0xffff, last = 0;
};

template <typename Line>
Spread spread_of(const std::vector<BlobCell>& cells, Line&& line) {
  // Integers, so that the order of cells does not matter.
  std::uint64_t weight = 0, sum = 0, squares = 0;
  Spread spread;
  for (const BlobCell& cell : cells) {
    const std::uint64_t at = line(cell);
    weight += cell.over;
    sum += cell.over * at;
    squares += cell.over * at * at;
    spread.first = std::min<std::uint16_t>(spread.first, line(cell));
    spread.last = std::max<std::uint16_t>(spread.last, line(cell));
  }
  spread.mean = static_cast<double>(sum) / static_cast<double>(weight);
  const double square = static_cast<double>(squares) / static_cast<double>(weight);
  spread.sigma = std::sqrt(std::max(square - spread.mean * spread.mean, 0.0));
  return spread;
}

// A coordinate is as uncertain as a cell (uniform), and as the echo's own spread over the root of
// the lines that it has: fading makes each line's strength a draw of its own.
double uncertainty(const Spread& spread, double line) {
  const double lines = spread.last - spread.first + 1.0;
  return line * std::sqrt(1.0 / 12.0 + spread.sigma * spread.sigma / lines);
}

// How wide a point is that stands so many levels over the threshold: a Gaussian beam falls by 24
// dB, there and back, a beam width off its middle.
double point_width(double beam, double over_db) { return 2.0 * beam * std::sqrt(over_db / 24.0); }

// Two peaks and a valley are three lines, of rows or of cells.
bool may_be_several(const Blob& blob) {
  if (blob.rows.size() >= 3) return true;
  std::uint16_t nearest = 0xffff, farthest = 0;
  for (const BlobCell& cell : blob.cells) {
    nearest = std::min(nearest, cell.cell);
    farthest = std::max(farthest, cell.cell);
  }
  return farthest - nearest >= 2;
}

// How far it reaches along the range or across, the larger; metres, as the radar sees it.
double size_of(const Blob& blob, const std::vector<BlobCell>& cells) {
  std::uint16_t nearest = 0xffff, farthest = 0;
  for (const BlobCell& cell : cells) {
    nearest = std::min(nearest, cell.cell);
    farthest = std::max(farthest, cell.cell);
  }
  const double rows = cells.back().row - cells.front().row + 1.0;
  return std::max((farthest - nearest + 1.0) * blob.cell_m,
                  rows * blob.row_width_rad * farthest * blob.cell_m);
}

}  // namespace

PlotExtractor::PlotExtractor(const Rule& rule)
    : rule_(rule),
      beam_rad_(rule.beam_deg * kRadiansPerTurn / 360.0),
      rows_(rule.grain),
      threshold_(rule.threshold),
      builder_({rule.least_cells, kLeastRows}) {
  if (!(rule.beam_deg >= 0.1 && rule.beam_deg <= 10.0))
    throw std::invalid_argument("beam_deg: must be 0.1 to 10");
  if (!(rule.pulse_m >= 0.0 && rule.pulse_m <= 500.0))
    throw std::invalid_argument("pulse_m: must be 0 to 500");
  if (!(rule.levels_per_db >= 0.5 && rule.levels_per_db <= 20.0))
    throw std::invalid_argument("levels_per_db: must be 0.5 to 20");
}

bool PlotExtractor::add(const Spoke& spoke, std::vector<Plot>& out) {
  if (!rows_.add(spoke)) return false;
  take_row(out);
  return true;
}

bool PlotExtractor::flush(std::vector<Plot>& out) {
  const bool any = rows_.flush();
  if (any) take_row(out);
  builder_.flush(blobs_);
  take_blobs(out);
  return any;
}

PlotExtractor::Counts PlotExtractor::counts() const {
  Counts counts = counts_;
  counts.spokes_left_out = rows_.left_out();
  counts.runs_left_out = builder_.left_out();
  return counts;
}

void PlotExtractor::take_row(std::vector<Plot>& out) {
  const VideoRow& row = rows_.row();
  runs_.clear();
  threshold_.find(row.levels, runs_);
  ++counts_.rows;
  if (!row.follows) {  // what is open belongs to the place and the range before
    builder_.flush(blobs_);
    take_blobs(out);
  }
  land_.go_on(row.own_ship, static_cast<std::uint64_t>(row.width_rad * kUnitsPerRadian + 0.5),
              row.cell_m * static_cast<double>(row.levels.size()));
  counts_.runs += runs_.size();
  builder_.add(row, runs_, threshold_.thresholds(), blobs_);
  if (!blobs_.empty()) take_blobs(out);
}

void PlotExtractor::take_blobs(std::vector<Plot>& out) {
  counts_.blobs += blobs_.size();
  const std::size_t before = out.size();
  for (const Blob& blob : blobs_) {
    if (blob.extended || !may_be_several(blob)) {
      take(blob, blob.cells, false, out);
      continue;
    }
    // What is below a bar as a whole is not told apart.
    if (take(blob, blob.cells, true, out)) continue;
    for (const std::vector<BlobCell>& cells : split(blob, rule_.valley))
      take(blob, cells, false, out);
  }
  builder_.give_back(blobs_);
  counts_.plots += out.size() - before;
}

bool PlotExtractor::take(const Blob& blob, const std::vector<BlobCell>& cells, bool only_below,
                         std::vector<Plot>& out) {
  if (cells.size() < rule_.least_cells) return true;
  const int width = cells.back().row - cells.front().row + 1;  // they come by row
  if (width < kLeastRows || width * blob.row_width_rad < rule_.least_width * beam_rad_) return true;
  std::uint8_t over = 0;
  for (const BlobCell& cell : cells) over = std::max(over, cell.over);
  if (only_below && (!rule_.bars || over > LandMap::kMostBar)) return false;
  Plot plot = plot_of(blob, cells, over);
  const LandMap::Spot spot = land_.spot(plot.own_ship, plot.bearing, plot.range_m);
  const bool told = plot.extended || !rule_.bars || over > land_.bar(spot) || land_.lasts(spot);
  if (told && only_below) return false;
  if (told) {
    plot.on_land = land_.on_land(spot, 0.5 * size_of(blob, cells));
    plot.clutter = land_.clutter(spot);
    out.push_back(plot);
    add_echo(blob, cells, plot.extended);
  } else {
    ++counts_.in_clutter;
  }
  if (!plot.extended) land_.add_plot(spot, told);
  return true;
}

Plot PlotExtractor::plot_of(const Blob& blob, const std::vector<BlobCell>& cells,
                            std::uint8_t over) const {
  const Spread across = spread_of(cells, [](const BlobCell& cell) { return cell.row; });
  const Spread along = spread_of(cells, [](const BlobCell& cell) { return cell.cell; });
  const double width_rad = (across.last - across.first + 1.0) * blob.row_width_rad;
  const auto middle = static_cast<std::size_t>(across.mean + 0.5);
  const BlobRow& at = blob.rows[std::min(middle, blob.rows.size() - 1)];
  Plot plot;
  plot.time = at.time;
  plot.utc = at.utc;
  plot.own_ship = at.own_ship;
  plot.bearing =
      at.bearing + radians((across.mean - static_cast<double>(middle)) * blob.row_width_rad);
  plot.range_m = (along.mean + 0.5) * blob.cell_m;
  plot.bearing_sigma_rad = uncertainty(across, blob.row_width_rad);
  plot.range_sigma_m = uncertainty(along, blob.cell_m);
  plot.length_m = std::max((along.last - along.first + 1.0) * blob.cell_m - rule_.pulse_m, 0.0);
  for (const BlobCell& cell : cells) plot.greatest = std::max(plot.greatest, cell.level);
  const double point = point_width(beam_rad_, over / rule_.levels_per_db) + blob.row_width_rad;
  plot.width_m = std::max((width_rad - point) * plot.range_m, 0.0);
  plot.cells = static_cast<std::uint32_t>(cells.size());
  plot.extended =
      blob.extended || plot.length_m > rule_.most_size_m || plot.width_m > rule_.most_size_m;
  return plot;
}

void PlotExtractor::add_echo(const Blob& blob, const std::vector<BlobCell>& cells, bool extended) {
  for (std::size_t i = 0; i < cells.size();) {
    std::size_t end = i + 1;
    while (end < cells.size() && cells[end].row == cells[i].row &&
           cells[end].cell == cells[end - 1].cell + 1)
      ++end;
    const BlobRow& row = blob.rows[cells[i].row];
    land_.add_echo(row.own_ship, row.bearing, blob.row_width_rad, cells[i].cell * blob.cell_m,
                   (cells[end - 1].cell + 1) * blob.cell_m, extended);
    i = end;
  }
}

}  // namespace skerry::server
