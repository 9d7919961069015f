// The rate of an area in a beam, in double and with libm: slow, and by another way than
// rain_profile.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/rain/rain_map.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

inline constexpr RainKind kFractalRain[] = {RainKind::cell, RainKind::shower,
                                            RainKind::squall_line};

// Share of the rate at a place, offset from the area's centre, in one level of the map.  Requires
// an area that drifts.
inline double rain_share_at(const RainCell& cell, const RainMap& map, PlanePoint offset,
                            std::size_t level) {
  double axis = std::atan2(cell.velocity.east_m, cell.velocity.north_m);  // clockwise from north
  if (map.form().across_drift) axis -= std::numbers::pi / 2.0;
  axis += std::atan2(map.turn().sin, map.turn().cos);
  const double right = offset.east_m * std::cos(axis) - offset.north_m * std::sin(axis);
  const double along =
      offset.east_m * std::sin(axis) + offset.north_m * std::cos(axis) - map.form().shear * right;
  const GridView fine = map.level(0);
  const double column = along / map.column_m() + 0.5 * (fine.columns - 1.0);
  const double row = right / map.row_m() + 0.5 * (fine.rows - 1.0);
  if (column < 0.0 || row < 0.0 || column > fine.columns - 1.0 || row > fine.rows - 1.0) return 0.0;
  const double scale = std::exp2(-static_cast<double>(level));
  return grid_reference(map.level(level), (column + 0.5) * scale - 0.5, (row + 0.5) * scale - 0.5);
}

// mm/h in the beam at a range on a bearing (radians), seen from `from`.
inline double rain_rate_at(const RainCell& cell, const RainMap& map, PlanePoint from,
                           double bearing, double beam_width, double range) {
  const double level =
      std::clamp(std::log2(0.6 * beam_width * range / std::sqrt(map.column_m() * map.row_m())), 0.0,
                 static_cast<double>(map.levels() - 1));
  const auto low = static_cast<std::size_t>(level);
  const double more = std::exp2(level - static_cast<double>(low)) - 1.0;
  const PlanePoint place = from + PlanePoint{std::sin(bearing), std::cos(bearing)} * range;
  double share = (1.0 - more) * rain_share_at(cell, map, place - cell.centre, low);
  if (more > 0.0) share += more * rain_share_at(cell, map, place - cell.centre, low + 1);
  return cell.rate_mm_h * share;
}

}  // namespace skerry::echo
