// A radar over open sea, for the tests of this room.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "echo/clutter/sea_returns.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

inline RadarModel sea_radar(double nm, const RadarSet& set = {}, std::uint32_t spokes = 4096,
                            std::uint32_t cells = 1024) {
  ScanGeometry geometry;
  geometry.spokes_per_turn = spokes;
  geometry.cells = cells;
  return radar_model(set, geometry, *RangeScale::find(nm), SpokeClock(set.rpm, spokes), 0);
}

inline Scene open_sea(double state) {
  Scene scene;
  scene.seed = 11;
  scene.sea.state = state;
  scene.sea.wind_from_deg = 40.0;
  return scene;
}

inline double bearing_deg(const SpokeAim& aim) { return aim.plane_units * (360.0 / 4294967296.0); }

inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ma += a[i], mb += b[i], aa += a[i] * a[i], bb += b[i] * b[i], ab += a[i] * b[i];
  }
  const double n = static_cast<double>(a.size());
  return (ab / n - ma * mb / n / n) /
         std::sqrt((aa / n - ma * ma / n / n) * (bb / n - mb * mb / n / n));
}

// Calls use(aim, power) for spokes first .. first + count - 1, in sectors of 16.
template <typename Use>
void for_spokes(SeaReturns& sea, const RadarModel& model, const Scene& scene, std::uint64_t first,
                std::uint64_t count, Use&& use) {
  std::vector<float> power(model.geometry.cells);
  for (std::uint64_t s = first; s < first + count; s += 16) {
    const std::uint64_t end = std::min(s + 16, first + count);
    sea.prepare(scene, aim_of(scene, model.clock, s), aim_of(scene, model.clock, end - 1));
    for (std::uint64_t k = s; k < end; ++k) {
      std::fill(power.begin(), power.end(), 0.0f);
      const SpokeAim aim = aim_of(scene, model.clock, k);
      sea.add(aim, power);
      use(aim, power);
    }
  }
}

}  // namespace skerry::echo
