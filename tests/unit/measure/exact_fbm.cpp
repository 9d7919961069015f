#include "tests/unit/measure/exact_fbm.hpp"

#include <fftw3.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "echo/kernel/hash.hpp"

namespace skerry::test {
namespace {

using Complex = std::complex<double>;

void transform(std::vector<Complex>& values) {
  auto* data = reinterpret_cast<fftw_complex*>(values.data());
  const fftw_plan plan =
      fftw_plan_dft_1d(static_cast<int>(values.size()), data, data, FFTW_FORWARD, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

// Two independent standard normal numbers (Box and Muller 1958).
Complex normal_pair(std::uint64_t seed, std::uint64_t k) {
  const double u = 1.0 - echo::as_unit(echo::mixed(seed, k, 1));
  const double turn = 2.0 * std::numbers::pi * echo::as_unit(echo::mixed(seed, k, 2));
  return std::polar(std::sqrt(-2.0 * std::log(u)), turn);
}

}  // namespace

std::vector<double> exact_fbm(std::size_t steps, double hurst, std::uint64_t seed) {
  const std::size_t n = 2 * steps;
  const auto power = [&](double k) { return std::pow(std::fabs(k), 2.0 * hurst); };
  std::vector<Complex> circle(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i <= steps ? i : n - i);
    circle[i] = 0.5 * (power(k + 1.0) - 2.0 * power(k) + power(k - 1.0));
  }
  transform(circle);
  for (std::size_t i = 0; i < n; ++i) {
    const double eigenvalue = circle[i].real();
    if (eigenvalue < -1e-9) throw std::logic_error("the circulant embedding is not positive");
    circle[i] =
        std::sqrt(std::fmax(eigenvalue, 0.0) / static_cast<double>(n)) * normal_pair(seed, i);
  }
  transform(circle);
  std::vector<double> heights(steps + 1);
  for (std::size_t i = 0; i < steps; ++i) heights[i + 1] = heights[i] + circle[i].real();
  return heights;
}

std::vector<PlanePoint> koch_curve(int iterations, double length_m) {
  std::vector<PlanePoint> line = {{0.0, 0.0}, {length_m, 0.0}};
  for (int i = 0; i < iterations; ++i) {
    std::vector<PlanePoint> finer = {line.front()};
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const PlanePoint third = (line[k + 1] - line[k]) * (1.0 / 3.0);
      const PlanePoint up = {-third.north_m, third.east_m};
      finer.push_back(line[k] + third);
      finer.push_back(line[k] + third * 1.5 + up * std::sqrt(0.75));
      finer.push_back(line[k] + third * 2.0);
      finer.push_back(line[k + 1]);
    }
    line = std::move(finer);
  }
  return line;
}

std::vector<PlanePoint> turned(const std::vector<PlanePoint>& line, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, c = std::cos(a), s = std::sin(a);
  std::vector<PlanePoint> out;
  for (PlanePoint p : line)
    out.push_back({c * p.east_m - s * p.north_m, s * p.east_m + c * p.north_m});
  return out;
}

}  // namespace skerry::test
