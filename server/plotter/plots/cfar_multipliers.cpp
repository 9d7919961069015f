#include "server/plotter/plots/cfar_multipliers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace skerry::server {
namespace {

constexpr std::uint32_t kMostCells = 1024;

void require_cfar(bool right, std::string_view what) {
  if (!right) throw std::invalid_argument(fmt::format("CFAR multiplier: {}", what));
}

void require_cells(std::uint32_t cells, double false_alarms) {
  require_cfar(cells >= 1 && cells <= kMostCells, "cells must be 1 to 1024");
  require_cfar(false_alarms > 0.0 && false_alarms < 1.0, "false_alarms must be between 0 and 1");
}

double cell_mean_alarms(std::uint32_t cells, double a) {
  return std::pow(1.0 + a / cells, -static_cast<double>(cells));
}

double smallest_of_alarms(std::uint32_t cells, double a) {
  const std::uint32_t n = cells / 2;
  const double t = a / n;
  double term = std::pow(2.0 + t, -static_cast<double>(n)), sum = 0.0;
  for (std::uint32_t k = 0; k < n; ++k) {
    sum += term;
    term *= (n + k) / ((k + 1.0) * (2.0 + t));
  }
  return 2.0 * sum;
}

double greatest_of_alarms(std::uint32_t cells, double a) {
  const std::uint32_t n = cells / 2;
  return 2.0 * std::pow(1.0 + a / n, -static_cast<double>(n)) - smallest_of_alarms(cells, a);
}

double ordered_alarms(std::uint32_t cells, std::uint32_t rank, double a) {
  double share = 1.0;
  for (std::uint32_t i = 0; i < rank; ++i) share *= (cells - i) / (cells - i + a);
  return share;
}

// Where a share that falls from 1 to 0 is `wanted`; halves the interval to the last bit but few.
template <typename Share>
double solve(Share&& share, double wanted) {
  double low = 0.0, high = 1.0;
  while (share(high) > wanted && high < 1e300) high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (share(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double cell_mean_multiplier(std::uint32_t cells, double false_alarms) {
  require_cells(cells, false_alarms);
  return cells * (std::pow(false_alarms, -1.0 / cells) - 1.0);
}

double greatest_of_multiplier(std::uint32_t cells, double false_alarms) {
  require_cells(cells, false_alarms);
  require_cfar(cells % 2 == 0, "cells must be even");
  return solve([&](double a) { return greatest_of_alarms(cells, a); }, false_alarms);
}

double smallest_of_multiplier(std::uint32_t cells, double false_alarms) {
  require_cells(cells, false_alarms);
  require_cfar(cells % 2 == 0, "cells must be even");
  return solve([&](double a) { return smallest_of_alarms(cells, a); }, false_alarms);
}

double ordered_multiplier(std::uint32_t cells, std::uint32_t rank, double false_alarms) {
  require_cells(cells, false_alarms);
  require_cfar(rank >= 1 && rank <= cells, "rank must be 1 to cells");
  return solve([&](double a) { return ordered_alarms(cells, rank, a); }, false_alarms);
}

double cell_mean_detection(std::uint32_t cells, double multiplier, double snr) {
  return cell_mean_alarms(cells, multiplier / (1.0 + snr));
}

double ordered_detection(std::uint32_t cells, std::uint32_t rank, double multiplier, double snr) {
  return ordered_alarms(cells, rank, multiplier / (1.0 + snr));
}

}  // namespace skerry::server
