#include "echo/measure/line_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {

double LineFit::error_at(double x) const {
  const double typical = static_cast<double>(points) / weight;
  return scatter * std::sqrt(typical + 1.0 / weight + (x - mean_x) * (x - mean_x) / spread_x);
}

LineFit fitted_line(std::span<const double> x, std::span<const double> y,
                    std::span<const double> weights) {
  LineFit fit;
  fit.points = std::min(x.size(), y.size());
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  double mean_y = 0.0;
  for (std::size_t i = 0; i < fit.points; ++i) {
    fit.weight += weight(i);
    fit.mean_x += weight(i) * x[i];
    mean_y += weight(i) * y[i];
  }
  fit.mean_x /= fit.weight;
  mean_y /= fit.weight;
  double sxy = 0.0;
  for (std::size_t i = 0; i < fit.points; ++i) {
    fit.spread_x += weight(i) * (x[i] - fit.mean_x) * (x[i] - fit.mean_x);
    sxy += weight(i) * (x[i] - fit.mean_x) * (y[i] - mean_y);
  }
  if (fit.points < 2 || !(fit.spread_x > 0.0)) {
    fit.slope = fit.intercept = fit.slope_error = fit.scatter = kNotKnown;
    return fit;
  }
  fit.slope = sxy / fit.spread_x;
  fit.intercept = mean_y - fit.slope * fit.mean_x;
  double squares = 0.0;
  for (std::size_t i = 0; i < fit.points; ++i) {
    const double off = y[i] - fit.at(x[i]);
    squares += weight(i) * off * off;
  }
  if (fit.points > 2) fit.scatter = std::sqrt(squares / static_cast<double>(fit.points - 2));
  if (!weights.empty()) fit.scatter = std::max(fit.scatter, 1.0);
  fit.slope_error = fit.scatter / std::sqrt(fit.spread_x);
  return fit;
}

double student95(int degrees_of_freedom) {
  constexpr std::array<double, 10> kTable = {12.706, 4.303, 3.182, 2.776, 2.571,
                                             2.447,  2.365, 2.306, 2.262, 2.228};
  if (degrees_of_freedom < 1) return std::numeric_limits<double>::infinity();
  const std::size_t row = static_cast<std::size_t>(degrees_of_freedom) - 1;
  return row < kTable.size() ? kTable[row] : 1.96 + 2.6 / degrees_of_freedom;
}

Bootstrap bootstrap(std::uint32_t items, const Statistic& statistic, std::uint64_t seed,
                    int draws) {
  std::vector<double> found;
  std::vector<std::uint32_t> drawn(items);
  for (int d = 0; d < draws && items > 0; ++d) {
    for (std::uint32_t i = 0; i < items; ++i) {
      const double u = as_unit(mixed(seed, static_cast<std::uint64_t>(d), i));
      drawn[i] = static_cast<std::uint32_t>(u * items);
    }
    const double value = statistic(drawn);
    if (std::isfinite(value)) found.push_back(value);
  }
  if (found.size() < 2) return {kNotKnown, {kNotKnown, kNotKnown}};
  std::sort(found.begin(), found.end());
  const double n = static_cast<double>(found.size());
  double mean = 0.0, squares = 0.0;
  for (double v : found) mean += v / n;
  for (double v : found) squares += (v - mean) * (v - mean);
  const auto at = [&](double share) {
    return found[static_cast<std::size_t>(std::lround(share * (n - 1.0)))];
  };
  return {std::sqrt(squares / (n - 1.0)), {at(0.025), at(0.975)}};
}

}  // namespace skerry::echo
