#include "echo/kernel/exact_math.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

// Taylor series; |t| <= pi/4, so the first term left out is below 1e-18.
double sine_series(double t) {
  const double q = t * t;
  double s = 1.0 / 355687428096000.0;  // 1/17!
  s = s * q - 1.0 / 1307674368000.0;
  s = s * q + 1.0 / 6227020800.0;
  s = s * q - 1.0 / 39916800.0;
  s = s * q + 1.0 / 362880.0;
  s = s * q - 1.0 / 5040.0;
  s = s * q + 1.0 / 120.0;
  s = s * q - 1.0 / 6.0;
  return t + t * q * s;
}

double cosine_series(double t) {
  const double q = t * t;
  double c = 1.0 / 20922789888000.0;  // 1/16!
  c = c * q - 1.0 / 87178291200.0;
  c = c * q + 1.0 / 479001600.0;
  c = c * q - 1.0 / 3628800.0;
  c = c * q + 1.0 / 40320.0;
  c = c * q - 1.0 / 720.0;
  c = c * q + 1.0 / 24.0;
  c = c * q - 0.5;
  return 1.0 + q * c;
}

SinCos rotated(std::int64_t quarter, SinCos v) {
  switch (quarter & 3) {
    case 0:
      return v;
    case 1:
      return {v.cos, -v.sin};
    case 2:
      return {-v.sin, -v.cos};
    default:
      return {-v.cos, v.sin};
  }
}

// atan on |x| <= tan(pi/8) = 0.4142; the first term left out is below 1e-18.
double atan_series(double x) {
  const double q = x * x;
  double s = 0.0;
  for (int n = 43; n >= 3; n -= 2) s = q * (1.0 / n - s);
  return x - x * s;
}

}  // namespace

SinCos sin_cos_degrees(double degrees) {
  const double quarter = std::nearbyint(degrees / 90.0);
  const double rest = (degrees - 90.0 * quarter) * kRadiansPerDegree;
  return rotated(static_cast<std::int64_t>(quarter), {sine_series(rest), cosine_series(rest)});
}

SinCos sin_cos_units(std::uint32_t units) {
  const std::uint32_t quarter = (units + 0x20000000u) >> 30;
  const auto rest_units = static_cast<std::int32_t>(units - (quarter << 30));
  const double rest = rest_units * (std::numbers::pi / 2147483648.0);
  return rotated(quarter, {sine_series(rest), cosine_series(rest)});
}

double exact_atan2(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  const bool steep = ay > ax;
  const double ratio = steep ? ax / ay : ay / ax;
  // Above tan(pi/8): atan(r) = pi/4 + atan((r-1)/(r+1)).
  constexpr double kTanPi8 = 0.41421356237309503;
  double angle = ratio > kTanPi8 ? std::numbers::pi / 4 + atan_series((ratio - 1.0) / (ratio + 1.0))
                                 : atan_series(ratio);
  if (steep) angle = std::numbers::pi / 2 - angle;
  if (x < 0.0) angle = std::numbers::pi - angle;
  return y < 0.0 ? -angle : angle;
}

double exact_log2(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFull) | (std::uint64_t{1023} << 52));
  if (m > std::numbers::sqrt2) {
    m *= 0.5;
    ++exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);  // |s| <= 0.1716
  const double q = s * s;
  double sum = 0.0;
  for (int n = 23; n >= 3; n -= 2) sum = q * (1.0 / n + sum);
  return static_cast<double>(exponent) + 2.0 * (s + s * sum) * std::numbers::log2e;
}

double exact_exp2(double x) {
  const double whole = std::nearbyint(x);
  const double t = (x - whole) * std::numbers::ln2;  // |t| <= 0.3466
  double sum = 1.0;
  for (int n = 15; n >= 1; --n) sum = 1.0 + sum * t / n;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023);
  return sum * std::bit_cast<double>(exponent << 52);
}

double ratio_from_decibels(double db) { return exact_exp2(db * kOctavesPerDb); }
double decibels_from_ratio(double ratio) { return exact_log2(ratio) * 3.0102999566398120; }

}  // namespace skerry::echo
