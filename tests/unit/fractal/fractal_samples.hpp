// Shared by the coast's property and law tests: edges by chance, functions at all dyadic places,
// and estimators of dimension.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/fractal/koch_edge.hpp"
#include "echo/fractal/midpoint_edge.hpp"
#include "echo/fractal/offset_graph.hpp"
#include "echo/fractal/weierstrass_edge.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo::samples {

// Place number k of a run of seeded choices in [0, 1).
inline double chance(std::uint64_t run, std::uint64_t k) { return as_unit(mixed(run, k)); }

// An edge of 1 m to 3 km, anywhere within 10 km, with any room.
inline GrowingEdge any_edge(std::uint64_t run) {
  const double bearing = 6.283185307179586 * chance(run, 1);
  const double length = std::pow(10.0, 3.5 * chance(run, 2));
  const PlanePoint from{2e4 * (chance(run, 3) - 0.5), 2e4 * (chance(run, 4) - 0.5)};
  return {from, from + PlanePoint{length * std::sin(bearing), length * std::cos(bearing)},
          mixed(run, 5), kMaxHalfAngleTan * chance(run, 6)};
}

template <typename Function>
void fill(const Function& function, typename Function::State state, int level, std::int64_t piece,
          int depth, std::vector<double>& values) {
  typename Function::Halves halves;
  const double middle = function.middle(state, level, piece, halves);
  values[static_cast<std::size_t>((2 * piece + 1) << (depth - level - 1))] = middle;
  if (level + 1 == depth) return;
  function.open(state, level, piece, halves);
  fill(function, function.left(state, halves), level + 1, 2 * piece, depth, values);
  fill(function, function.right(state, halves), level + 1, 2 * piece + 1, depth, values);
}

// The bridge of a method at i 2^-depth, i = 0 .. 2^depth, over an edge of `length_m`.
class Bridges {
 public:
  explicit Bridges(const CoastStyle& style)
      : style_(style),
        graph_(style),
        midpoint_(graph_.bridge),
        weierstrass_(style, graph_.bridge) {}

  const GraphStyle& graph() const { return graph_; }
  const MidpointTables& midpoint() const { return midpoint_; }
  const WeierstrassTables& weierstrass() const { return weierstrass_; }

  std::vector<double> bridge(std::uint64_t seed, int depth, int terms) const {
    std::vector<double> values((std::size_t{1} << depth) + 1);
    if (style_.method == CoastMethod::midpoint) {
      const MidpointFunction function(midpoint_, graph_.scale, seed);
      fill(function, function.start(), 0, 0, depth, values);
    } else {
      const WeierstrassFunction function(weierstrass_, terms, seed);
      fill(function, function.start(), 0, 0, depth, values);
    }
    return values;
  }

  // Offsets to the left, metres, of the edge's graph.
  std::vector<double> offsets(const GrowingEdge& edge, int depth) const {
    const OffsetGraph graph(graph_, edge);
    std::vector<double> values =
        bridge(edge.seed, depth, weierstrass_.terms(graph.length_m(), graph.most_gain_m()));
    const PlanePoint along = edge.to - edge.from;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
      const double t = static_cast<double>(i) * half_to_the(depth);
      values[i] = cross(along, graph.vertex(t, values[i]).at - edge.from) / graph.length_m();
    }
    return values;
  }

 private:
  CoastStyle style_;
  GraphStyle graph_;
  MidpointTables midpoint_;
  WeierstrassTables weierstrass_;
};

// Mean square of the second differences of lag 2^octave, over the middle half of the values.
// It grows as lag^2H whatever smooth function is added (Istas and Lang 1997), where the variogram
// of first differences reads the bridge's missing trend as roughness.
inline double bend_variogram(std::span<const double> values, int octave) {
  const std::size_t lag = std::size_t{1} << octave, n = values.size();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = n / 4; i + 2 * lag <= 3 * n / 4; ++i, ++count) {
    const double bend = values[i + 2 * lag] - 2.0 * values[i + lag] + values[i];
    sum += bend * bend;
  }
  return sum / static_cast<double>(count);
}

// Mean square of the first differences.
inline double step_variogram(std::span<const double> values, int octave) {
  const std::size_t lag = std::size_t{1} << octave, n = values.size();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = n / 4; i + lag <= 3 * n / 4; ++i, ++count) {
    const double step = values[i + lag] - values[i];
    sum += step * step;
  }
  return sum / static_cast<double>(count);
}

// D = 2 - H, 2 H the slope of log2 of a variogram over octaves 0, 1, ...
inline double dimension_of(std::span<const double> variogram) {
  const auto n = static_cast<double>(variogram.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < variogram.size(); ++k) {
    const double x = static_cast<double>(k), y = std::log2(variogram[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return 2.0 - 0.5 * (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace skerry::echo::samples
