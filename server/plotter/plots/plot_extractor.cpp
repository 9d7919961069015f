#include "server/plotter/plots/plot_extractor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace skerry::server {
namespace {

// Levels over the threshold of an echo that shows all of its pulse.
constexpr int kStrongOver = 40;
// An echo in a single row is noise, or another radar's pulse.
constexpr int kLeastRows = 2;

// One coordinate of an echo, in lines, and how uncertain it is.
struct Coordinate {
  double mean = 0.0, lines = 0.0, sigma = 0.0;
};

// `sum` and `squares` of the places of lines from `first` to `last`, each weighed, over the weight.
// A coordinate is as uncertain as a cell (uniform), and as the echo's own spread over the root of
// the lines that it has: fading makes each line's strength a draw of its own.
Coordinate coordinate(std::uint64_t weight, std::uint64_t sum, std::uint64_t squares, int first,
                      int last) {
  Coordinate one;
  one.mean = static_cast<double>(sum) / static_cast<double>(weight);
  one.lines = last - first + 1.0;
  const double square = static_cast<double>(squares) / static_cast<double>(weight);
  const double spread = std::max(square - one.mean * one.mean, 0.0);
  one.sigma = std::sqrt(1.0 / 12.0 + spread / one.lines);
  return one;
}

// How wide a point is that stands so many levels over the threshold: a Gaussian beam falls by 24
// dB, there and back, a beam width off its middle.
double point_width(double beam, double over_db) { return 2.0 * beam * std::sqrt(over_db / 24.0); }

}  // namespace

// Of an echo's cells, in one pass: sums in integers, so that their order does not matter.
struct PlotExtractor::Shape {
  explicit Shape(const std::vector<BlobCell>& of)
      : first_row(of.front().row), last_row(of.back().row) {  // they come by row
    for (const BlobCell& cell : of) {
      const std::uint64_t weighed_row = std::uint64_t{cell.over} * cell.row;
      const std::uint64_t weighed_cell = std::uint64_t{cell.over} * cell.cell;
      weight += cell.over;
      rows += weighed_row;
      row_squares += weighed_row * cell.row;
      cells += weighed_cell;
      cell_squares += weighed_cell * cell.cell;
      nearest = std::min(nearest, cell.cell);
      farthest = std::max(farthest, cell.cell);
      over = std::max(over, cell.over);
      greatest = std::max(greatest, cell.level);
    }
  }

  Coordinate across() const { return coordinate(weight, rows, row_squares, first_row, last_row); }
  Coordinate along() const { return coordinate(weight, cells, cell_squares, nearest, farthest); }

  // Two peaks and a valley are three lines, of rows or of cells.
  bool may_be_several() const { return last_row - first_row >= 2 || farthest - nearest >= 2; }
  // How far it reaches along the range or across, the larger; metres, as the radar sees it.
  double size_m(const Blob& blob) const {
    return std::max(farthest - nearest + 1.0,
                    (last_row - first_row + 1.0) * blob.row_width_rad * farthest) *
           blob.cell_m;
  }

  int first_row, last_row;
  std::uint64_t weight = 0, rows = 0, row_squares = 0, cells = 0, cell_squares = 0;
  std::uint16_t nearest = 0xffff, farthest = 0;
  std::uint8_t over = 0, greatest = 0;
};

PlotExtractor::PlotExtractor(const Rule& rule)
    : rule_(rule),
      beam_rad_(rule.beam_deg * kRadiansPerTurn / 360.0),
      pulse_(rule.pulse_m),
      rows_(rule.grain),
      threshold_(rule.threshold),
      builder_({rule.least_cells, kLeastRows}) {
  if (!(rule.beam_deg >= 0.1 && rule.beam_deg <= 10.0))
    throw std::invalid_argument("beam_deg: must be 0.1 to 10");
  if (!(rule.pulse_m >= 0.0 && rule.pulse_m <= 500.0))
    throw std::invalid_argument("pulse_m: must be 0 to 500");
  if (!(rule.least_width >= 0.0 && rule.least_width <= 10.0))
    throw std::invalid_argument("least_width: must be 0 to 10");
  if (!(rule.most_size_m >= 1.0 && rule.most_size_m <= 1e5))
    throw std::invalid_argument("most_size_m: must be 1 to 100000");
  if (!(rule.grain.width_deg >= 0.01 && rule.grain.width_deg <= 10.0))
    throw std::invalid_argument("grain.width_deg: must be 0.01 to 10");
  if (!(rule.grain.cell_m >= 0.1 && rule.grain.cell_m <= 1000.0))
    throw std::invalid_argument("grain.cell_m: must be 0.1 to 1000");
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
  turns_ += row.width_rad / kRadiansPerTurn;
  counts_.runs += runs_.size();
  builder_.add(row, runs_, threshold_.thresholds(), blobs_);
  if (!blobs_.empty()) take_blobs(out);
}

void PlotExtractor::take_blobs(std::vector<Plot>& out) {
  counts_.blobs += blobs_.size();
  const std::size_t before = out.size();
  for (const Blob& blob : blobs_) {
    const Shape shape(blob.cells);
    if (blob.extended || !shape.may_be_several()) {
      take(blob, blob.cells, shape, shape, false, out);
      continue;
    }
    // What is below a bar as a whole is not told apart.
    if (take(blob, blob.cells, shape, shape, true, out)) continue;
    const auto parts = split(blob, rule_.valley, scratch_);
    if (parts.empty()) take(blob, blob.cells, shape, shape, false, out);
    for (const std::vector<BlobCell>& cells : parts)
      take(blob, cells, Shape(cells), shape, false, out);
  }
  builder_.give_back(blobs_);
  counts_.plots += out.size() - before;
}

bool PlotExtractor::take(const Blob& blob, const std::vector<BlobCell>& cells, const Shape& shape,
                         const Shape& whole, bool only_below, std::vector<Plot>& out) {
  if (cells.size() < rule_.least_cells) return true;
  const int width = shape.last_row - shape.first_row + 1;
  if (width < kLeastRows || width * blob.row_width_rad < rule_.least_width * beam_rad_) return true;
  if (only_below && (!rule_.bars || shape.over > LandMap::kMostBar)) return false;
  Plot plot = plot_of(blob, shape, whole);
  plot.cells = static_cast<std::uint32_t>(cells.size());
  const LandMap::Spot spot = land_.spot(plot.own_ship, plot.bearing, plot.range_m);
  const bool told =
      plot.extended || !rule_.bars || shape.over > land_.bar(spot) || land_.lasts(spot);
  if (told && only_below) return false;
  if (told) {
    plot.on_land = land_.on_land(spot, 0.5 * shape.size_m(blob));
    plot.clutter = land_.clutter(spot);
    plot.stood = land_.stood(spot);
    plot.stood_m = 1.5 * land_.cell_m();
    plot.by_standing = land_.is_by_standing(spot);
    out.push_back(plot);
    add_echo(blob, cells, plot.extended);
  } else {
    ++counts_.in_clutter;
  }
  if (!plot.extended) land_.add_plot(spot, told);
  return true;
}

// A part of a blob may be a half of one hull, whose middle is then the whole blob's: by so much its
// range is less sure.  Not its bearing: of two ships that lie abreast, and of side lobes, a part
// that is so unsure agrees with too much.
Plot PlotExtractor::plot_of(const Blob& blob, const Shape& shape, const Shape& whole) {
  const Coordinate across = shape.across(), along = shape.along();
  const double off_cells = &shape != &whole ? along.mean - whole.along().mean : 0.0;
  const auto middle = static_cast<std::size_t>(across.mean + 0.5);
  const BlobRow& at = blob.rows[std::min(middle, blob.rows.size() - 1)];
  Plot plot;
  plot.time = at.time;
  plot.utc = at.utc;
  plot.own_ship = at.own_ship;
  plot.bearing =
      at.bearing + radians((across.mean - static_cast<double>(middle)) * blob.row_width_rad);
  const double long_m = along.lines * blob.cell_m;
  if (shape.over >= kStrongOver && !blob.extended) pulse_.learn(long_m, blob.cell_m, turns_);
  // The pulse lies behind what it shows.
  const double pulse_m = std::min(pulse_.of(blob.cell_m), long_m);
  plot.range_m = std::max((along.mean + 0.5) * blob.cell_m - 0.5 * pulse_m, 0.5 * blob.cell_m);
  plot.bearing_sigma_rad = across.sigma * blob.row_width_rad;
  plot.range_sigma_m = std::sqrt(along.sigma * along.sigma + off_cells * off_cells) * blob.cell_m;
  plot.length_m = long_m - pulse_m;
  const double point =
      point_width(beam_rad_, shape.over / rule_.levels_per_db) + blob.row_width_rad;
  plot.width_m = std::max((across.lines * blob.row_width_rad - point) * plot.range_m, 0.0);
  plot.greatest = shape.greatest;
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
