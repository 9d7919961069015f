#include "echo/measure/picture_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skerry::echo {
namespace {

double quantile(const std::vector<double>& sorted, double part) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (sorted[high] - sorted[low]) * (at - static_cast<double>(low));
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.1), quantile(values, 0.25), quantile(values, 0.5),
          quantile(values, 0.75), quantile(values, 0.9)};
}

std::vector<FirstEcho> first_echoes(const PictureTurn& turn, const PictureWindow& window) {
  require_valid(turn, window);
  const WindowCells cells = cells_of(turn, window);
  const std::uint8_t least = least_echo(turn, window);
  std::vector<FirstEcho> echoes;
  for (const std::uint32_t spoke : cells.spokes) {
    FirstEcho first;
    for (std::uint32_t cell = cells.first; cell < cells.last; ++cell) {
      if (turn.at(spoke, cell) < least) continue;
      std::uint32_t end = cell + 1;
      while (end < cells.last && (turn.at(spoke, end) >= least ||
                                  (end + 1 < cells.last && turn.at(spoke, end + 1) >= least)))
        ++end;
      first.last = end;
      if (first.begin == FirstEcho::kNone && (end - cell) * turn.cell_m >= kLeastEcho_m) {
        first.begin = cell;
        first.end = end;
      }
      cell = end;
    }
    echoes.push_back(first);
  }
  return echoes;
}

EdgeStatistics edge_statistics(const PictureTurn& turn, const PictureWindow& window) {
  EdgeStatistics result;
  std::vector<double> thickness, to_last, changes;
  double within = 0.0, jumps = 0.0, sum = 0.0;
  const FirstEcho* before = nullptr;
  const std::vector<FirstEcho> echoes = first_echoes(turn, window);
  for (const FirstEcho& echo : echoes) {
    const bool known = echo.begin != FirstEcho::kNone;
    if (known) {
      ++result.spokes;
      sum += echo.begin * turn.cell_m;
      thickness.push_back((echo.end - echo.begin) * turn.cell_m);
      to_last.push_back((echo.last - echo.begin) * turn.cell_m);
    }
    if (known && before != nullptr) {
      const double change = std::fabs(static_cast<double>(echo.begin) - before->begin);
      within += change <= 1.0 ? 1.0 : 0.0;
      jumps += change * turn.cell_m > 100.0 ? 1.0 : 0.0;
      changes.push_back(change * turn.cell_m);
    }
    before = known ? &echo : nullptr;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(changes.size());
  result.mean_range_m = result.spokes > 0 ? sum / result.spokes : kNone;
  result.thickness_m = quantiles_of(std::move(thickness));
  result.first_to_last_m = quantiles_of(std::move(to_last));
  result.within_a_cell = n > 0.0 ? within / n : kNone;
  result.jumps = n > 0.0 ? jumps / n : kNone;
  std::sort(changes.begin(), changes.end());
  result.change_p99_m = quantile(changes, 0.99);
  return result;
}

}  // namespace skerry::echo
