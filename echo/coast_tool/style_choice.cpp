// How a style is chosen for what was measured.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echo/coast_tool/coast_fit.hpp"
#include "echo/fractal/edge_refiner.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kStraightBelow = 1.01;
constexpr double kMostAmplitude = 4.0;

double in_hundredths(double x) { return std::round(x * 100.0) / 100.0; }

CoastMethod method_for(double dimension) {
  if (dimension < kStraightBelow) return CoastMethod::straight;
  if (dimension <= greatest_dimension(CoastMethod::random_koch)) return CoastMethod::random_koch;
  return CoastMethod::midpoint;
}

std::string reason_for(CoastMethod method, double dimension) {
  switch (method) {
    case CoastMethod::straight:
      return fmt::format("straight: a dimension of {:.2f} is that of a smooth line", dimension);
    case CoastMethod::random_koch:
      return fmt::format("random_koch: reaches {:g} and never crosses itself",
                         greatest_dimension(method));
    default:
      return fmt::format("midpoint: {:.2f} is more than the {:g} of random_koch", dimension,
                         greatest_dimension(CoastMethod::random_koch));
  }
}

// The amplitude at which the style's edges stand out by `offset`, or the least that comes within
// 2 % of the most they can.
double amplitude_for(CoastStyle style, double offset, int edges) {
  style.amplitude = kMostAmplitude;
  const double wanted = std::min(offset, 0.98 * offset_of(style, edges));
  double low = 0.0, high = kMostAmplitude;
  for (int i = 0; i < 10; ++i) {
    style.amplitude = (low + high) / 2.0;
    (offset_of(style, edges) < wanted ? low : high) = style.amplitude;
  }
  return (low + high) / 2.0;
}

}  // namespace

double offset_of(const CoastStyle& style, int edges) {
  constexpr double kLength = 1000.0;
  const EdgeRefiner refiner(style);
  const DetailLimit limit{.cell_m = kLength / 32.0};
  double squares = 0.0;
  std::vector<PlanePoint> line;
  for (int k = 0; k < edges; ++k) {
    // Up to 30 degrees to either side: the widest room there is (clearance.hpp).
    const GrowingEdge edge{
        {0.0, 0.0}, {kLength, 0.0}, mixed(static_cast<std::uint64_t>(k)), std::sqrt(1.0 / 3.0)};
    line.assign(1, edge.from);
    refiner.refine(edge, limit, line);
    const double offset = middle_offset(line);
    squares += offset * offset;
  }
  return std::sqrt(squares / edges);
}

ChosenStyle choose_style(double dimension, double offset, std::optional<CoastMethod> method,
                         int edges) {
  ChosenStyle chosen;
  chosen.offset = offset;
  CoastStyle& style = chosen.style;
  style.method = method.value_or(method_for(dimension));
  chosen.words.push_back(method ? fmt::format("{}: asked for", name_of(style.method))
                                : reason_for(style.method, dimension));
  const double most = greatest_dimension(style.method);
  style.dimension = std::min(in_hundredths(std::clamp(dimension, 1.0, most)), most);
  if (style.method == CoastMethod::straight) return chosen;
  if (dimension > most + 0.005) {
    chosen.words.push_back(fmt::format("dimension {:.2f} is beyond the {:g} of {} and becomes {:g}",
                                       dimension, most, name_of(style.method), style.dimension));
  } else if (dimension < 0.995) {
    chosen.words.push_back(
        fmt::format("dimension {:.2f} is below that of a line and becomes 1", dimension));
  }
  if (!std::isfinite(offset)) {
    chosen.words.push_back("amplitude 1: too few chords to measure how far the coast stands out");
    chosen.offset_made = offset_of(style, edges);
    return chosen;
  }
  style.amplitude = in_hundredths(amplitude_for(style, offset, edges));
  chosen.offset_made = offset_of(style, edges);
  chosen.words.push_back(fmt::format(
      "amplitude {:g}: an edge's middle stands out by {:.3f} of the edge (measured {:.3f})",
      style.amplitude, chosen.offset_made, offset));
  if (chosen.offset_made < 0.95 * offset)
    chosen.words.push_back("more has no room within 30 degrees of the edge");
  return chosen;
}

}  // namespace skerry::echo
