#include "echo/artefacts/indirect_echoes.hpp"

#include <algorithm>
#include <cmath>

#include "echo/artefacts/false_echoes.hpp"
#include "echo/artefacts/shadow_sectors.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/scene/structures.hpp"
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

namespace {

// Width of the uniform beam that gathers as much, in beam widths (SOURCES.md "Sets").
constexpr double kEffective = 0.7527;

// Range at which a ray meets a wall, metres; 0 if it does not.
double range_to(const Wall& wall, PlanePoint own_ship, SinCos ray) {
  const PlanePoint a = wall.from - own_ship, along = wall.to - wall.from;
  const double crossing = right_of(ray, along);
  if (crossing == 0.0) return 0.0;
  const double part = -right_of(ray, a) / crossing;
  if (part < 0.0 || part > 1.0) return 0.0;
  const double range =
      (a.east_m + part * along.east_m) * ray.sin + (a.north_m + part * along.north_m) * ray.cos;
  return std::max(range, 0.0);
}

}  // namespace

void add_bridge_echoes(const RadarModel& model, const Scene& scene, const SpokeAim& aim,
                       const BearingSpan& where, std::vector<PointEcho>& out) {
  if (!scene.structure_index || scene.own_hull.length_m <= 0.0) return;
  std::vector<std::uint32_t> near;
  const std::uint32_t half = where.width_units / 2;
  scene.structure_index->walls_near(where.first_units + half, half, near);
  const std::vector<Wall>& walls = scene.structure_index->structures().walls;
  std::erase_if(near, [&](std::uint32_t w) { return walls[w].kind != ObjectClass::bridge; });
  if (near.empty()) return;
  near.resize(std::min(near.size(), kMostBridges));

  const double beam = model.set.beam_width_deg * kRadiansPerDegree;
  const auto step = static_cast<std::uint32_t>(0.5 * beam * kUnitsPerRadian);
  const double step_radians = step / kUnitsPerRadian;
  const double reach = model.cell_m * model.geometry.cells;
  const std::uint32_t bow = aim.plane_units - aim.relative_units;
  const std::uint32_t last_place = 0xFFFFFFFFu / step;
  for (std::uint64_t place = (std::uint64_t{where.first_units} + step - 1) / step;; ++place) {
    const auto bearing = static_cast<std::uint32_t>(place % (last_place + 1) * step);
    if (!where.holds(bearing)) break;
    const SinCos ray = sin_cos_units(bearing);
    const double own = own_cross_section(scene.own_hull, model.set.frequency_hz, bearing - bow);
    for (const std::uint32_t w : near) {
      const double range = range_to(walls[w], aim.own_ship, ray);
      if (range <= 0.0 || range > kBridgeReach) continue;
      const double height = std::max(double{walls[w].top_m} - double{walls[w].base_m}, kDeckDepth);
      const double first = model.unit_snr * height * step_radians / (range * range * range);
      const double ratio = second_trip_ratio(own, height * range * kEffective * beam, range);
      double power = first;
      for (int trip = 2; trip <= kMostTrips; ++trip) {
        power *= ratio;
        if (power < double{FalseEchoes::kLeastPower} || trip * range > reach) break;
        PointEcho echo;
        echo.range_m = trip * range;
        echo.bearing_units = bearing;
        echo.power = static_cast<float>(power);
        echo.body = false_body(static_cast<std::uint32_t>(place) ^ 0x8000'0000u,
                               static_cast<std::uint64_t>(w) << 8 | static_cast<unsigned>(trip));
        echo.height_m = walls[w].top_m;
        out.push_back(echo);
      }
    }
  }
}

}  // namespace skerry::echo
