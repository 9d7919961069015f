// How many terms of the Weierstrass-Mandelbrot series are added up.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "echo/fractal/weierstrass_series.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::bench {
namespace {

constexpr double kEdge = 150.0;  // metres: the median edge of the chart
constexpr int kPlaces = 4096;    // along it, 4 cm apart
constexpr double kGamma = 1.5, kDimension = 1.3;
constexpr double kAmplitude = 0.1;  // of the first term, in edge lengths
constexpr int kReference = 60;

std::vector<double> offsets(int terms) {
  echo::WeierstrassSeries series;
  series.gamma = kGamma;
  series.dimension = kDimension;
  series.phases = echo::SeriesPhases::random;
  series.seed = 7;
  series.first = 0;
  series.last = terms - 1;
  std::vector<double> out(kPlaces);
  for (int i = 0; i < kPlaces; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kPlaces;
    out[static_cast<std::size_t>(i)] = kEdge * kAmplitude * echo::weierstrass(series, t);
  }
  return out;
}

// 2 - half the slope of the variogram between lags of 1 and 32 places.
double variogram_dimension(const std::vector<double>& z) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  int n = 0;
  for (std::size_t lag = 1; lag <= 32; lag *= 2, ++n) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < z.size(); ++i)
      sum += (z[i + lag] - z[i]) * (z[i + lag] - z[i]);
    const double x = std::log(static_cast<double>(lag));
    const double y = std::log(sum / static_cast<double>(z.size() - lag));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return 2.0 - 0.5 * (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

std::vector<ErrorRow> study_series(const ErrorStudy& study) {
  const std::vector<double> truth = offsets(kReference);
  std::vector<ErrorRow> rows;
  for (const int terms : {4, 8, 12, 16, 20, 24, 32, kReference}) {
    study.progress(fmt::format("series: {} terms", terms));
    ErrorRow row;
    row.knob = "series length";
    const double bound = kEdge * kAmplitude * echo::high_tail_bound(kGamma, kDimension, terms - 1);
    row.setting = fmt::format("{} terms (bound {:.2g} m)", terms, bound);
    if (terms == kReference) row.setting = fmt::format("{} terms (reference)", terms);
    std::vector<double> found;
    const double seconds = median_seconds(study.repetitions, [&] { found = offsets(terms); });
    std::vector<double> errors;
    for (std::size_t i = 0; i < found.size(); ++i) errors.push_back(std::fabs(found[i] - truth[i]));
    fill_errors(errors, row);
    // A picture of as many vertices as there are spokes in a turn, times 25: the default's at 6 NM.
    row.microseconds_per_spoke = 1e6 * seconds / kPlaces * 25.0;
    row.dimension = variogram_dimension(found);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace skerry::bench
