#include "echo/measure/coast_dimension.hpp"

#include <algorithm>
#include <limits>

#include "echo/kernel/exact_math.hpp"
#include "echo/measure/ruler_walk.hpp"

namespace skerry::echo {
namespace {

constexpr int kRulers = 8;
constexpr std::size_t kStarts = 8;
constexpr double kMostSteps = 1e8;

double total_length(std::span<const PlanePoint> line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance(line[i], line[i + 1]);
  return length;
}

// Rulers from vertex `start` to the end.
double rulers_to_end(std::span<const PlanePoint> line, std::size_t start, double ruler) {
  double steps = 0.0;
  const double left =
      walk_ruler(line, start, ruler, [&](std::size_t, PlanePoint) { steps += 1.0; });
  return steps + left;
}

}  // namespace

std::vector<RulerLength> divider_lengths(std::span<const PlanePoint> line, double shortest_ruler_m,
                                         double longest_ruler_m) {
  if (!(shortest_ruler_m > 0.0) || !(longest_ruler_m > shortest_ruler_m) || line.size() < 2 ||
      !(total_length(line) < kMostSteps * shortest_ruler_m))
    return {};
  const std::vector<PlanePoint> backward(line.rbegin(), line.rend());
  const std::size_t starts = std::min(kStarts, line.size());
  std::vector<RulerLength> lengths;
  const double octaves = exact_log2(longest_ruler_m / shortest_ruler_m);
  for (int k = 0; k < kRulers; ++k) {
    const double ruler = shortest_ruler_m * exact_exp2(octaves * k / (kRulers - 1.0));
    double steps = 0.0;
    for (std::size_t s = 0; s < starts; ++s) {
      const std::size_t at = s * line.size() / starts;
      steps +=
          rulers_to_end(line, at, ruler) + rulers_to_end(backward, line.size() - 1 - at, ruler);
    }
    lengths.push_back({ruler, steps / static_cast<double>(starts) * ruler});
  }
  return lengths;
}

double dimension_of(std::span<const RulerLength> lengths) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const RulerLength& l : lengths) {
    const double x = exact_log2(l.ruler_m);
    const double y = exact_log2(std::max(l.length_m, 1e-9));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double n = static_cast<double>(lengths.size());
  if (lengths.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  return 1.0 - (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double divider_dimension(std::span<const PlanePoint> line, double shortest_ruler_m,
                         double longest_ruler_m) {
  if (!(total_length(line) >= 4.0 * longest_ruler_m))
    return std::numeric_limits<double>::quiet_NaN();
  return dimension_of(divider_lengths(line, shortest_ruler_m, longest_ruler_m));
}

}  // namespace skerry::echo
