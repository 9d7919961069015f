// Straight lines through measured points, and how far chance may have moved what was measured.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace skerry::echo {

// Stands for an unknown value.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// y = intercept + slope x by least squares.  All NaN for fewer than two different x.
struct LineFit {
  double slope = 0.0;
  double intercept = 0.0;
  double slope_error = 0.0;  // standard error from the scatter about the line; 0 for two points
  // Standard deviation of y of weight 1 about the line, n - 2 degrees of freedom.
  double scatter = 0.0;
  double at(double x) const { return intercept + slope * x; }
  // Standard error of a further y at x: of the line and of the scatter together.
  double error_at(double x) const;
  std::size_t points = 0;
  double weight = 0.0;                  // of all points
  double mean_x = 0.0, spread_x = 0.0;  // mean, and sum of (x - mean)^2
};
// `weights`: 1 / error^2 of each y; empty: all 1, the errors unknown.  Known errors that the
// scatter stays below count as they are stated.
LineFit fitted_line(std::span<const double> x, std::span<const double> y,
                    std::span<const double> weights = {});

// How many standard errors reach to 95 % either side, Student's t.  Error: 0.01 from 10 degrees on.
double student95(int degrees_of_freedom);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// Spread of a statistic when the sample is drawn anew from itself (bootstrap).
struct Bootstrap {
  double standard_error = 0.0;
  Interval interval95;  // percentiles 2.5 and 97.5
};

// Draws `draws` samples of `items` numbers in 0 .. items-1, with replacement and by `seed` alone,
// and asks for the statistic of each.  Statistics that are not finite are left out; all NaN where
// fewer than two remain.  Source: Efron (1979); of blocks of what is correlated, Kuensch (1989).
using Statistic = std::function<double(std::span<const std::uint32_t> drawn)>;
Bootstrap bootstrap(std::uint32_t items, const Statistic& statistic, std::uint64_t seed = 1,
                    int draws = 400);

// A fractal dimension and how sure it is.
struct DimensionEstimate {
  double dimension = 0.0;
  double standard_error = 0.0;
  Interval interval95;
};

}  // namespace skerry::echo
