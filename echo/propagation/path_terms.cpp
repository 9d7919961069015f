#include "echo/propagation/path_terms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {

namespace {

double natural_exponential(double x) { return exact_exp2(x * std::numbers::log2e); }

// exp(-x) I0(x), x >= 0: Abramowitz and Stegun 9.8.1 and 9.8.2.
double scaled_bessel_i0(double x) {
  if (x <= 3.75) {
    const double t = (x / 3.75) * (x / 3.75);
    double s = 0.0045813;
    s = s * t + 0.0360768;
    s = s * t + 0.2659732;
    s = s * t + 1.2067492;
    s = s * t + 3.0899424;
    s = s * t + 3.5156229;
    return (s * t + 1.0) * natural_exponential(-x);
  }
  const double t = 3.75 / x;
  double s = 0.00392377;
  s = s * t - 0.01647633;
  s = s * t + 0.02635537;
  s = s * t - 0.02057706;
  s = s * t + 0.00916281;
  s = s * t - 0.00157565;
  s = s * t + 0.00225319;
  s = s * t + 0.01328592;
  return (s * t + 0.39894228) / std::sqrt(x);
}

}  // namespace

ReflectionPath reflection_path(double range_m, double antenna_height_m, double target_height_m,
                               double effective_earth_m) {
  const double d = range_m, h1 = antenna_height_m, h2 = target_height_m;
  const double twice = 2.0 * effective_earth_m;
  // In shares t of the range: f falls through its one root in [0, 1], from b > 0 to b - c < 0.
  const double b = twice * h1 / (d * d), c = twice * (h1 + h2) / (d * d);
  double low = 0.0, high = 1.0, t = h1 / (h1 + h2);
  for (int i = 0; i < 60; ++i) {
    const double f = ((2.0 * t - 3.0) * t + (1.0 - c)) * t + b;
    (f > 0.0 ? low : high) = t;
    const double slope = 6.0 * t * (t - 1.0) + (1.0 - c);
    double next = slope < 0.0 ? t - f / slope : low - 1.0;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::fabs(next - t);
    t = next;
    if (moved < 1e-13) break;
  }
  ReflectionPath path;
  path.to_mirror_m = t * d;
  const double d1 = t * d, d2 = (1.0 - t) * d;
  path.antenna_m = std::max(h1 - d1 * d1 / twice, 0.0);
  path.target_m = std::max(h2 - d2 * d2 / twice, 0.0);
  const double sum = path.antenna_m + path.target_m;
  const double lower = path.antenna_m - path.target_m;
  const double reflected = std::sqrt(d * d + sum * sum);
  const double direct = std::sqrt(d * d + lower * lower);
  path.difference_m = 4.0 * path.antenna_m * path.target_m / (reflected + direct);
  path.sine_of_grazing = sum / reflected;
  const double spread = effective_earth_m * d * path.sine_of_grazing;
  path.divergence = spread > 0.0 ? 1.0 / std::sqrt(1.0 + 2.0 * d1 * d2 / spread) : 0.0;
  return path;
}

double ament_roughness(double g) { return natural_exponential(-std::min(2.0 * g * g, 600.0)); }

double miller_brown_roughness(double g) { return scaled_bessel_i0(2.0 * g * g); }

double two_ray_power(double rho, double difference_m, double wavelength_m) {
  const double turns = difference_m / wavelength_m;
  const double rest = turns - std::floor(turns + 0.5);
  const double sine = sin_cos_degrees(180.0 * rest).sin;
  return (1.0 - rho) * (1.0 - rho) + 4.0 * rho * sine * sine;
}

namespace {

double ten_log10(double x) { return decibels_from_ratio(x); }

double to_power(double x, double exponent) { return exact_exp2(exponent * exact_log2(x)); }

// P.526 F(X), of the range.
double range_term_db(double x) {
  if (x >= 1.6) return 11.0 + ten_log10(x) - 17.6 * x;
  return -2.0 * ten_log10(x) - 5.6488 * to_power(x, 1.425);
}

// P.526 G(Y), of a height.
double height_term_db(double y) {
  if (y > 2.0) return 17.6 * std::sqrt(y - 1.1) - 0.5 * ten_log10(y - 1.1) - 8.0;
  return 2.0 * ten_log10(y + 0.1 * y * y * y);
}

}  // namespace

double knife_edge_loss_db(double v) {
  if (v <= -0.78) return 0.0;
  return 6.9 + 2.0 * ten_log10(std::sqrt((v - 0.1) * (v - 0.1) + 1.0) + v - 0.1);
}

double fresnel_parameter(double height_m, double to_edge_m, double beyond_m, double wavelength_m) {
  return height_m * std::sqrt(2.0 * (to_edge_m + beyond_m) / (wavelength_m * to_edge_m * beyond_m));
}

double smooth_earth_loss_db(double range_m, double antenna_height_m, double target_height_m,
                            double wavelength_m, double effective_earth_m) {
  // Per metre: (pi / (lambda ae^2))^(1/3) of range, 2 (pi^2 / (lambda^2 ae))^(1/3) of height.
  const double pi = std::numbers::pi;
  const double per_range =
      to_power(pi / (wavelength_m * effective_earth_m * effective_earth_m), 1.0 / 3.0);
  const double per_height =
      2.0 * to_power(pi * pi / (wavelength_m * wavelength_m * effective_earth_m), 1.0 / 3.0);
  return -(range_term_db(per_range * range_m) + height_term_db(per_height * antenna_height_m) +
           height_term_db(per_height * target_height_m));
}

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
  // No diffraction is computed for a path that is well clear.
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
