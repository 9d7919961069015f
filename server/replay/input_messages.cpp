#include "server/replay/input_messages.hpp"

#include <cstdint>

namespace skerry::server {
namespace {

template <typename Enum>
std::optional<Enum> choice_of(std::uint32_t number, Enum last) {
  if (number > static_cast<std::uint32_t>(last)) return std::nullopt;
  return static_cast<Enum>(number);
}

}  // namespace

recording::Input::Radar message_of(const echo::RadarControls& controls) {
  recording::Input::Radar message;
  message.set_transmit(controls.transmit);
  message.set_pulse(static_cast<std::uint32_t>(controls.pulse));
  message.set_tune_auto(controls.tune_auto);
  message.set_tune(controls.tune);
  message.set_rotation_rpm(controls.rotation_rpm);
  message.set_bearing_alignment_deg(controls.bearing_alignment_deg);
  message.set_antenna_height_m(controls.antenna_height_m);
  for (const echo::BlankedSector& sector : controls.blanked) {
    message.add_blanked_from_deg(sector.from_deg);
    message.add_blanked_to_deg(sector.to_deg);
  }
  return message;
}

std::optional<echo::RadarControls> controls_of(const recording::Input::Radar& message) {
  const auto pulse = choice_of(message.pulse(), echo::PulseChoice::long_pulse);
  if (!pulse || message.blanked_from_deg_size() != message.blanked_to_deg_size()) {
    return std::nullopt;
  }
  echo::RadarControls controls;
  controls.transmit = message.transmit();
  controls.pulse = *pulse;
  controls.tune_auto = message.tune_auto();
  controls.tune = message.tune();
  controls.rotation_rpm = message.rotation_rpm();
  controls.bearing_alignment_deg = message.bearing_alignment_deg();
  controls.antenna_height_m = message.antenna_height_m();
  for (int i = 0; i < message.blanked_from_deg_size(); ++i) {
    controls.blanked.push_back({message.blanked_from_deg(i), message.blanked_to_deg(i)});
  }
  if (echo::fault_of(controls)) return std::nullopt;
  return controls;
}

recording::Input::View message_of(const ViewInForce& view) {
  const echo::ViewControls& controls = view.controls;
  recording::Input::View message;
  message.set_view(view.number);
  message.set_range_scale(static_cast<std::uint32_t>(controls.range_scale.index()));
  message.set_gain(controls.gain);
  message.set_sea(controls.sea);
  message.set_rain(controls.rain);
  message.set_interference_rejection(controls.interference_rejection);
  message.set_echo_stretch(controls.echo_stretch);
  message.set_integration(controls.integration);
  message.set_sea_auto(controls.sea_auto);
  message.set_stretch_bearing(controls.stretch_bearing);
  message.set_decimation(static_cast<std::uint32_t>(controls.decimation));
  message.set_gain_auto(controls.gain_auto);
  message.set_side_lobe_suppression(controls.side_lobe_suppression);
  message.set_side_lobe_auto(controls.side_lobe_auto);
  message.set_noise_rejection(controls.noise_rejection);
  message.set_target_separation(controls.target_separation);
  message.set_target_boost(controls.target_boost);
  message.set_doppler(static_cast<std::uint32_t>(controls.doppler));
  message.set_doppler_threshold_mps(controls.doppler_threshold_mps);
  message.set_mode(static_cast<std::uint32_t>(controls.mode));
  message.set_instrumented_range_m(controls.instrumented_range_m);
  return message;
}

std::optional<ViewInForce> view_of(const recording::Input::View& message) {
  const auto range = RangeScale::from_index(message.range_scale());
  const auto decimation = choice_of(message.decimation(), echo::Decimation::mean);
  const auto doppler = choice_of(message.doppler(), echo::DopplerMode::approaching);
  const auto mode = choice_of(message.mode(), echo::PictureMode::bird);
  if (!range || !decimation || !doppler || !mode) return std::nullopt;
  ViewInForce view;
  view.number = message.view();
  echo::ViewControls& controls = view.controls;
  controls.range_scale = *range;
  controls.gain = message.gain();
  controls.sea = message.sea();
  controls.rain = message.rain();
  controls.interference_rejection = message.interference_rejection();
  controls.echo_stretch = message.echo_stretch();
  controls.integration = message.integration();
  controls.sea_auto = message.sea_auto();
  controls.stretch_bearing = message.stretch_bearing();
  controls.decimation = *decimation;
  controls.gain_auto = message.gain_auto();
  controls.side_lobe_suppression = message.side_lobe_suppression();
  controls.side_lobe_auto = message.side_lobe_auto();
  controls.noise_rejection = message.noise_rejection();
  controls.target_separation = message.target_separation();
  controls.target_boost = message.target_boost();
  controls.doppler = *doppler;
  controls.doppler_threshold_mps = message.doppler_threshold_mps();
  controls.mode = *mode;
  controls.instrumented_range_m = message.instrumented_range_m();
  if (echo::fault_of(controls)) return std::nullopt;
  return view;
}

recording::Input::Fix message_of(const OwnShipFix& fix) {
  recording::Input::Fix message;
  if (fix.position) {
    message.set_latitude_deg(fix.position->latitude_deg);
    message.set_longitude_deg(fix.position->longitude_deg);
  }
  if (fix.heading_deg) message.set_heading_deg(*fix.heading_deg);
  if (fix.course_over_ground_deg) {
    message.set_course_over_ground_deg(*fix.course_over_ground_deg);
  }
  if (fix.speed_mps) message.set_speed_mps(*fix.speed_mps);
  if (fix.rate_of_turn_deg_min) message.set_rate_of_turn_deg_min(*fix.rate_of_turn_deg_min);
  return message;
}

OwnShipFix fix_of(const recording::Input::Fix& message) {
  OwnShipFix fix;
  if (message.has_latitude_deg() && message.has_longitude_deg()) {
    fix.position = GeoPoint{message.latitude_deg(), message.longitude_deg()};
  }
  if (message.has_heading_deg()) fix.heading_deg = message.heading_deg();
  if (message.has_course_over_ground_deg()) {
    fix.course_over_ground_deg = message.course_over_ground_deg();
  }
  if (message.has_speed_mps()) fix.speed_mps = message.speed_mps();
  if (message.has_rate_of_turn_deg_min()) {
    fix.rate_of_turn_deg_min = message.rate_of_turn_deg_min();
  }
  return fix;
}

}  // namespace skerry::server
