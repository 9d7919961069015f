#include "echo/returns/hidden_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {

double sea_seen_from(double slope, double antenna_height_m) {
  const double inside = slope * slope - 2.0 * antenna_height_m / kEffectiveEarth;
  if (slope >= 0.0 || inside <= 0.0) return std::numeric_limits<double>::infinity();
  // 2 antenna / (-slope + root): the nearer root without cancellation.
  return 2.0 * antenna_height_m / (-slope + std::sqrt(inside));
}

void find_dry(std::span<const LandInterval> land, std::span<const float> slopes, double cell_m,
              double antenna_height_m, std::uint32_t cells, std::vector<CellRun>& dry) {
  dry.clear();
  for (const LandInterval& l : land) {
    const auto cell_of = [&](double range) {
      const double cell = std::floor(range / cell_m + 0.5);
      return static_cast<std::uint16_t>(std::clamp(cell, 0.0, static_cast<double>(cells)));
    };
    const auto behind = static_cast<std::size_t>(l.end_m / cell_m) + 1;
    const double slope = static_cast<double>(slopes[std::min(behind, slopes.size() - 1)]);
    const std::uint16_t first = cell_of(l.begin_m);
    const std::uint16_t last = cell_of(std::max(l.end_m, sea_seen_from(slope, antenna_height_m)));
    if (first >= last) continue;
    if (!dry.empty() && first <= dry.back().last) {
      dry.back().last = std::max(dry.back().last, last);
    } else {
      dry.push_back({first, last});
    }
  }
}

}  // namespace skerry::echo
