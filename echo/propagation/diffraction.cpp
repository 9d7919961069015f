#include "echo/propagation/diffraction.hpp"

#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
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

}  // namespace skerry::echo
