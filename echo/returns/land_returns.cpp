#include "echo/returns/land_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/land_ray.hpp"
#include "echo/returns/natural_land.hpp"
#include "echo/returns/shore_returns.hpp"

namespace skerry::echo {
namespace {

constexpr std::array<NoiseOctave, 2> kBroad = {{{2300.0, 0.6f}, {900.0, 0.4f}}};
constexpr std::array<NoiseOctave, 4> kFine = {
    {{330.0, 0.45f}, {130.0, 0.3f}, {52.0, 0.17f}, {21.0, 0.08f}}};

std::span<const NoiseOctave> visible(std::span<const NoiseOctave> octaves, double cell_m) {
  std::size_t n = octaves.size();
  while (n > 1 && octaves[n - 1].wavelength_m < 2.0 * cell_m) --n;
  return octaves.first(n);
}

}  // namespace

std::span<const NoiseOctave> broad_octaves(double cell_m) { return visible(kBroad, cell_m); }
std::span<const NoiseOctave> fine_octaves(double cell_m) { return visible(kFine, cell_m); }

void add_land(std::span<const LandInterval> land, const LandModel& model, const LatticePath& path,
              std::span<float> power, GroundProfile* profile) {
  LandRay ray(model, power);
  NaturalLand natural(model, path);
  for (const LandInterval& stretch : land) {
    const auto first = static_cast<std::size_t>(stretch.begin_m / model.cell_m);
    if (first >= power.size()) break;
    if (profile) profile->fill(first, static_cast<float>(ray.shadow()));
    natural.add(stretch.begin_m, stretch.end_m, stretch, ray, profile, power);
  }
  if (profile) profile->fill(power.size(), static_cast<float>(ray.shadow()));
}

LatticePath lattice_path(GeoPoint own_ship, PlanePoint sailed, std::uint32_t true_bearing_units,
                         double cell_m) {
  const SinCos lat = sin_cos_degrees(own_ship.latitude_deg);
  const SinCos bearing = sin_cos_units(true_bearing_units);
  constexpr double kMetresPerDegree = kEarthRadius * std::numbers::pi / 180.0;
  const double cos_lat = std::max(lat.cos, 1e-6);
  double east_scale = 1.0;
  while (east_scale > cos_lat && east_scale > 1.0 / 1024.0) east_scale *= 0.5;
  const double tan_lat = std::clamp(lat.sin / cos_lat, -1000.0, 1000.0);
  // At range s: latitude + s cos - s^2 sin^2 tan / 2R, longitude (s sin + s^2 sin cos tan / R) /
  // cos.
  const double squeeze = east_scale / cos_lat;
  LatticePath path;
  path.north1 = bearing.cos * cell_m;
  path.north2 = -0.5 * bearing.sin * bearing.sin * tan_lat / kEarthRadius * cell_m * cell_m;
  path.east1 = bearing.sin * squeeze * cell_m;
  path.east2 = bearing.sin * bearing.cos * tan_lat / kEarthRadius * squeeze * cell_m * cell_m;
  // From the own ship to the middle of cell 0.
  path.north0 = own_ship.latitude_deg * kMetresPerDegree + sailed.north_m + 0.5 * path.north1;
  path.east0 = own_ship.longitude_deg * kMetresPerDegree * east_scale + sailed.east_m * squeeze +
               0.5 * path.east1;
  return path;
}

}  // namespace skerry::echo
