#include "echo/artefacts/bridge_echoes.hpp"

#include <algorithm>

#include "echo/artefacts/false_echoes.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/scene/structures.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

// Of the beam width, as wide as the uniform beam that gathers as much (SOURCES.md "Sets").
constexpr double kEffective = 0.7527;

// Where a ray meets a wall, metres; 0 where it does not.
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
