#include "echo/radar/antenna_pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/radar/beam.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kNearDegrees = 10.0;  // side lobes within it have a level of their own
constexpr double kLobeSpacing =
    180.0 / 68.8 / std::numbers::pi;  // beam widths; pi of the taper's mu
constexpr double kDeepestLobeDb = 24.0;
constexpr double kShareAtLevel = 0.05;

// The taper's first null, mu = 3 pi / 2.
double null_degrees(double beam_width_deg) {
  const double sine = 1.5 * beam_width_deg / 68.8;
  return exact_atan2(sine, std::sqrt(1.0 - sine * sine)) * kDegreesPerRadian;
}

// A run of side lobes from one null to another, in voltage.
double side_lobe_voltage(double off, double from, double to, double level_db, double spacing) {
  const double lobes = std::max(1.0, std::floor((to - from) / spacing + 0.5));
  const double place = std::clamp((off - from) / (to - from), 0.0, 1.0) * lobes;
  const double number = std::min(std::floor(place), lobes - 1.0);
  const auto lobe = static_cast<std::uint64_t>(number);
  // An even spread of depths, cut at 0 dB: one lobe in twenty touches the level.
  const double chance = as_unit(mixed(0x51DE10BEull, lobe));
  const double below = (chance - kShareAtLevel) / (1.0 - kShareAtLevel);
  const double depth_db = lobe == 0 ? 0.0 : kDeepestLobeDb * std::max(0.0, below);
  return exact_exp2((level_db - depth_db) * (0.5 * kOctavesPerDb)) *
         sin_cos_degrees(180.0 * (place - number)).sin;
}

double voltage_reference(const RadarSet& set, double off) {
  const double width = set.beam_width_deg;
  const double null = null_degrees(width);
  if (off < null) return std::max(0.0, cosine_taper_voltage(off, width));
  const double spacing = kLobeSpacing * width;
  if (off < kNearDegrees)
    return side_lobe_voltage(off, null, kNearDegrees, set.near_side_lobe_db, spacing);
  return side_lobe_voltage(off, kNearDegrees, 180.0, set.far_side_lobe_db, spacing);
}

}  // namespace

double antenna_pattern_reference(const RadarSet& set, double off_degrees) {
  const double voltage = voltage_reference(set, std::fabs(off_degrees));
  return voltage * voltage;
}

AntennaPattern::AntennaPattern(const RadarSet& set) {
  const double near_degrees = 2.0 * set.beam_width_deg;
  near_units_ = static_cast<std::uint32_t>(near_degrees / kDegreesPerUnit);
  near_scale_ = static_cast<float>(static_cast<double>(kNear) / near_units_);
  for (std::size_t i = 0; i <= kNear + 1; ++i)
    near_voltage_.push_back(
        static_cast<float>(voltage_reference(set, near_degrees * static_cast<double>(i) / kNear)));
  for (std::size_t i = 0; i <= kFar + 1; ++i)
    far_power_.push_back(static_cast<float>(
        antenna_pattern_reference(set, std::min(180.0, 180.0 * static_cast<double>(i) / kFar))));

  // Simpson, a hundred steps to the beam width.
  const double step = 0.01 * set.beam_width_deg;
  const auto steps = 2 * static_cast<int>(90.0 / step);
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double power = antenna_pattern_reference(set, i * 180.0 / steps);
    sum += (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * power * power;
  }
  clutter_width_ = 2.0 * sum * (std::numbers::pi / steps) / 3.0;
}

std::shared_ptr<const AntennaPattern> antenna_pattern_for(const RadarSet& set) {
  static KeptTables<std::array<double, 3>, AntennaPattern, 16> tables;
  return tables.get({set.beam_width_deg, set.near_side_lobe_db, set.far_side_lobe_db},
                    [&] { return AntennaPattern(set); });
}

std::uint32_t AntennaPattern::reach_units(double level) const {
  constexpr std::uint32_t kPerNode = kUnitsPerHalfTurn / kFar;
  const auto one_way_level = static_cast<float>(std::sqrt(level));
  for (std::size_t i = kFar + 1; i-- > 0 && i * kPerNode > near_units_;)
    if (far_power_[i] >= one_way_level)
      return static_cast<std::uint32_t>(std::min<std::size_t>(i + 1, kFar) * kPerNode);
  const float voltage = std::sqrt(one_way_level);
  for (std::size_t i = kNear + 1; i-- > 0;)
    if (near_voltage_[i] >= voltage)
      return static_cast<std::uint32_t>(static_cast<double>(i + 1) / kNear * near_units_);
  return 0;
}

}  // namespace skerry::echo
