#include "server/world/handling/wind_load.hpp"

#include <array>
#include <numbers>

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

struct Row {
  double across, bow, stern, cross_force, rolling;  // CDt, CDlAF bow and stern, delta, kappa
};
// In the order of WindType.
constexpr std::array<Row, 9> kRows = {{
    {0.85, 0.65, 0.55, 0.40, 1.7},
    {0.90, 0.55, 0.55, 0.40, 1.4},
    {0.90, 0.45, 0.50, 0.80, 1.1},
    {0.95, 0.70, 0.70, 0.40, 1.1},
    {0.90, 0.55, 0.80, 0.55, 1.2},
    {0.90, 0.55, 0.60, 0.60, 1.1},
    {0.70, 0.90, 0.55, 0.40, 3.1},
    {0.85, 0.55, 0.55, 0.65, 1.1},
    {0.85, 0.55, 0.65, 0.60, 1.4},
}};

}  // namespace

Loads wind_load(const WindShape& shape, double length_m, double wind_x, double wind_y) {
  const double flow = squared(wind_x) + squared(wind_y);
  if (flow <= 0.0 || shape.lateral_m2 <= 0.0) return {};
  const Row& row = kRows[static_cast<std::size_t>(shape.type)];
  const double speed = std::sqrt(flow);
  // Of where it comes from: 1 dead ahead; positive from port, and then it pushes to starboard.
  const double ahead = -wind_x / speed, side = wind_y / speed;
  const double frontal = ahead >= 0.0 ? row.bow : row.stern;
  const double lengthwise = frontal * shape.frontal_m2 / shape.lateral_m2;
  const double twice = 2.0 * ahead * side;  // the sine of twice the angle
  const double damp =
      1.0 - 0.5 * row.cross_force * (1.0 - lengthwise / row.across) * squared(twice);
  const double angle = std::fabs(echo::exact_atan2(side, ahead));

  const double cx = -frontal * ahead / damp;
  const double cy = row.across * side / damp;
  const double cn = (shape.centre_m / length_m - 0.18 * (angle - std::numbers::pi / 2.0)) * cy;
  const double mean_height = shape.lateral_m2 / length_m;
  const double ck = row.rolling * shape.height_m / mean_height * cy;
  const double pressure = 0.5 * kAir_kg_m3 * flow;
  return {.x = cx * pressure * shape.frontal_m2,
          .y = cy * pressure * shape.lateral_m2,
          .k = ck * pressure * shape.lateral_m2 * mean_height,
          .n = cn * pressure * shape.lateral_m2 * length_m};
}

}  // namespace skerry::server
