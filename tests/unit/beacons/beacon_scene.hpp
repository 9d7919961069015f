// A radar, a scene with beacons in it, and what it hears on one turn.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "echo/beacons/beacon_returns.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo::beacons {

inline constexpr double kNauticalMile = 1852.0;

inline RadarSet s_band_set() {
  RadarSet set;
  set.frequency_hz = 3.05e9;
  set.peak_power_w = 30e3;
  set.antenna_gain_db = 28.0;
  set.beam_width_deg = 1.9;
  return set;
}

inline RadarModel model_at(double scale_nm, const RadarSet& set = {}, ScenarioTime start = {},
                           const ScanGeometry& geometry = {}) {
  return radar_model(set, geometry, *RangeScale::find(scale_nm),
                     SpokeClock(set.rpm, geometry.spokes_per_turn, start), 0);
}

// A radar of 3000 Hz on every scale.
inline RadarModel fast_model(double scale_nm) {
  RadarSet set;
  set.pulses = {{0.5e-6, 5e6, 3000.0, 96.0}};
  return model_at(scale_nm, set);
}

// Rows of power, one for each spoke.
class Picture {
 public:
  Picture(const RadarModel& model, std::size_t spokes)
      : model_(model), cells_(spokes * model.geometry.cells, 0.0f) {}

  std::size_t spokes() const { return cells_.size() / model_.geometry.cells; }
  std::span<float> row(std::size_t spoke) {
    return std::span(cells_).subspan(spoke * model_.geometry.cells, model_.geometry.cells);
  }
  std::span<const float> row(std::size_t spoke) const {
    return std::span(cells_).subspan(spoke * model_.geometry.cells, model_.geometry.cells);
  }
  const std::vector<float>& cells() const { return cells_; }
  float most() const {
    float most = 0.0f;
    for (const float p : cells_) most = std::max(most, p);
    return most;
  }
  // Ranges at which a spoke's power rises over `level` and falls below it again, metres.
  struct Stretch {
    double from_m, to_m;
  };
  std::vector<Stretch> stretches(std::size_t spoke, float level) const {
    std::vector<Stretch> out;
    const auto cells = row(spoke);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] < level) continue;
      const std::size_t from = i;
      while (i < cells.size() && cells[i] >= level) ++i;
      out.push_back(
          {static_cast<double>(from) * model_.cell_m, static_cast<double>(i) * model_.cell_m});
    }
    return out;
  }
  // Spokes with anything over `level`.
  std::size_t bright_spokes(float level) const {
    std::size_t count = 0;
    for (std::size_t s = 0; s < spokes(); ++s) count += !stretches(s, level).empty();
    return count;
  }

 private:
  RadarModel model_;
  std::vector<float> cells_;
};

inline Propagation propagation_of(const RadarModel& model, const Scene& scene) {
  return Propagation(model.set, scene.atmosphere, 0.0, 200e3);
}

// Spokes first .. first + count - 1, in sectors.
inline Picture hear(const RadarModel& model, const Scene& scene, std::uint64_t first,
                    std::size_t count, const HiddenHeight& hidden = {}, std::size_t sector = 16,
                    float tune = 1.0f) {
  BeaconReturns returns(model);
  const Propagation propagation = propagation_of(model, scene);
  Picture picture(model, count);
  for (std::size_t done = 0; done < count; done += sector) {
    const std::size_t step = std::min(sector, count - done);
    returns.prepare(scene, propagation, aim_of(scene, model.clock, first + done),
                    aim_of(scene, model.clock, first + done + step - 1), hidden);
    for (std::size_t k = 0; k < step; ++k)
      returns.add(aim_of(scene, model.clock, first + done + k), picture.row(done + k), tune);
  }
  return picture;
}
inline Picture hear_turn(const RadarModel& model, const Scene& scene,
                         const HiddenHeight& hidden = {}) {
  return hear(model, scene, 0, model.geometry.spokes_per_turn, hidden);
}

// The spoke of a bearing from the bow (and from the plane's north while heading is 0).
inline std::size_t spoke_at(const RadarModel& model, double bearing_deg) {
  const double spokes = bearing_deg / 360.0 * model.geometry.spokes_per_turn;
  return static_cast<std::size_t>(std::lround(spokes)) % model.geometry.spokes_per_turn;
}

inline PlanePoint at(double bearing_deg, double range_m) {
  const double radians = bearing_deg * 3.14159265358979323846 / 180.0;
  return {range_m * std::sin(radians), range_m * std::cos(radians)};
}

}  // namespace skerry::echo::beacons
