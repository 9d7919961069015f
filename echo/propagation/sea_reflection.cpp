#include "echo/propagation/sea_reflection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"

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

}  // namespace skerry::echo
