#include "echo/beacons/one_way.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/radar_equation.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kNearLobes = 10.0;  // degrees: RadarSet::near_side_lobe_db holds within
// The main lobe of the cosine taper ends at 1.25 beam widths (beam.hpp).
constexpr double kMainLobe = 1.3;
constexpr double kMargin = 1.0;  // degrees, for a pattern kept in steps

std::uint32_t reach_units(double degrees) {
  return static_cast<std::uint32_t>(std::min(degrees, 179.9) * kUnitsPerDegree);
}

}  // namespace

OneWayLink::OneWayLink(const RadarModel& model) {
  const double lambda = model.set.wavelength_m();
  const double spread = lambda / (4.0 * std::numbers::pi);
  const double loss = std::sqrt(ratio_from_decibels(model.set.losses_db));
  const double gain = ratio_from_decibels(model.set.antenna_gain_db) / loss;
  received_1m_ = gain * spread * spread / noise_watts(model.set, model.pulse);
  sent_1m_ = model.set.peak_power_w * gain * spread * spread;
}

double OneWayLink::received(double eirp_w, double range_m) const {
  const double r = std::max(range_m, kNearest);
  return eirp_w * received_1m_ / (r * r);
}

double OneWayLink::sent_watts(double range_m) const {
  const double r = std::max(range_m, kNearest);
  return sent_1m_ / (r * r);
}

bool behind_land(const HiddenHeight& hidden, Polar place, double height_m, double antenna_height_m,
                 double cell_m, double known_to_m) {
  if (!hidden) return false;
  const double before = place.range_m - 2.0 * cell_m;
  const double range = std::min(before, known_to_m);
  if (range <= 0.0) return false;
  double shadow = static_cast<double>(hidden(place.units, range));
  if (shadow <= 0.0) return false;
  if (range < before) shadow = antenna_height_m + (shadow - antenna_height_m) * before / range;
  return height_m < shadow;
}

BeamBound::BeamBound(const RadarSet& set)
    : main_units_(reach_units(kMainLobe * set.beam_width_deg + kMargin)),
      near_units_(std::max(main_units_, reach_units(kNearLobes + kMargin))),
      near_(static_cast<float>(
          ratio_from_decibels(std::max(set.near_side_lobe_db, set.far_side_lobe_db)))),
      far_(static_cast<float>(ratio_from_decibels(set.far_side_lobe_db))) {}

Sector::Sector(std::uint32_t first_units, std::uint32_t last_units) {
  const auto width = static_cast<std::int32_t>(last_units - first_units);
  middle_units = first_units + static_cast<std::uint32_t>(width / 2);
  half_units = static_cast<std::uint32_t>(std::abs(std::int64_t{width}) / 2 + 1);
}

}  // namespace skerry::echo
