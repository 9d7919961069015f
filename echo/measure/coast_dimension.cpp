#include "echo/measure/coast_dimension.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skerry::echo {
namespace {

double apart(PlanePoint a, PlanePoint b) {
  return std::hypot(a.east_m - b.east_m, a.north_m - b.north_m);
}

// Steps of the ruler along the line from vertex `start`, the rest as a part of a step; and how much
// of the line's own vertices that covered.
double steps(std::span<const PlanePoint> line, std::size_t start, double ruler) {
  PlanePoint foot = line[start];
  double count = 0.0;
  for (std::size_t i = start; i + 1 < line.size(); ++i) {
    PlanePoint a = line[i];
    const PlanePoint b = line[i + 1];
    while (apart(foot, b) >= ruler) {
      // Where segment a - b leaves the circle about the foot: |a + t (b - a) - foot| = ruler.
      const PlanePoint u = b - a, v = a - foot;
      const double uu = u.east_m * u.east_m + u.north_m * u.north_m;
      const double uv = u.east_m * v.east_m + u.north_m * v.north_m;
      const double vv = v.east_m * v.east_m + v.north_m * v.north_m - ruler * ruler;
      const double t = (-uv + std::sqrt(std::max(0.0, uv * uv - uu * vv))) / uu;
      foot = a + u * std::clamp(t, 0.0, 1.0);
      a = foot;
      count += 1.0;
    }
  }
  return count + apart(foot, line.back()) / ruler;
}

}  // namespace

double divider_dimension(std::span<const PlanePoint> line, double shortest_ruler_m,
                         double longest_ruler_m) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += apart(line[i], line[i + 1]);
  if (!(length >= 4.0 * longest_ruler_m) || !(shortest_ruler_m > 0.0) ||
      !(longest_ruler_m > shortest_ruler_m))
    return std::numeric_limits<double>::quiet_NaN();
  constexpr int kRulers = 8;
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (int k = 0; k < kRulers; ++k) {
    const double x = std::log(shortest_ruler_m) +
                     std::log(longest_ruler_m / shortest_ruler_m) * k / (kRulers - 1.0);
    const double ruler = std::exp(x);
    const double y = std::log(std::max(steps(line, 0, ruler), 1e-9) * ruler);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return 1.0 - (kRulers * sxy - sx * sy) / (kRulers * sxx - sx * sx);
}

}  // namespace skerry::echo
