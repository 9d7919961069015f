#include "echo/artefacts/multiple_echoes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/artefacts/false_echoes.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/ship_figure.hpp"

namespace skerry::echo {
namespace {

// The points of one body: from .. to - 1 of those that are seen.
struct Body {
  std::span<const PointEcho> points;
  double power = 0.0;
  const PointEcho* strongest = nullptr;
};

Body gathered(std::span<const PointEcho> points) {
  Body body{points, 0.0, points.data()};
  for (const PointEcho& p : points) {
    body.power += double{p.power};
    if (p.power > body.strongest->power) body.strongest = &p;
  }
  return body;
}

// Its kMostPoints strongest points, in their order, and what all of them send in terms of these.
double choose_points(const Body& body, std::vector<const PointEcho*>& chosen) {
  chosen.clear();
  for (const PointEcho& p : body.points) chosen.push_back(&p);
  if (chosen.size() > kMostPoints) {
    std::nth_element(chosen.begin(), chosen.begin() + kMostPoints, chosen.end(),
                     [](const PointEcho* a, const PointEcho* b) {
                       return a->power != b->power ? a->power > b->power : a < b;
                     });
    chosen.resize(kMostPoints);
    std::sort(chosen.begin(), chosen.end());
  }
  double power = 0.0;
  for (const PointEcho* p : chosen) power += double{p->power};
  return body.power / power;
}

}  // namespace

std::uint32_t false_body(std::uint32_t body, std::uint64_t way) {
  return body_of(BodyKind::false_echo, static_cast<std::uint32_t>(mixed(body, way)));
}

double second_trip_ratio(double own_m2, double target_m2, double range_m) {
  const double square = range_m * range_m;
  const double mirror = std::numbers::pi * square;
  constexpr double kFourPi = 4.0 * std::numbers::pi;
  return std::min(own_m2, mirror) * std::min(target_m2, mirror) /
         (kFourPi * kFourPi * square * square);
}

double own_cross_section(const OwnHull& own, double frequency_hz, std::uint32_t relative_units) {
  if (own.length_m <= 0.0 || own.beam_m <= 0.0) return 0.0;
  Hull hull;
  hull.length_m = own.length_m;
  hull.beam_m = own.beam_m;
  const double side = sin_cos_units(relative_units).sin;
  return ship_mean_cross_section(hull, frequency_hz, std::max(side, -side));
}

void add_multiple_echoes(const RadarModel& model, const Scene& scene, const SpokeAim& aim,
                         const BearingSpan& where, std::span<const PointEcho> seen,
                         std::vector<PointEcho>& out) {
  if (scene.own_hull.length_m <= 0.0) return;
  const std::uint32_t bow = aim.plane_units - aim.relative_units;
  const double reach = model.cell_m * model.geometry.cells;
  std::vector<const PointEcho*> chosen;
  for (std::size_t begin = 0; begin < seen.size();) {
    std::size_t end = begin;
    bool met = false;
    for (; end < seen.size() && seen[end].body == seen[begin].body; ++end)
      met = met || where.holds(seen[end].bearing_units);
    const auto points = seen.subspan(begin, end - begin);
    begin = end;
    if (!met) continue;

    const Body body = gathered(points);
    const double range = body.strongest->range_m;
    if (!(body.power > 0.0) || !(range > 0.0) || 2.0 * range > reach) continue;
    const double target = body.power * (range * range) * (range * range) / model.unit_snr;
    const double own = own_cross_section(scene.own_hull, model.set.frequency_hz,
                                         body.strongest->bearing_units - bow);
    const double ratio = second_trip_ratio(own, target, range);
    if (body.power * ratio < double{FalseEchoes::kLeastPower}) continue;
    double trip_ratio = choose_points(body, chosen);
    for (int trip = 2; trip <= kMostTrips; ++trip) {
      trip_ratio *= ratio;
      if (body.power * trip_ratio < double{FalseEchoes::kLeastPower}) break;
      for (const PointEcho* p : chosen) {
        if (!where.holds(p->bearing_units) || trip * p->range_m > reach) continue;
        PointEcho echo = *p;
        echo.range_m *= trip;
        echo.power = static_cast<float>(double{p->power} * trip_ratio);
        const double turns = double{p->phase} * trip;
        echo.phase = static_cast<float>(turns - std::floor(turns));
        echo.body = false_body(p->body, static_cast<std::uint64_t>(trip));
        out.push_back(echo);
      }
    }
  }
}

}  // namespace skerry::echo
