#include "echo/propagation/path_terms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/propagation/diffraction.hpp"
#include "echo/propagation/sea_reflection.hpp"
#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
double gas_db_per_km(Band band) { return band == Band::x ? 0.0136 : 0.0075; }

PathConditions path_conditions(const RadarSet& set, const Atmosphere& atmosphere,
                               double wave_height_m) {
  PathConditions conditions;
  conditions.wavelength_m = set.wavelength_m();
  conditions.antenna_height_m = set.antenna_height_m;
  conditions.effective_earth_m = atmosphere.k_factor * kEarthRadius;
  conditions.wave_height_m = wave_height_m;
  conditions.ducting = atmosphere.ducting;
  conditions.gas_db_km = gas_db_per_km(set.band());
  return conditions;
}

PathTerms path_terms(const PathConditions& conditions, double range_m, double height_m) {
  const double d = std::max(range_m, kNearestPath);
  const double h1 = conditions.antenna_height_m;
  const double h2 = std::clamp(height_m, kLowestPoint, kHighestPoint);
  const double earth = conditions.effective_earth_m;
  const double roots = std::sqrt(h1) + std::sqrt(h2);
  const double left = 1.0 - conditions.ducting;
  const auto smooth_earth = [&](double of_earth) {
    const double loss = smooth_earth_loss_db(d, h1, h2, conditions.wavelength_m, of_earth);
    return std::clamp(loss, 0.0, kGreatestLossDb);
  };
  PathTerms terms;
  if (d >= std::sqrt(2.0 * earth) * roots) {
    terms.loss_db = left * smooth_earth(earth);
    return terms;
  }
  const ReflectionPath path = reflection_path(d, h1, h2, earth);
  terms.difference_m = path.difference_m;
  const double deviation = 0.25 * conditions.wave_height_m;
  const double g =
      2.0 * std::numbers::pi * deviation * path.sine_of_grazing / conditions.wavelength_m;
  terms.rho = path.divergence * (deviation > 0.0 ? miller_brown_roughness(g) : 1.0);
  const double clearance =
      std::sqrt(2.0 * path.difference_m / conditions.wavelength_m) / kFullClearance;
  // What stands well clear is not worked out.
  terms.loss_db = clearance > 2.0
                      ? -20.0 * clearance
                      : left * (1.0 - clearance) * smooth_earth(0.5 * (d / roots) * (d / roots));
  return terms;
}

double point_reference(const PathConditions& conditions, double range_m, double height_m) {
  const PathTerms terms = path_terms(conditions, range_m, height_m);
  const double full = kFullDifference * conditions.wavelength_m;
  const double rho = terms.rho * std::min(1.0, terms.difference_m / full);
  const double power =
      two_ray_power(rho, std::max(terms.difference_m, full), conditions.wavelength_m);
  const double loss = std::max(terms.loss_db, 0.0);
  const double gas = conditions.gas_db_km * std::max(range_m, kNearestPath) / 1000.0;
  const double one_way = std::max(power, kNullFloor) * ratio_from_decibels(-(loss + gas));
  return one_way * one_way;
}

double body_reference(const PathConditions& conditions, double range_m, double height_m) {
  const double top = std::max(height_m, kLowestPoint);
  // Lobes are at least lambda R / (2 h1) high.
  const double d = std::max(range_m, kNearestPath);
  const double lobe = conditions.wavelength_m * d / (2.0 * conditions.antenna_height_m);
  const auto steps = static_cast<int>(std::clamp(50.0 * top / lobe, 400.0, 2e6));
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) sum += point_reference(conditions, d, top * (i + 0.5) / steps);
  return sum / steps;
}

}  // namespace skerry::echo
