#include "echo/scene/shore_guess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kShortRuler = 1.5, kLongRuler = 6.0;  // mean edges; a ratio of 4
// Length by the short ruler over length by the long one: 4^(D - 1).
constexpr double kRockyRatio = 1.1486983549970351;  // D = 1.10
constexpr double kSandyRatio = 1.0139594797900292;  // D = 1.01
constexpr std::size_t kFewestEdges = 16;
constexpr double kShortestSand = 3000.0;  // metres

// Length of the line as the ruler finds it, walked from its beginning; the rest counts as it is.
double by_ruler(std::span<const PlanePoint> line, double ruler) {
  PlanePoint foot = line[0];
  double steps = 0.0;
  const double most = 2.0 * static_cast<double>(line.size());  // never reached but by rounding
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    PlanePoint a = line[i];
    const PlanePoint b = line[i + 1];
    while (dot(b - foot, b - foot) >= ruler * ruler && steps < most) {
      // The point where a - b leaves the circle about the foot: |a + t (b - a) - foot| = ruler.
      const PlanePoint u = b - a, v = a - foot;
      const double uu = dot(u, u), uv = dot(u, v);
      const double t =
          (-uv + std::sqrt(std::max(0.0, uv * uv - uu * (dot(v, v) - ruler * ruler)))) / uu;
      foot = a = a + u * std::clamp(t, 0.0, 1.0);
      steps += 1.0;
    }
  }
  return steps * ruler + length_of(line.back() - foot);
}

}  // namespace

std::vector<std::uint32_t> stretch_starts(std::span<const std::uint64_t> vertex_ids, bool closed) {
  const std::size_t n = vertex_ids.size();
  std::vector<std::uint32_t> starts;
  if (!closed && n > 0) starts.push_back(0);
  if (n <= 2 * kStretchReach) {
    const auto rank = [&](std::size_t i) {
      return std::pair(mixed(vertex_ids[i]), mixed(vertex_ids[(i + 1) % n]));
    };
    std::size_t least = 0;
    for (std::size_t i = 1; closed && i < n; ++i) least = rank(i) < rank(least) ? i : least;
    if (closed && n > 0) starts.push_back(static_cast<std::uint32_t>(least));
    return starts;
  }
  // Treats the run and its two ends as a ring; hashes each once.
  std::vector<std::uint64_t> hash(n + 2 * kStretchReach, ~std::uint64_t{0});
  for (std::size_t i = 0; i < n; ++i) hash[kStretchReach + i] = mixed(vertex_ids[i]);
  for (std::size_t i = 0; closed && i < kStretchReach; ++i) {
    hash[i] = hash[n + i];
    hash[n + kStretchReach + i] = hash[kStretchReach + i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t* here = &hash[kStretchReach + i];
    bool least = true;
    for (std::ptrdiff_t k = 1; least && k <= static_cast<std::ptrdiff_t>(kStretchReach); ++k)
      least = here[-k] > *here && here[k] > *here;
    // The ends of an open run are where it was cut: no stretch begins beside them.
    if (least && (closed || (i >= kStretchReach && i + kStretchReach < n)))
      starts.push_back(static_cast<std::uint32_t>(i));
  }
  return starts;
}

CoastType guess_type(std::span<const GeoPoint> stretch) {
  const std::size_t n = stretch.size();
  if (n <= kFewestEdges) return CoastType::unknown;
  const GeoPoint middle = stretch[n / 2];
  if (std::fabs(middle.latitude_deg) > 89.0) return CoastType::unknown;
  const double east_per_degree = kMeanMetresPerDegree * sin_cos_degrees(middle.latitude_deg).cos;
  std::vector<PlanePoint> line(n);
  double length = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    line[i] = {wrapped_longitude(stretch[i].longitude_deg - middle.longitude_deg) * east_per_degree,
               (stretch[i].latitude_deg - middle.latitude_deg) * kMeanMetresPerDegree};
    if (i > 0) length += length_of(line[i] - line[i - 1]);
  }
  if (!(length > 0.0)) return CoastType::unknown;
  const double edge = length / static_cast<double>(n - 1);
  const double fine = by_ruler(line, kShortRuler * edge);
  const double coarse = by_ruler(line, kLongRuler * edge);
  if (fine >= kRockyRatio * coarse) return CoastType::rocky;
  if (fine <= kSandyRatio * coarse && length >= kShortestSand) return CoastType::sandy;
  return CoastType::unknown;
}

}  // namespace skerry::echo
