#include "echo/artefacts/indirect_echoes.hpp"

#include <algorithm>
#include <cmath>

#include "echo/artefacts/false_echoes.hpp"
#include "echo/artefacts/shadow_sectors.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/targets/sector_view.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

// Each step leaves of the error what the mast's radius is of its distance, twice at most.
constexpr int kMirrorSteps = 4;
constexpr std::uint64_t kFirstMast = 16;  // ways below are trips to and fro
constexpr double kShortest = 1e-3;        // metres, or of a unit vector

double length(double x, double y) { return std::sqrt(x * x + y * y); }

// The antenna never stands inside the mast.
double mast_radius(const Obstruction& o) { return std::min(0.5 * o.width_m, 0.9 * o.distance_m); }

}  // namespace

Detour detour_by(const Obstruction& obstruction, double target_range_m, double off_bow_rad) {
  // From the antenna: along the line to the mast, and to the right of it.
  const double off = off_bow_rad - obstruction.bearing_deg * kRadiansPerDegree;
  const SinCos at = sin_cos_degrees(off * kDegreesPerRadian);
  const double along = target_range_m * at.cos, across = target_range_m * at.sin;
  const double radius = mast_radius(obstruction);

  // The point that mirrors has its normal half-way between antenna and target: found from the
  // mast's middle, then from the point so found.
  double mirror_along = obstruction.distance_m, mirror_across = 0.0, incidence_cos = 0.0;
  double there = obstruction.distance_m, onward = 0.0;
  for (int step = 0; step < kMirrorSteps; ++step) {
    there = std::max(length(mirror_along, mirror_across), kShortest);
    onward = std::max(length(along - mirror_along, across - mirror_across), kShortest);
    double normal_along = (along - mirror_along) / onward - mirror_along / there;
    double normal_across = (across - mirror_across) / onward - mirror_across / there;
    const double sum = length(normal_along, normal_across);
    incidence_cos = 0.5 * sum;
    if (sum < kShortest) break;  // right behind the mast: nothing is thrown back
    mirror_along = obstruction.distance_m + radius * normal_along / sum;
    mirror_across = radius * normal_across / sum;
  }
  const double front = 0.5 * radius * incidence_cos;
  Detour detour;
  detour.ratio = obstruction.reflectivity * obstruction.reflectivity * front / (there + front);
  detour.off_rad = exact_atan2(mirror_across, mirror_along);
  detour.longer_m = there + onward - target_range_m;
  return detour;
}

void add_indirect_echoes(const Scene& scene, std::uint32_t bow_units, const BearingSpan& where,
                         std::span<const PointEcho> strong, std::vector<PointEcho>& out) {
  const std::size_t count = std::min(scene.obstructions.size(), OwnShipGain::kMostObstructions);
  for (std::size_t k = 0; k < count; ++k) {
    const Obstruction& mast = scene.obstructions[k];
    const std::uint32_t middle =
        bow_units + RelativeBearing::from(degrees(mast.bearing_deg)).units();
    const double radius = mast_radius(mast);
    const std::uint32_t half = units_of_radians(exact_atan2(radius, mast.distance_m - radius));
    if (!BearingSpan{where.first_units - half, where.width_units + 2 * half}.holds(middle))
      continue;
    const double front = 0.5 * radius;
    const double most =
        mast.reflectivity * mast.reflectivity * front / (mast.distance_m - radius + front);
    for (const PointEcho& p : strong) {
      if (double{p.power} * most * most < double{FalseEchoes::kLeastPower}) continue;
      const double off_bow = (p.bearing_units - bow_units) * kDegreesPerUnit * kRadiansPerDegree;
      const Detour detour = detour_by(mast, p.range_m, off_bow);
      const double power = double{p.power} * detour.ratio * detour.ratio;
      const std::uint32_t bearing = middle + units_of_radians(detour.off_rad);
      if (power < double{FalseEchoes::kLeastPower} || !where.holds(bearing)) continue;
      PointEcho echo = p;
      echo.range_m += detour.longer_m;
      echo.bearing_units = bearing;
      echo.power = static_cast<float>(power);
      echo.body = false_body(p.body, kFirstMast + k);
      out.push_back(echo);
    }
  }
}

}  // namespace skerry::echo
