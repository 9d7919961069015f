#include "server/app/controls_message.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

// The enums of controls.hpp and radar.proto count alike.
template <typename To, typename From>
constexpr To same(From value) {
  return static_cast<To>(static_cast<int>(value));
}
static_assert(same<int>(wire::PULSE_LONG) == same<int>(echo::PulseChoice::long_pulse));
static_assert(same<int>(wire::PULSE_MEDIUM) == same<int>(echo::PulseChoice::medium_pulse));
static_assert(same<int>(wire::MEAN) == same<int>(echo::Decimation::mean));
static_assert(same<int>(wire::DOPPLER_BOTH) == same<int>(echo::DopplerMode::both));
static_assert(same<int>(wire::DOPPLER_APPROACHING) == same<int>(echo::DopplerMode::approaching));
static_assert(same<int>(wire::HARBOUR) == same<int>(echo::PictureMode::harbour));
static_assert(same<int>(wire::OFFSHORE) == same<int>(echo::PictureMode::offshore));
static_assert(same<int>(wire::BUOY) == same<int>(echo::PictureMode::buoy));
static_assert(same<int>(wire::WEATHER) == same<int>(echo::PictureMode::weather));
static_assert(same<int>(wire::BIRD) == same<int>(echo::PictureMode::bird));

void change_range(const wire::Set& set, echo::ViewControls& controls) {
  const RangeScale before = controls.range_scale;
  if (set.has_range_nm()) controls.range_scale = *RangeScale::find(set.range_nm());
  if (set.has_instrumented_range_m()) {
    controls.instrumented_range_m = set.instrumented_range_m();
  } else {
    controls.instrumented_range_m =
        carried_range_m(controls.instrumented_range_m, before, controls.range_scale);
  }
}

}  // namespace

void change_view(const wire::Set& set, echo::ViewControls& controls) {
  change_range(set, controls);
  if (set.has_gain()) controls.gain = set.gain();
  if (set.has_sea()) controls.sea = set.sea();
  if (set.has_rain()) controls.rain = set.rain();
  if (set.has_sea_auto()) controls.sea_auto = set.sea_auto();
  if (set.has_interference_rejection())
    controls.interference_rejection = set.interference_rejection();
  if (set.has_echo_stretch()) controls.echo_stretch = set.echo_stretch();
  if (set.has_integration()) controls.integration = set.integration();
  if (set.has_stretch_bearing()) controls.stretch_bearing = set.stretch_bearing();
  if (set.has_decimation()) controls.decimation = same<echo::Decimation>(set.decimation());
  if (set.has_gain_auto()) controls.gain_auto = set.gain_auto();
  if (set.has_side_lobe_suppression()) controls.side_lobe_suppression = set.side_lobe_suppression();
  if (set.has_side_lobe_auto()) controls.side_lobe_auto = set.side_lobe_auto();
  if (set.has_noise_rejection()) controls.noise_rejection = set.noise_rejection();
  if (set.has_target_separation()) controls.target_separation = set.target_separation();
  if (set.has_target_boost()) controls.target_boost = set.target_boost();
  if (set.has_doppler()) controls.doppler = same<echo::DopplerMode>(set.doppler());
  if (set.has_doppler_threshold_mps()) controls.doppler_threshold_mps = set.doppler_threshold_mps();
  if (set.has_mode()) controls.mode = same<echo::PictureMode>(set.mode());
}

void change_radar(const wire::Set& set, echo::RadarControls& controls) {
  if (set.has_transmit()) controls.transmit = set.transmit();
  if (set.has_pulse()) controls.pulse = same<echo::PulseChoice>(set.pulse());
  if (set.has_tune_auto()) controls.tune_auto = set.tune_auto();
  if (set.has_tune()) controls.tune = set.tune();
  if (set.has_rotation_rpm()) controls.rotation_rpm = set.rotation_rpm();
  if (set.has_bearing_alignment_deg()) controls.bearing_alignment_deg = set.bearing_alignment_deg();
  if (set.has_antenna_height_m()) controls.antenna_height_m = set.antenna_height_m();
  if (!set.has_blanked_sectors()) return;
  controls.blanked.clear();
  for (const auto& sector : set.blanked_sectors().sectors()) {
    controls.blanked.push_back({sector.from_deg(), sector.to_deg()});
  }
}

void tell_view(const echo::ViewControls& controls, wire::Settings& settings) {
  settings.set_range_nm(controls.range_scale.in_nautical_miles());
  settings.set_gain(controls.gain);
  settings.set_sea(controls.sea);
  settings.set_rain(controls.rain);
  settings.set_sea_auto(controls.sea_auto);
  settings.set_interference_rejection(controls.interference_rejection);
  settings.set_echo_stretch(controls.echo_stretch);
  settings.set_integration(controls.integration);
  settings.set_stretch_bearing(controls.stretch_bearing);
  settings.set_decimation(same<wire::Decimation>(controls.decimation));
  settings.set_gain_auto(controls.gain_auto);
  settings.set_side_lobe_suppression(controls.side_lobe_suppression);
  settings.set_side_lobe_auto(controls.side_lobe_auto);
  settings.set_noise_rejection(controls.noise_rejection);
  settings.set_target_separation(controls.target_separation);
  settings.set_target_boost(controls.target_boost);
  settings.set_doppler(same<wire::DopplerMode>(controls.doppler));
  settings.set_doppler_threshold_mps(controls.doppler_threshold_mps);
  settings.set_mode(same<wire::PictureMode>(controls.mode));
  settings.set_instrumented_range_m(controls.instrumented_range_m);
}

void tell_radar(const echo::RadarControls& controls, const echo::RadarSet& set,
                wire::Settings& settings) {
  settings.set_standby(!controls.transmit);
  settings.set_pulse(same<wire::PulseChoice>(controls.pulse));
  settings.set_tune_auto(controls.tune_auto);
  settings.set_tune(controls.tune);
  settings.set_rotation_rpm(controls.rotation_rpm > 0.0 ? controls.rotation_rpm : set.rpm);
  settings.set_bearing_alignment_deg(controls.bearing_alignment_deg);
  settings.set_antenna_height_m(controls.antenna_height_m > 0.0 ? controls.antenna_height_m
                                                                : set.antenna_height_m);
  settings.clear_blanked_sectors();
  for (const echo::BlankedSector& sector : controls.blanked) {
    auto& said = *settings.mutable_blanked_sectors()->add_sectors();
    said.set_from_deg(sector.from_deg);
    said.set_to_deg(sector.to_deg);
  }
}

double carried_range_m(double instrumented_range_m, RangeScale from, RangeScale to) {
  if (instrumented_range_m == 0.0 || from == to) return instrumented_range_m;
  const double to_m = to.length().in_metres();
  return std::clamp(instrumented_range_m / from.length().in_metres() * to_m, kShortestReach * to_m,
                    kLongestReach * to_m);
}

bool is_instrumented_range(double range_m, RangeScale scale) {
  const double scale_m = scale.length().in_metres();
  return range_m == 0.0 ||
         (range_m >= kShortestReach * scale_m && range_m <= kLongestReach * scale_m);
}

}  // namespace skerry::server
