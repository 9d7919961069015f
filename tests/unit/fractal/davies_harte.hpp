// Exact fractional Brownian motion, as the oracle of the law tests.
#pragma once

#include <fftw3.h>

#include <cmath>
#include <complex>
#include <random>
#include <stdexcept>
#include <vector>

namespace skerry::echo::samples {

// Source: Davies and Harte 1987; Wood and Chan 1994: the covariance of n increments laid round a
// circle of 2n has only positive eigenvalues, so that noise shaped by their roots has exactly it.
class DaviesHarte {
 public:
  DaviesHarte(std::size_t steps, double hurst, std::uint64_t seed)
      : steps_(steps), root_(2 * steps), spectrum_(2 * steps), random_(seed) {
    const double scale = std::pow(static_cast<double>(steps), -2.0 * hurst);
    const auto power = [&](double lag) { return std::pow(std::fabs(lag), 2.0 * hurst); };
    for (std::size_t i = 0; i <= steps; ++i) {
      const double lag = static_cast<double>(i);
      const double covariance =
          0.5 * scale * (power(lag + 1.0) - 2.0 * power(lag) + power(lag - 1.0));
      spectrum_[i] = covariance;
      if (i > 0 && i < steps) spectrum_[2 * steps - i] = covariance;
    }
    auto* const data = reinterpret_cast<fftw_complex*>(spectrum_.data());
    plan_ = fftw_plan_dft_1d(static_cast<int>(2 * steps), data, data, FFTW_FORWARD, FFTW_ESTIMATE);
    fftw_execute(plan_);
    for (std::size_t i = 0; i < 2 * steps; ++i) {
      if (spectrum_[i].real() < 0.0) throw std::logic_error("not a covariance");
      root_[i] = std::sqrt(spectrum_[i].real() / static_cast<double>(2 * steps));
    }
  }
  ~DaviesHarte() { fftw_destroy_plan(plan_); }
  DaviesHarte(const DaviesHarte&) = delete;
  DaviesHarte& operator=(const DaviesHarte&) = delete;

  // X(i / steps), i = 0 .. steps, X(0) = 0, Var X(t) = t^2H.
  std::vector<double> path() {
    for (std::size_t i = 0; i < 2 * steps_; ++i) {
      const double re = normal_(random_), im = normal_(random_);
      spectrum_[i] = root_[i] * std::complex<double>(re, im);
    }
    fftw_execute(plan_);
    std::vector<double> x(steps_ + 1, 0.0);
    for (std::size_t i = 0; i < steps_; ++i) x[i + 1] = x[i] + spectrum_[i].real();
    return x;
  }

 private:
  std::size_t steps_;
  std::vector<double> root_;
  std::vector<std::complex<double>> spectrum_;
  fftw_plan plan_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace skerry::echo::samples
