#include "echo/clutter/nrl_sea.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

constexpr double kLogTenOfTwo = 0.30102999566398120;

double log10_of(double x) { return exact_log2(x) * kLogTenOfTwo; }
// base^exponent of a positive base.
double power_of(double base, double exponent) { return exact_exp2(exponent * exact_log2(base)); }

}  // namespace

double sea_reflectivity(double frequency_hz, Polarisation polarisation, double grazing_deg,
                        double sea_state) {
  struct Coefficients {
    double c1, c2, c3, c4, c5;
  };
  constexpr Coefficients kHh{-73.0, 20.781, 7.351, 25.65, 0.0054};
  constexpr Coefficients kVv{-50.796, 25.93, 0.7093, 21.588, 0.00211};
  const Coefficients& c = polarisation == Polarisation::hh ? kHh : kVv;
  const double psi = std::clamp(grazing_deg, 1e-4, 60.0);
  const double state = std::clamp(sea_state, 0.0, 6.0);
  const double decibels = c.c1 + c.c2 * log10_of(sin_cos_degrees(psi).sin) +
                          (27.5 + c.c3 * psi) * log10_of(frequency_hz * 1e-9) / (1.0 + 0.95 * psi) +
                          c.c4 * power_of(state + 1.0, 1.0 / (2.0 + 0.085 * psi + 0.033 * state)) +
                          c.c5 * psi * psi;
  return ratio_from_decibels(decibels);
}

double wind_spread(double wavelength_m, double grazing_rad) {
  return 0.2 * std::max(0.0, 1.0 - 2.8 * grazing_rad) * power_of(wavelength_m + 0.015, -0.4);
}

double bessel_i0(double x) {
  const double q = 0.25 * x * x;
  double sum = 1.0, term = 1.0;
  for (int n = 1; n <= 60 && term > 1e-17 * sum; ++n) {
    term *= q / (double{1} * n * n);
    sum += term;
  }
  return sum;
}

double wind_of_sea_state(double sea_state) {
  return sea_state > 0.0 ? 3.16 * power_of(sea_state, 0.8) : 0.0;
}

double sine_of_grazing(double range_m, double antenna_height_m, double effective_earth_m) {
  const double twice = 2.0 * effective_earth_m;
  return std::min(1.0,
                  antenna_height_m / range_m * (1.0 + antenna_height_m / twice) - range_m / twice);
}

}  // namespace skerry::echo
