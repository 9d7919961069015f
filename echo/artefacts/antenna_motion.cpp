#include "echo/artefacts/antenna_motion.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/row_losses.hpp"
#include "echo/radar/radar_equation.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint64_t kPitchPhase = 0x7069746368ull;  // "pitch"
// Periods as short as this are taken as this long, seconds.
constexpr double kShortestPeriod = 0.1;

// A sine of that amplitude; `phase` in turns.
double swing(double amplitude_deg, double period_s, double seconds, double phase) {
  if (amplitude_deg == 0.0) return 0.0;
  const double turns = seconds / std::max(period_s, kShortestPeriod) + phase;
  return amplitude_deg * kRadiansPerDegree *
         sin_cos_degrees(360.0 * (turns - std::floor(turns))).sin;
}

SinCos sin_cos(double radians) { return sin_cos_degrees(radians * kDegreesPerRadian); }

// Octaves of the two-way floor.
double floor_octaves() { return 2.0 * exact_log2(ratio_from_decibels(kElevationFloorDb)); }

}  // namespace

AntennaMotionModel::AntennaMotionModel(const RadarModel& model)
    : height_m_(model.set.antenna_height_m) {
  const double width = model.set.vertical_beam_deg * kRadiansPerDegree;
  fall_ = 8.0 / (width * width);
  depression_.resize(model.geometry.cells);
  for (std::size_t i = 0; i < depression_.size(); ++i) {
    const double range = (static_cast<double>(i) + 0.5) * model.cell_m;
    depression_[i] =
        static_cast<float>(exact_atan2(height_m_, range) + range / (2.0 * kEffectiveEarth));
  }
}

Motion AntennaMotionModel::at(const Scene& scene, const SpokeAim& aim) const {
  Motion motion;
  const AntennaMotion& rig = scene.motion;
  if (!scene.artefacts.antenna_motion || (rig.roll_deg == 0.0 && rig.pitch_deg == 0.0))
    return motion;
  motion.moves = true;
  const double seconds = in_seconds(scene.time.time_since_epoch()) + aim.dt;
  motion.roll_rad = swing(rig.roll_deg, rig.roll_period_s, seconds, 0.0);
  motion.pitch_rad =
      swing(rig.pitch_deg, rig.pitch_period_s, seconds, as_unit(mixed(scene.seed, kPitchPhase)));

  const SinCos roll = sin_cos(motion.roll_rad), pitch = sin_cos(motion.pitch_rad);
  const SinCos shown = sin_cos_units(aim.relative_units);
  // The point of the horizon in the fan's plane, ahead and to starboard.
  const double ahead = shown.cos * roll.cos;
  const double starboard = shown.sin * pitch.cos - shown.cos * pitch.sin * roll.sin;
  // From the difference: two angles may lie on either side of half a turn.
  const double error = exact_atan2(starboard * shown.cos - ahead * shown.sin,
                                   ahead * shown.cos + starboard * shown.sin);
  motion.bearing_error_units = static_cast<std::int32_t>(error * kUnitsPerRadian);
  // The axis, which is square to the mast in the fan's plane, points that much over the horizon.
  const double up = shown.cos * pitch.sin - shown.sin * roll.sin * pitch.cos;
  motion.tilt_rad = exact_atan2(up, std::sqrt(std::max(0.0, 1.0 - up * up)));

  // The mast's top: starboard by h sin(roll), aft by h sin(pitch) cos(roll).
  const double to_starboard = height_m_ * roll.sin;
  const double forward = -height_m_ * pitch.sin * roll.cos;
  motion.along_m = forward * shown.cos + to_starboard * shown.sin;
  motion.across_m = to_starboard * shown.cos - forward * shown.sin;
  const SinCos plane = sin_cos_units(aim.plane_units);
  motion.sway = {motion.along_m * plane.sin + motion.across_m * plane.cos,
                 motion.along_m * plane.cos - motion.across_m * plane.sin};
  return motion;
}

SpokeAim AntennaMotionModel::moved(const SpokeAim& aim, const Motion& motion) {
  if (!motion.moves) return aim;
  SpokeAim out = aim;
  const auto turned = static_cast<std::uint32_t>(motion.bearing_error_units);
  out.true_units += turned;
  out.plane_units += turned;
  out.own_ship = out.own_ship + motion.sway;
  return out;
}

void AntennaMotionModel::apply(const Motion& motion, std::span<float> power) const {
  if (!motion.moves) return;
  lose_by_tilt({static_cast<float>(-motion.tilt_rad), static_cast<float>(fall_),
                static_cast<float>(floor_octaves())},
               depression_, power);
}

double AntennaMotionModel::gain(const Motion& motion, std::uint32_t cell) const {
  if (!motion.moves) return 1.0;
  const auto pattern = [&](double off) { return std::max(-fall_ * off * off, floor_octaves()); };
  const double level = depression_[cell];
  return exact_exp2(std::min(0.0, pattern(motion.tilt_rad + level) - pattern(level)));
}

}  // namespace skerry::echo
