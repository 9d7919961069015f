#include "tests/bench/error/leading_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/measure/coast_dimension.hpp"

namespace skerry::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double first_land(const std::vector<echo::Crossing>& crossings, double range_m,
                  std::vector<echo::LandInterval>& land) {
  echo::land_along(crossings, false, range_m, land);
  return land.empty() ? kNone : land.front().begin_m;
}

}  // namespace

std::uint32_t ray_bearing(int i, int rays) {
  return static_cast<std::uint32_t>((i + 0.37) * 4294967296.0 / rays);
}

std::vector<double> leading_edges_by_all(const echo::CoastPicture& picture, PlanePoint own_ship,
                                         double range_m, int rays) {
  std::vector<double> edges;
  std::vector<echo::Crossing> crossings;
  std::vector<echo::LandInterval> land;
  for (int i = 0; i < rays; ++i) {
    const echo::SinCos direction = echo::sin_cos_units(ray_bearing(i, rays));
    crossings.clear();
    for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
      for (std::uint32_t v = picture.run_starts[run]; v + 1 < picture.run_starts[run + 1]; ++v) {
        const PlanePoint a = picture.vertices[v] - own_ship;
        const PlanePoint b = picture.vertices[v + 1] - own_ship;
        const double right_a = a.east_m * direction.cos - a.north_m * direction.sin;
        const double right_b = b.east_m * direction.cos - b.north_m * direction.sin;
        if ((right_a < 0.0) == (right_b < 0.0)) continue;
        const double along_a = a.east_m * direction.sin + a.north_m * direction.cos;
        const double along_b = b.east_m * direction.sin + b.north_m * direction.cos;
        const double range = along_a + (along_b - along_a) * (right_a / (right_a - right_b));
        if (range >= 0.0) crossings.push_back({range, right_a < 0.0});
      }
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const auto& p, const auto& q) { return p.range_m < q.range_m; });
    edges.push_back(first_land(crossings, range_m, land));
  }
  return edges;
}

std::vector<double> leading_edges(const echo::CoastPicture& picture, const echo::PolarIndex& index,
                                  PlanePoint own_ship, double range_m, int rays) {
  std::vector<double> edges;
  std::vector<echo::Crossing> crossings;
  std::vector<echo::LandInterval> land;
  for (int i = 0; i < rays; ++i) {
    echo::find_crossings(picture, index, {own_ship, ray_bearing(i, rays)}, crossings);
    edges.push_back(first_land(crossings, range_m, land));
  }
  return edges;
}

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b,
                                double range_m) {
  std::vector<double> out;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == kNone && b[i] == kNone) continue;
    out.push_back(a[i] == kNone || b[i] == kNone ? range_m : std::fabs(a[i] - b[i]));
  }
  return out;
}

double dimension_of(const echo::CoastPicture& picture) {
  std::size_t longest = 0;
  for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
    const auto length = [&](std::size_t r) {
      return picture.run_starts[r + 1] - picture.run_starts[r];
    };
    if (length(run) > length(longest)) longest = run;
  }
  const auto first = picture.run_starts[longest], last = picture.run_starts[longest + 1];
  return echo::divider_dimension({picture.vertices.data() + first, last - first}, 8.0, 250.0);
}

echo::CoastPicturePtr picture_of(const ErrorStudy& study, double finer, double* seconds) {
  echo::CoastPreparer preparer(study.chart, study.own_ship, echo::CoastRules{.seed = 1});
  echo::RadarResolution resolution{study.range_m, study.range_m / kStudyCells,
                                   360.0 / kStudySpokes};
  if (finer > 0.0) {
    resolution.cell_m /= finer;
    resolution.spoke_degrees /= finer;
  } else {
    resolution.cell_m = resolution.spoke_degrees = 0.0;
  }
  echo::CoastPicturePtr picture = preparer.prepare(study.own_ship, resolution);
  if (seconds) {
    std::vector<double> taken;
    for (int i = 0; i < study.repetitions; ++i) {
      echo::CoastPreparer cold(study.chart, study.own_ship, echo::CoastRules{.seed = 1});
      taken.push_back(
          median_seconds(1, [&] { picture = cold.prepare(study.own_ship, resolution); }));
    }
    std::sort(taken.begin(), taken.end());
    *seconds = taken[taken.size() / 2];
  }
  return picture;
}

}  // namespace skerry::bench
