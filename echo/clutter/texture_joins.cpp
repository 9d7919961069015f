#include "echo/clutter/texture_joins.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {

double variance_lost(double correlation, std::uint32_t steps) {
  const double n = steps;
  return (1.0 - correlation) * (n * n - 1.0) / (3.0 * n * n);
}

double texture_correlation(double gaussian_correlation, double nu) {
  const double slope = (1.0 + nu) * std::numbers::ln2 * exact_log2(1.0 + 1.0 / nu);
  return std::max(0.0, 1.0 - (1.0 - gaussian_correlation) * slope);
}

double mixture_correlation(double apart) {
  constexpr int kPlaces = 64;
  double sum = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double a = (k + 0.5) / kPlaces, b = a + apart;
    const double c = b - 1.0;  // beyond the second neighbour
    const double shared = c <= 0.0 ? (1.0 - a) * (1.0 - b) + a * b : a * (1.0 - c);
    const double other = c <= 0.0 ? b : c;
    sum += shared / std::sqrt((a * a + (1.0 - a) * (1.0 - a)) *
                              (other * other + (1.0 - other) * (1.0 - other)));
  }
  return sum / kPlaces;
}

}  // namespace skerry::echo
