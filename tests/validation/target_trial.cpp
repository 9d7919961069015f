#include "tests/validation/target_trial.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::validation {
namespace {

echo::RadarSet at_height(echo::RadarSet set, double metres) {
  set.antenna_height_m = metres;
  return set;
}

}  // namespace

PlanePoint off(PlanePoint from, double range_m, double bearing_deg) {
  const echo::SinCos at = echo::sin_cos_degrees(bearing_deg);
  return from + PlanePoint{range_m * at.sin, range_m * at.cos};
}

TargetTrial::TargetTrial(const Conditions& conditions, const Fill& fill)
    : geometry_(conditions.geometry),
      rpm_(conditions.set.rpm),
      cell_m_(geometry_.cell_size(conditions.scale).in_metres()),
      scene_(std::make_shared<echo::Scene>(*scenes::scene_at(
          scenes::made_up_chart(scenes::kBergen, conditions.scale.length() * 1.3, 0, 1),
          scenes::kBergen, conditions.scale, geometry_))),
      renderer_(at_height(conditions.set, conditions.antenna_height_m), geometry_,
                {conditions.set.rpm, geometry_.spokes_per_turn}, 0) {
  scene_->own_velocity = {};
  scene_->true_north_deg = 0.0;
  fill(*scene_);
  echo::ViewControls controls;
  controls.range_scale = conditions.scale;
  controls.gain = conditions.gain;
  controls.sea = conditions.sea;
  controls.integration = conditions.integration;
  renderer_.set_controls(controls);
}

std::vector<std::uint8_t> TargetTrial::video(std::uint32_t scan, std::uint32_t first,
                                             std::uint32_t count) {
  const std::uint64_t spoke = std::uint64_t{scan} * geometry_.spokes_per_turn + first;
  const echo::SpokeClock clock(rpm_, geometry_.spokes_per_turn);
  scene_->time = clock.time_of(spoke);
  std::vector<std::uint8_t> video(std::size_t{count} * geometry_.cells);
  renderer_.render(*scene_, spoke, count, video);
  return video;
}

double TargetTrial::detected(double range_m, double bearing_deg, std::uint32_t scans) {
  const std::uint32_t spoke =
      RelativeBearing::from(degrees(bearing_deg)).nearest_spoke(geometry_.spokes_per_turn);
  // The cell that the whole pulse fills, or where a pulse is shorter, the one the echo begins in.
  const auto cell = static_cast<std::uint32_t>(range_m / cell_m_);
  std::uint32_t seen = 0;
  for (std::uint32_t scan = 0; scan < scans; ++scan) {
    const auto row = video(scan, spoke, 1);
    seen += row[cell] > 0 || row[cell + 1] > 0 ? 1 : 0;
  }
  return static_cast<double>(seen) / scans;
}

}  // namespace skerry::validation
