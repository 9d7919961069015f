// Shared by the tests of targets: a radar, aims and rows of power.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/targets/echo_splat.hpp"
#include "echo/targets/target_returns.hpp"

namespace skerry::echo {

inline RadarModel model_at(double scale_nm, std::uint32_t cells = 1024, const RadarSet& set = {}) {
  const ScanGeometry geometry{4096, cells, 8};
  return radar_model(set, geometry, *RangeScale::find(scale_nm),
                     SpokeClock(set.rpm, geometry.spokes_per_turn), 1);
}

// Open water about the own ship at the plane's anchor, bow to the plane's north.
inline Scene calm_scene() {
  Scene scene;
  scene.seed = 5;
  return scene;
}

inline std::uint32_t units_at(double degrees) {
  return static_cast<std::uint32_t>(
      static_cast<std::int64_t>(std::llround(degrees / 360.0 * 4294967296.0)));
}
inline PlanePoint place_at(double range_m, double bearing_deg) {
  const double angle = bearing_deg * std::numbers::pi / 180.0;
  return {range_m * std::sin(angle), range_m * std::cos(angle)};
}
inline Hull ship_at(PlanePoint centre, double heading_deg, double length_m = 120.0,
                    double beam_m = 18.0, std::uint64_t identity = 7) {
  return {centre, {0, 0}, heading_deg, 0.0, length_m, beam_m, 20.0, identity};
}
inline PointEcho echo_at(double range_m, double bearing_deg, float power, std::uint32_t body = 0,
                         float phase = 0.0f) {
  return {range_m, units_at(bearing_deg), power, phase, body, 10.0f};
}

// Spoke `spoke` of all, and the rows of a sector of 16 that begins there.
inline std::vector<std::vector<float>> rows_of(const RadarModel& model, EchoSplat& splat,
                                               const Scene& scene,
                                               const std::vector<PointEcho>& points,
                                               std::uint64_t first, std::uint32_t count = 16,
                                               bool side_lobes = false) {
  const SpokeAim from = aim_of(scene, model.clock, first);
  const SpokeAim to = aim_of(scene, model.clock, first + count - 1);
  static std::uint64_t version = 0;
  if (side_lobes) {
    splat.prepare({}, from, to, StrongEchoes{points, ++version});
  } else {
    splat.prepare(points, from, to);
  }
  std::vector<std::vector<float>> rows(count, std::vector<float>(model.geometry.cells, 0.0f));
  for (std::uint32_t k = 0; k < count; ++k)
    splat.add(aim_of(scene, model.clock, first + k), rows[k]);
  return rows;
}

// A whole turn of those points, sector by sector.
inline std::vector<std::vector<float>> turn_of(const RadarModel& model,
                                               const std::vector<PointEcho>& points,
                                               bool side_lobes = false) {
  EchoSplat splat(model);
  const Scene scene = calm_scene();
  std::vector<std::vector<float>> turn;
  for (std::uint32_t s = 0; s < model.geometry.spokes_per_turn; s += 16) {
    for (auto& row : rows_of(model, splat, scene, points, s, 16, side_lobes))
      turn.push_back(std::move(row));
  }
  return turn;
}

// The targets of a sector of 16 spokes about that bearing, in that turn.
inline std::vector<PointEcho> echoes_about(TargetReturns& returns, const RadarModel& model,
                                           const Scene& scene, double bearing_deg,
                                           std::uint64_t turn = 1,
                                           const HiddenHeight& hidden = {}) {
  const std::uint32_t spokes = model.geometry.spokes_per_turn;
  const auto middle = static_cast<std::uint64_t>(std::llround(bearing_deg / 360.0 * spokes));
  const std::uint64_t first = turn * spokes + middle - 8;
  std::vector<PointEcho> echoes;
  returns.prepare(scene, aim_of(scene, model.clock, first), aim_of(scene, model.clock, first + 15),
                  hidden, echoes);
  return echoes;
}

inline double total_power(const std::vector<PointEcho>& echoes) {
  double sum = 0.0;
  for (const PointEcho& e : echoes) sum += static_cast<double>(e.power);
  return sum;
}

// Greatest distance of the sample's distribution from `law`, a cumulative distribution.
inline double kolmogorov(std::vector<double> sample, const std::function<double(double)>& law) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double at = law(sample[i]), below = static_cast<double>(i) / n;
    worst = std::max({worst, at - below, below + 1.0 / n - at});
  }
  return worst;
}
// That distance stays below this but once in a million: P(D > d) <= 2 exp(-2 n d^2)
// (Dvoretzky-Kiefer-Wolfowitz, with Massart's constant).
inline double kolmogorov_bound(std::size_t n) {
  return std::sqrt(std::log(2e6) / (2.0 * static_cast<double>(n)));
}

inline double exponential_law(double x) { return 1.0 - std::exp(-x); }
// Chi-square of four degrees of freedom, of mean 1.
inline double swerling3_law(double x) { return 1.0 - (1.0 + 2.0 * x) * std::exp(-2.0 * x); }

inline double decibels(double ratio) { return 10.0 * std::log10(ratio); }

}  // namespace skerry::echo
