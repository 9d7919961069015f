#include "echo/rain/rain_profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kValuesApart = 0.6;  // beam widths
constexpr std::uint64_t kStillSeed = 0x511;

// Along the map's columns.
SinCos axis_of(const RainCell& cell, const RainMap& map) {
  PlanePoint drift = cell.velocity;
  const double speed = std::sqrt(dot(drift, drift));
  if (speed > 0.0) {
    drift = drift * (1.0 / speed);
  } else if (dot(cell.facing, cell.facing) > 0.0) {
    drift = cell.facing;
  } else {
    const SinCos any =
        sin_cos_units(static_cast<std::uint32_t>(mixed(cell.identity, kStillSeed) >> 32));
    drift = {any.sin, any.cos};
  }
  if (map.form().across_drift) drift = {-drift.north_m, drift.east_m};
  const PlanePoint axis = turned(drift, map.turn());
  return {axis.east_m, axis.north_m};
}

// Cuts [from, to] to where a + b r lies in [0, last].
void cut_to(double a, double b, double last, double& from, double& to) {
  if (b == 0.0) {
    if (a < 0.0 || a > last) to = from;
    return;
  }
  const double one = -a / b, other = (last - a) / b;
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
}

// Reads one level at knots [begin, end), with a weight that goes from that at the first of them
// straight on.
struct LevelReader {
  const RainChord& chord;
  double first_m, step_m;
  std::span<float> rates;

  void read(std::size_t level, std::size_t begin, std::size_t end, double weight,
            double more_weight) const {
    if (begin >= end) return;
    const double scale = 1.0 / static_cast<double>(std::size_t{1} << level);
    const double range = first_m + static_cast<double>(begin) * step_m;
    const GridWalk walk = {
        static_cast<float>((chord.column + range * chord.columns_per_m + 0.5) * scale - 0.5),
        static_cast<float>((chord.row + range * chord.rows_per_m + 0.5) * scale - 0.5),
        static_cast<float>(step_m * chord.columns_per_m * scale),
        static_cast<float>(step_m * chord.rows_per_m * scale)};
    add_grid(chord.map->level(level), walk, static_cast<float>(chord.rate_mm_h * weight),
             static_cast<float>(chord.rate_mm_h * more_weight), rates.subspan(begin, end - begin));
  }
};

}  // namespace

std::optional<RainChord> find_rain_chord(const RainCell& cell, const RainMap& map, PlanePoint off,
                                         SinCos ray, double reach_m) {
  const SinCos axis = axis_of(cell, map);
  const double per_column = 1.0 / map.column_m(), per_row = 1.0 / map.row_m();
  const double shear = map.form().shear;
  // A vector in the plane, in columns and rows.
  const auto columns = [&](PlanePoint v) {
    return (ahead_of(axis, v) - shear * right_of(axis, v)) * per_column;
  };
  const auto rows = [&](PlanePoint v) { return right_of(axis, v) * per_row; };
  const GridView grid = map.level(0);
  const double last_column = grid.columns - 1.0, last_row = grid.rows - 1.0;
  const PlanePoint way = {ray.sin, ray.cos};
  RainChord chord{&map,
                  cell.rate_mm_h,
                  0.5 * last_column - columns(off),
                  0.5 * last_row - rows(off),
                  columns(way),
                  rows(way),
                  0.0,
                  reach_m};
  cut_to(chord.column, chord.columns_per_m, last_column, chord.from_m, chord.to_m);
  cut_to(chord.row, chord.rows_per_m, last_row, chord.from_m, chord.to_m);
  if (!(chord.from_m < chord.to_m)) return std::nullopt;
  return chord;
}

void add_rain(const RainChord& chord, double beam_width, double first_m, double step_m,
              std::span<float> rates) {
  const RainMap& map = *chord.map;
  // No knot outside the map reads anything.
  const auto knot_from = [&](double range) {
    const double j = std::ceil((range - first_m) / step_m);
    return static_cast<std::size_t>(std::clamp(j, 0.0, static_cast<double>(rates.size())));
  };
  std::size_t at = knot_from(chord.from_m);
  const std::size_t end = knot_from(chord.to_m);
  const LevelReader reader{chord, first_m, step_m, rates};
  // Level l alone at the range where its values are as far apart as the beam asks for.
  double near_m =
      std::sqrt(map.column_m() * map.row_m()) / std::max(kValuesApart * beam_width, 1e-9);
  const std::size_t first_far = std::clamp(knot_from(near_m), at, std::max(at, end));
  reader.read(0, at, std::min(first_far, end), 1.0, 0.0);
  at = first_far;
  for (std::size_t level = 0; at < end; ++level) {
    if (level + 1 == map.levels()) {
      reader.read(level, at, end, 1.0, 0.0);
      return;
    }
    const double far_m = 2.0 * near_m;
    const std::size_t next = std::clamp(knot_from(far_m), at, end);
    const double slope = step_m / (far_m - near_m);
    const double rise = (first_m + static_cast<double>(at) * step_m - near_m) / (far_m - near_m);
    reader.read(level, at, next, 1.0 - rise, -slope);
    reader.read(level + 1, at, next, rise, slope);
    at = next;
    near_m = far_m;
  }
}

}  // namespace skerry::echo
