#include "echo/clutter/k_shape.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

constexpr double kTwoOfTen = 3.3219280948873623;  // log2(10)

double log2_shape(double grazing_deg, double cell_area_m2, Polarisation polarisation) {
  const double psi = std::clamp(grazing_deg, 0.1, 10.0);
  const double k = polarisation == Polarisation::hh ? 2.09 : 1.39;
  return (2.0 / 3.0) * exact_log2(psi) + 0.625 * exact_log2(std::max(cell_area_m2, 1e-3)) -
         k * kTwoOfTen;
}

double bounded(double log2_nu) {
  return std::clamp(exact_exp2(log2_nu), kLeastShape, kGreatestShape);
}

}  // namespace

double k_shape(double grazing_deg, double cell_area_m2, Polarisation polarisation) {
  return bounded(log2_shape(grazing_deg, cell_area_m2, polarisation));
}

double k_shape_in_swell(double grazing_deg, double cell_area_m2, Polarisation polarisation,
                        double swell_deg) {
  return bounded(log2_shape(grazing_deg, cell_area_m2, polarisation) -
                 kTwoOfTen / 3.0 * sin_cos_degrees(2.0 * swell_deg).cos);
}

}  // namespace skerry::echo
