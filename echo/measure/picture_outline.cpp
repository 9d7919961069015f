#include "echo/measure/picture_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/measure/line_fit.hpp"
#include "echo/measure/picture_edge.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

constexpr double kLargestElements = 2200.0;

// A square picture of what echoes, with an empty border.
struct Mask {
  std::size_t side = 0;
  double element_m = 1.0;
  std::vector<std::uint8_t> on;
};

Mask mask_of(const PictureTurn& turn, const PictureWindow& window) {
  Mask mask;
  const double reach = std::min(window.to_m, turn.cells * turn.cell_m);
  mask.element_m = turn.cell_m * std::ceil(2.0 * reach / turn.cell_m / kLargestElements);
  mask.side = 2 * static_cast<std::size_t>(reach / mask.element_m) + 4;
  mask.on.assign(mask.side * mask.side, 0);
  const double middle = 0.5 * static_cast<double>(mask.side);
  const std::uint8_t least = least_echo(turn, window);
  for (std::size_t row = 1; row + 1 < mask.side; ++row) {
    const double north = (middle - static_cast<double>(row) - 0.5) * mask.element_m;
    for (std::size_t column = 1; column + 1 < mask.side; ++column) {
      const double east = (static_cast<double>(column) + 0.5 - middle) * mask.element_m;
      const double range = std::sqrt(east * east + north * north);
      const auto cell = static_cast<std::uint32_t>(range / turn.cell_m);
      if (cell >= turn.cells || range < window.from_m || range > window.to_m) continue;
      double bearing = std::atan2(east, north) / kRadiansPerDegree;
      if (bearing < 0.0) bearing += 360.0;
      if (!window.holds_bearing(bearing)) continue;
      const auto spoke = static_cast<std::uint32_t>(bearing / 360.0 * turn.spokes) % turn.spokes;
      mask.on[row * mask.side + column] = turn.at(spoke, cell) >= least;
    }
  }
  return mask;
}

void remove_patches_below(Mask& mask, double least_elements) {
  std::vector<std::uint8_t> seen(mask.on.size(), 0);
  std::vector<std::size_t> patch;
  const auto side = static_cast<std::ptrdiff_t>(mask.side);
  const std::ptrdiff_t around[8] = {-side - 1, -side, -side + 1, -1, 1, side - 1, side, side + 1};
  for (std::size_t start = 0; start < mask.on.size(); ++start) {
    if (mask.on[start] == 0 || seen[start] != 0) continue;
    patch.assign(1, start);
    seen[start] = 1;
    for (std::size_t k = 0; k < patch.size(); ++k) {
      for (const std::ptrdiff_t step : around) {
        const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(patch[k]) + step);
        if (mask.on[next] == 0 || seen[next] != 0) continue;
        seen[next] = 1;
        patch.push_back(next);
      }
    }
    if (static_cast<double>(patch.size()) >= least_elements) continue;
    for (std::size_t element : patch) mask.on[element] = 0;
  }
}

// Slope of boxes over box size between two sizes, in elements.
LineFit dimension_between(const OutlinePicture& outline, double from_m, double to_m) {
  // Sizes a quarter of an octave apart or a little less.
  const double smallest = std::max(2.0, from_m / outline.element_m);
  const double largest = to_m / outline.element_m;
  std::vector<double> x, y;
  if (!outline.elements.empty() && largest >= 1.4 * smallest) {  // false for NaN too
    const int steps = static_cast<int>(std::ceil(4.0 * std::log2(largest / smallest)));
    for (int i = 0; i <= steps; ++i) {
      const double box = smallest * std::pow(largest / smallest, double(i) / steps);
      x.push_back(-std::log(box));
      y.push_back(std::log(boxes_touched(outline, box)));
    }
  }
  return fitted_line(x, y);
}

// From the middle of the picture; NaN for an empty one.
double mean_range_m(const OutlinePicture& outline) {
  const double middle = 0.5 * outline.side;
  double sum = 0.0;
  for (const auto& [column, row] : outline.elements) {
    const double east = column + 0.5 - middle, south = row + 0.5 - middle;
    sum += std::sqrt(east * east + south * south);
  }
  return sum / static_cast<double>(outline.elements.size()) * outline.element_m;
}

OutlineDimension outline_dimension(const OutlinePicture& outline, double beam_m,
                                   const OutlineScales& scales) {
  OutlineDimension result{.beam_m = beam_m, .element_m = outline.element_m};
  const LineFit below = dimension_between(outline, scales.below_from_m, scales.below_to_m);
  const LineFit above = dimension_between(outline, scales.above_from_m, scales.above_to_m);
  result.below = below.slope, result.below_error = below.slope_error;
  result.above = above.slope, result.above_error = above.slope_error;
  return result;
}

std::vector<ScaleDimension> local_dimensions_of(const OutlinePicture& outline) {
  std::vector<ScaleDimension> local;
  if (outline.elements.empty()) return local;
  const double half_octave = std::sqrt(2.0);
  double boxes = boxes_touched(outline, 2.0);
  for (double box = 2.0; box * half_octave <= outline.side / 24.0; box *= half_octave) {
    const double next = boxes_touched(outline, box * half_octave);
    local.push_back({box * std::sqrt(half_octave) * outline.element_m,
                     std::log(boxes / next) / std::log(half_octave)});
    boxes = next;
  }
  return local;
}

}  // namespace

OutlinePicture outline_of(const PictureTurn& turn, const PictureWindow& window, double least_m2) {
  require_valid(turn, window);
  Mask mask = mask_of(turn, window);
  remove_patches_below(mask, least_m2 / (mask.element_m * mask.element_m));
  OutlinePicture outline;
  outline.side = static_cast<std::uint32_t>(mask.side);
  outline.element_m = mask.element_m;
  for (std::size_t row = 1; row + 1 < mask.side; ++row) {
    for (std::size_t column = 1; column + 1 < mask.side; ++column) {
      const std::size_t e = row * mask.side + column;
      const bool inside = mask.on[e - 1] != 0 && mask.on[e + 1] != 0 &&
                          mask.on[e - mask.side] != 0 && mask.on[e + mask.side] != 0;
      if (mask.on[e] == 0 || inside) continue;
      outline.elements.push_back(
          {static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
    }
  }
  return outline;
}

double boxes_touched(const OutlinePicture& outline, double box) {
  const auto boxes = static_cast<std::size_t>(outline.side / box) + 2;
  std::vector<std::uint8_t> touched(boxes * boxes);
  double least = std::numeric_limits<double>::infinity();
  for (int placing = 0; placing < 4; ++placing) {
    std::fill(touched.begin(), touched.end(), std::uint8_t{0});
    const double east = placing % 2 * 0.5 * box, south = placing / 2 * 0.5 * box;
    double count = 0.0;
    for (const auto& [column, row] : outline.elements) {
      auto& here = touched[static_cast<std::size_t>((row + south) / box) * boxes +
                           static_cast<std::size_t>((column + east) / box)];
      if (here == 0) count += 1.0;
      here = 1;
    }
    least = std::min(least, count);
  }
  return least;
}

OutlineScales recorded_scales(double range_m) {
  return {range_m / 512.0, range_m / 66.0, range_m / 47.0, range_m / 12.0};
}

OutlineScales scales_at_beam(double beam_m, double element_m) {
  return {4.0 * element_m, beam_m, beam_m, 4.0 * beam_m};
}

OutlineDimensions outline_dimensions(const PictureTurn& turn, const PictureWindow& window,
                                     double range_m) {
  const double beam = turn.beam_deg * kRadiansPerDegree;
  const EdgeStatistics edge = edge_statistics(turn, window);
  const double first_beam_m = edge.spokes > 0 ? edge.mean_range_m * beam : 0.0;
  const OutlinePicture outline = outline_of(turn, window, first_beam_m * first_beam_m);
  const double beam_m = mean_range_m(outline) * beam;
  return {outline_dimension(outline, beam_m, scales_at_beam(beam_m, outline.element_m)),
          outline_dimension(outline, beam_m, recorded_scales(range_m)),
          local_dimensions_of(outline)};
}

}  // namespace skerry::echo
