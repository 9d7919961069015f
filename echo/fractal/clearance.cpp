#include "echo/fractal/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "echo/fractal/koch_edge.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

bool boxes_meet(const ShoreEdge& p, const ShoreEdge& q) {
  const auto meet = [](double a, double b, double c, double d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
  };
  return meet(p.from.east_m, p.to.east_m, q.from.east_m, q.to.east_m) &&
         meet(p.from.north_m, p.to.north_m, q.from.north_m, q.to.north_m);
}

struct Box {
  double east0, east1, north0, north1;
};
Box box_of(const ShoreEdge& e) {
  return {std::min(e.from.east_m, e.to.east_m), std::max(e.from.east_m, e.to.east_m),
          std::min(e.from.north_m, e.to.north_m), std::max(e.from.north_m, e.to.north_m)};
}

// Farther apart than `reach` along one axis.
bool apart(const Box& p, const Box& q, double reach) {
  return (q.east0 - p.east1 > reach) | (p.east0 - q.east1 > reach) | (q.north0 - p.north1 > reach) |
         (p.north0 - q.north1 > reach);
}

// The boxes decide for segments on one line, where the signs are rounding noise.
bool crosses(const ShoreEdge& p, const ShoreEdge& q) {
  if (!boxes_meet(p, q)) return false;
  const PlanePoint u = p.to - p.from, v = q.to - q.from;
  return (cross(u, q.from - p.from) > 0.0) != (cross(u, q.to - p.from) > 0.0) &&
         (cross(v, p.from - q.from) > 0.0) != (cross(v, p.to - q.from) > 0.0);
}

// tan(0.49 gamma) for the angle gamma between two edges leaving a common vertex.  With
// half = gamma/2, tan(half) = |cross| / (|u||v| + dot); 0.98 of an angle below 45 deg has a tangent
// of less than 0.98 times the tangent, which errs on the safe side.
double half_angle_between(PlanePoint u, PlanePoint v) {
  const double lengths = std::sqrt(dot(u, u) * dot(v, v));
  const double denominator = lengths + dot(u, v);
  if (denominator <= 1e-12 * lengths) return kMaxHalfAngleTan;  // straight on: gamma = 180 deg
  return std::min(kMaxHalfAngleTan, 0.96 * std::fabs(cross(u, v)) / denominator);
}

constexpr std::int32_t kMaxSide = 1024;

}  // namespace

std::uint64_t ShoreEdge::seed() const { return mixed(from_id, to_id); }

double segment_distance(const ShoreEdge& p, const ShoreEdge& q) {
  if (crosses(p, q)) return 0.0;
  return std::sqrt(std::min(std::min(distance_squared_to_segment(p.from, q.from, q.to),
                                     distance_squared_to_segment(p.to, q.from, q.to)),
                            std::min(distance_squared_to_segment(q.from, p.from, p.to),
                                     distance_squared_to_segment(q.to, p.from, p.to))));
}

Clearance::Clearance(std::span<const ShoreEdge> edges) : edges_(edges), known_(edges.size(), -1) {
  PlanePoint low{1e12, 1e12}, high{-1e12, -1e12};
  for (const ShoreEdge& e : edges) {
    for (PlanePoint p : {e.from, e.to}) {
      low = {std::min(low.east_m, p.east_m), std::min(low.north_m, p.north_m)};
      high = {std::max(high.east_m, p.east_m), std::max(high.north_m, p.north_m)};
    }
  }
  if (edges.empty()) low = high = {};
  origin_ = low;
  const double side = std::max(high.east_m - low.east_m, high.north_m - low.north_m) + 1.0;
  // About one edge per square along the coast, at least 100 m.
  const double across =
      std::clamp(std::sqrt(static_cast<double>(edges.size()) * 4.0), 1.0, double{kMaxSide});
  square_m_ = std::max(100.0, side / across);
  columns_ = static_cast<std::int32_t>((high.east_m - low.east_m) / square_m_) + 1;
  rows_ = static_cast<std::int32_t>((high.north_m - low.north_m) / square_m_) + 1;

  const auto for_each_square = [&](const ShoreEdge& e, auto&& visit) {
    const auto column = [&](double east) {
      return static_cast<std::int32_t>(
          std::clamp((east - origin_.east_m) / square_m_, 0.0, static_cast<double>(columns_ - 1)));
    };
    const auto row = [&](double north) {
      return static_cast<std::int32_t>((north - origin_.north_m) / square_m_);
    };
    const auto [c0, c1] = std::minmax({column(e.from.east_m), column(e.to.east_m)});
    const auto [r0, r1] = std::minmax({row(e.from.north_m), row(e.to.north_m)});
    // A long edge passes through few of its box's squares: in each row those between where it comes
    // in and goes out, and one more on either side for the rounding.
    const double rise = e.to.north_m - e.from.north_m;
    const bool steep = r0 < r1 && c0 < c1 && std::fabs(rise) >= 1.0;
    const double slope = steep ? (e.to.east_m - e.from.east_m) / rise : 0.0;
    for (std::int32_t r = r0; r <= r1; ++r) {
      std::int32_t first = c0, last = c1;
      if (steep) {
        const double up = origin_.north_m + r * square_m_ - e.from.north_m;
        const auto [in, out] = std::minmax(
            {column(e.from.east_m + up * slope), column(e.from.east_m + (up + square_m_) * slope)});
        first = std::max(c0, in - 1);
        last = std::min(c1, out + 1);
      }
      for (std::int32_t c = first; c <= last; ++c)
        visit(static_cast<std::size_t>(r * columns_ + c));
    }
  };
  square_start_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const ShoreEdge& e : edges)
    for_each_square(e, [&](std::size_t s) { ++square_start_[s + 1]; });
  for (std::size_t s = 1; s < square_start_.size(); ++s) square_start_[s] += square_start_[s - 1];
  square_edges_.resize(square_start_.back());
  std::vector<std::uint32_t> fill(square_start_.begin(), square_start_.end() - 1);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    for_each_square(edges[i], [&](std::size_t s) { square_edges_[fill[s]++] = i; });
  }
}

double Clearance::half_angle_tan(std::uint32_t edge) {
  float& known = known_[edge];
  if (known < 0.0f) known = static_cast<float>(measure(edges_[edge], edge));
  return known;
}

double Clearance::measure(const ShoreEdge& e, std::uint32_t index) const {
  const PlanePoint along = e.to - e.from;
  const double length = length_of(along);
  if (length == 0.0) return 0.0;
  // No edge farther away than this can bind: 0.47 d >= tan(30 deg) * length / 2.
  const double reach = length * kMaxHalfAngleTan / (2.0 * 0.47);
  const auto square = [&](double offset, std::int32_t count) {
    return static_cast<std::int32_t>(
        std::clamp(offset / square_m_, 0.0, static_cast<double>(count - 1)));
  };
  const auto [east0, east1] = std::minmax(e.from.east_m, e.to.east_m);
  const auto [north0, north1] = std::minmax(e.from.north_m, e.to.north_m);
  const std::int32_t c0 = square(east0 - reach - origin_.east_m, columns_);
  const std::int32_t c1 = square(east1 + reach - origin_.east_m, columns_);
  const std::int32_t r0 = square(north0 - reach - origin_.north_m, rows_);
  const std::int32_t r1 = square(north1 + reach - origin_.north_m, rows_);

  const Box box = box_of(e);
  double tan = kMaxHalfAngleTan;
  for (std::int32_t r = r0; r <= r1; ++r) {
    for (std::int32_t c = c0; c <= c1; ++c) {
      const auto s = static_cast<std::size_t>(r * columns_ + c);
      for (std::uint32_t k = square_start_[s]; k < square_start_[s + 1]; ++k) {
        if (square_edges_[k] == index) continue;
        const ShoreEdge& f = edges_[square_edges_[k]];
        // An edge farther away than the nearest so far decides nothing.
        if (apart(box, box_of(f), 1.0001 * tan * length / (2.0 * 0.47))) continue;
        const bool ff = f.from_id == e.from_id, ft = f.to_id == e.from_id;
        const bool tf = f.from_id == e.to_id, tt = f.to_id == e.to_id;
        if (ff) tan = std::min(tan, half_angle_between(e.to - e.from, f.to - f.from));
        if (ft) tan = std::min(tan, half_angle_between(e.to - e.from, f.from - f.to));
        if (tf) tan = std::min(tan, half_angle_between(e.from - e.to, f.to - f.from));
        if (tt) tan = std::min(tan, half_angle_between(e.from - e.to, f.from - f.to));
        if (ff || ft || tf || tt) continue;
        tan = std::min(tan, 2.0 * 0.47 * segment_distance(e, f) / length);
        if (tan <= 0.0) return 0.0;
      }
    }
  }
  return tan;
}

}  // namespace skerry::echo
