#include "echo/measure/box_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace skerry::echo {
namespace {

constexpr double kMostBoxes = 5e7;

struct Box {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const Box&, const Box&) = default;
};

struct Grid {
  double size = 1.0;
  PlanePoint offset;
  double column(PlanePoint p) const { return (p.east_m - offset.east_m) / size; }
  double row(PlanePoint p) const { return (p.north_m - offset.north_m) / size; }
};

std::int32_t whole(double x) { return static_cast<std::int32_t>(std::floor(x)); }

// Share of the way from `from` to `to`, both in boxes, at which border `border` is met.
double way_to(double border, double from, double to) { return (border - from) / (to - from); }

// Appends every box that a - b enters (Amanatides and Woo 1987).
void add_segment(const Grid& grid, PlanePoint a, PlanePoint b, std::vector<Box>& boxes) {
  const double ax = grid.column(a), ay = grid.row(a), bx = grid.column(b), by = grid.row(b);
  Box box{whole(ax), whole(ay)};
  const Box last{whole(bx), whole(by)};
  const std::int32_t step_x = bx > ax ? 1 : -1, step_y = by > ay ? 1 : -1;
  boxes.push_back(box);
  while (box != last) {
    const double far = std::numeric_limits<double>::infinity();
    const double to_x = box.x == last.x ? far : way_to(box.x + (step_x > 0 ? 1 : 0), ax, bx);
    const double to_y = box.y == last.y ? far : way_to(box.y + (step_y > 0 ? 1 : 0), ay, by);
    if (to_x < to_y) {
      box.x += step_x;
    } else {
      box.y += step_y;
    }
    boxes.push_back(box);
  }
}

std::vector<Box> boxes_of(const Grid& grid, std::span<const PlaneLine> lines) {
  std::vector<Box> boxes;
  for (const PlaneLine& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      add_segment(grid, line[i], line[i + 1], boxes);
    }
  }
  std::sort(boxes.begin(), boxes.end());
  boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
  return boxes;
}

void require_countable(std::span<const PlaneLine> lines, double smallest, double largest) {
  if (!(smallest > 0.0) || !(largest >= smallest) || !std::isfinite(largest))
    throw std::invalid_argument("box count: sizes " + std::to_string(smallest) + " to " +
                                std::to_string(largest) + " m; expected 0 < smallest <= largest");
  double boxes = 0.0, farthest = 0.0;
  for (const PlaneLine& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      farthest = std::max({farthest, std::fabs(line[i].east_m), std::fabs(line[i].north_m)});
      if (!std::isfinite(line[i].east_m) || !std::isfinite(line[i].north_m))
        throw std::invalid_argument("box count: a point is not a number");
      if (i == 0) continue;
      const PlanePoint d = line[i] - line[i - 1];
      boxes += 1.0 + (std::fabs(d.east_m) + std::fabs(d.north_m)) / smallest;
    }
  }
  if (boxes > kMostBoxes || farthest / smallest > 1e9)
    throw std::invalid_argument("box count: boxes of " + std::to_string(smallest) +
                                " m are too small for these lines; take larger boxes or less of "
                                "the coast");
}

}  // namespace

BoxCensus box_census(std::span<const PlaneLine> lines, double smallest_m, double largest_m) {
  require_countable(lines, smallest_m, largest_m);
  BoxCensus census;
  for (double s = smallest_m; s <= largest_m * (1.0 + 1e-9); s *= 2.0) census.sizes_m.push_back(s);
  const double tile = 2.0 * census.sizes_m.back();
  std::map<std::pair<double, double>, std::vector<std::size_t>> tiles;
  for (std::size_t k = 0; k < census.sizes_m.size(); ++k) {
    const double s = census.sizes_m[k];
    Grid best_grid;
    std::vector<Box> best;
    for (int shift = 0; shift < 4; ++shift) {
      const Grid grid{s, {(shift & 1) ? s / 2.0 : 0.0, (shift & 2) ? s / 2.0 : 0.0}};
      std::vector<Box> boxes = boxes_of(grid, lines);
      if (shift > 0 && boxes.size() >= best.size()) continue;
      best = std::move(boxes);
      best_grid = grid;
    }
    census.boxes.push_back(best.size());
    for (Box box : best) {
      const std::pair at{std::floor((box.x * s + best_grid.offset.east_m) / tile),
                         std::floor((box.y * s + best_grid.offset.north_m) / tile)};
      std::vector<std::size_t>& counts = tiles[at];
      counts.resize(census.sizes_m.size());
      ++counts[k];
    }
  }
  for (auto& [at, counts] : tiles) census.tiles.push_back(std::move(counts));
  return census;
}

std::vector<ScaleDimension> local_dimensions(const BoxCensus& census) {
  std::vector<ScaleDimension> out;
  for (std::size_t k = 0; k + 1 < census.boxes.size(); ++k) {
    if (census.boxes[k + 1] == 0) continue;
    const double ratio =
        static_cast<double>(census.boxes[k]) / static_cast<double>(census.boxes[k + 1]);
    out.push_back({census.sizes_m[k] * std::sqrt(2.0), std::log2(ratio)});
  }
  return out;
}

DimensionEstimate box_dimension(const BoxCensus& census) {
  const std::size_t sizes = census.sizes_m.size();
  std::vector<double> x(sizes), y(sizes);
  const auto slope = [&](const std::vector<double>& boxes) {
    for (std::size_t k = 0; k < sizes; ++k) {
      x[k] = -std::log(census.sizes_m[k]);
      y[k] = std::log(boxes[k]);
    }
    return fitted_line(x, y);
  };
  std::vector<double> boxes(census.boxes.begin(), census.boxes.end());
  if (sizes < 3 || boxes.back() == 0.0) return {kNotKnown, kNotKnown, {kNotKnown, kNotKnown}};
  const LineFit fit = slope(boxes);
  const Bootstrap chance = bootstrap(static_cast<std::uint32_t>(census.tiles.size()),
                                     [&](std::span<const std::uint32_t> drawn) {
                                       std::fill(boxes.begin(), boxes.end(), 0.0);
                                       for (std::uint32_t tile : drawn) {
                                         for (std::size_t k = 0; k < sizes; ++k) {
                                           boxes[k] += static_cast<double>(census.tiles[tile][k]);
                                         }
                                       }
                                       return slope(boxes).slope;
                                     });
  const double error = std::isfinite(chance.standard_error)
                           ? std::max(fit.slope_error, chance.standard_error)
                           : fit.slope_error;
  const double reach = student95(static_cast<int>(sizes) - 2) * error;
  return {fit.slope, error, {fit.slope - reach, fit.slope + reach}};
}

}  // namespace skerry::echo
