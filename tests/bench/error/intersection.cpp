// How a ray finds the coast.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "tests/bench/error/leading_edges.hpp"

namespace skerry::bench {
namespace {

// Simulators draw coasts like this: every vertex goes to the spoke it is nearest to, which keeps
// the nearest.
std::vector<double> nearest_vertices(const echo::CoastPicture& picture, PlanePoint own_ship,
                                     double range_m, int rays) {
  std::vector<double> edges(static_cast<std::size_t>(rays),
                            std::numeric_limits<double>::infinity());
  for (const PlanePoint& vertex : picture.vertices) {
    const PlanePoint p = vertex - own_ship;
    const double range = std::sqrt(p.east_m * p.east_m + p.north_m * p.north_m);
    if (range > range_m) continue;
    const double turn = std::atan2(p.east_m, p.north_m) / (2.0 * std::numbers::pi);
    const auto ray = static_cast<int>(std::floor((turn < 0 ? turn + 1 : turn) * rays - 0.37 + 0.5));
    double& edge = edges[static_cast<std::size_t>((ray + rays) % rays)];
    edge = std::min(edge, range);
  }
  return edges;
}

// The analytic crossing in single precision, in metres from the own ship.
std::vector<double> single_precision(const echo::CoastPicture& picture,
                                     const echo::PolarIndex& index,
                                     const std::vector<std::array<float, 2>>& vertices,
                                     double range_m, int rays) {
  std::vector<double> edges;
  for (int i = 0; i < rays; ++i) {
    const echo::SinCos d = echo::sin_cos_units(ray_bearing(i, rays));
    const auto sin = static_cast<float>(d.sin), cos = static_cast<float>(d.cos);
    double nearest = std::numeric_limits<double>::infinity();
    const auto test = [&](std::uint32_t v) {
      const auto& a = vertices[v];
      const auto& b = vertices[v + 1];
      const float right_a = a[0] * cos - a[1] * sin, right_b = b[0] * cos - b[1] * sin;
      if ((right_a < 0.0f) == (right_b < 0.0f)) return;
      const float along_a = a[0] * sin + a[1] * cos, along_b = b[0] * sin + b[1] * cos;
      const float range = along_a + (along_b - along_a) * (right_a / (right_a - right_b));
      if (range >= 0.0f) nearest = std::min(nearest, static_cast<double>(range));
    };
    for (const std::uint32_t v : index.candidates(ray_bearing(i, rays))) test(v);
    for (const std::uint32_t v : index.near_edges()) test(v);
    edges.push_back(nearest <= range_m ? nearest : std::numeric_limits<double>::infinity());
  }
  (void)picture;
  return edges;
}

}  // namespace

std::vector<ErrorRow> study_intersection(const ErrorStudy& study) {
  const echo::CoastPicturePtr picture = picture_of(study, 1.0);
  const PlanePoint own_ship = picture->plane.to_plane(study.own_ship);
  const echo::PolarIndex index(*picture, own_ship, 20.0);
  std::vector<std::array<float, 2>> single;
  for (const PlanePoint& v : picture->vertices) {
    single.push_back({static_cast<float>(v.east_m - own_ship.east_m),
                      static_cast<float>(v.north_m - own_ship.north_m)});
  }
  std::vector<ErrorRow> rows;
  std::vector<double> truth;
  const auto measure = [&](const char* setting, bool in_use, int repetitions, auto&& method) {
    study.progress(std::string("intersection: ") + setting);
    ErrorRow row;
    row.knob = "intersection";
    row.setting = setting;
    row.in_use = in_use;
    row.dimension = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> found;
    const double seconds = median_seconds(repetitions, [&] { found = method(); });
    if (truth.empty()) truth = found;
    std::vector<double> errors = differences(found, truth, study.range_m);
    fill_errors(errors, row);
    row.microseconds_per_spoke = 1e6 * seconds / study.rays;
    rows.push_back(row);
  };
  measure("every edge, double (reference)", false, 1,
          [&] { return leading_edges_by_all(*picture, own_ship, study.range_m, study.rays); });
  measure("indexed, double", true, study.repetitions,
          [&] { return leading_edges(*picture, index, own_ship, study.range_m, study.rays); });
  measure("indexed, single", false, study.repetitions,
          [&] { return single_precision(*picture, index, single, study.range_m, study.rays); });
  measure("nearest vertex of the spoke", false, study.repetitions,
          [&] { return nearest_vertices(*picture, own_ship, study.range_m, study.rays); });
  return rows;
}

}  // namespace skerry::bench
