#include "server/replay/input_messages.hpp"

#include <chrono>
#include <cstdint>
#include <cstdlib>

#include "protocol/recording/item.hpp"
#include "server/radar/control_values.hpp"

namespace skerry::server {

recording::Input::Radar message_of(const echo::RadarControls& controls) {
  recording::Input::Radar message;
  write_controls(controls, message);
  for (const echo::BlankedSector& sector : controls.blanked) {
    message.add_blanked_from_deg(sector.from_deg);
    message.add_blanked_to_deg(sector.to_deg);
  }
  return message;
}

recording::Input::Clock message_of(const UtcClock& clock) {
  recording::Input::Clock message;
  message.set_from_ns(clock.from.time_since_epoch().count());
  message.set_utc_ns(static_cast<std::uint64_t>(clock.utc.time_since_epoch().count()));
  message.set_slew_ppm(clock.slew_ppm);
  return message;
}

std::optional<UtcClock> clock_of(const recording::Input::Clock& message) {
  constexpr std::int64_t kLongest = Duration(std::chrono::hours(24 * 366 * 4)).count();
  constexpr std::int32_t kMostSlew = 1000;
  const auto latest = static_cast<std::uint64_t>(recording::kLatestTime.time_since_epoch().count());
  if (message.from_ns() > kLongest || message.from_ns() < -kLongest || message.utc_ns() > latest ||
      std::abs(std::int64_t{message.slew_ppm()}) > kMostSlew) {
    return std::nullopt;
  }
  return UtcClock{ScenarioTime(Duration(message.from_ns())),
                  UtcTime(Duration(static_cast<std::int64_t>(message.utc_ns()))),
                  message.slew_ppm()};
}

std::optional<echo::RadarControls> controls_of(const recording::Input::Radar& message) {
  if (message.blanked_from_deg_size() != message.blanked_to_deg_size()) return std::nullopt;
  echo::RadarControls controls;
  if (!read_controls(message, controls)) return std::nullopt;
  for (int i = 0; i < message.blanked_from_deg_size(); ++i) {
    controls.blanked.push_back({message.blanked_from_deg(i), message.blanked_to_deg(i)});
  }
  if (echo::fault_of(controls)) return std::nullopt;
  return controls;
}

recording::Input::View message_of(const ViewInForce& view) {
  recording::Input::View message;
  message.set_view(view.number);
  message.set_range_scale(static_cast<std::uint32_t>(view.controls.range_scale.index()));
  write_controls(view.controls, message);
  return message;
}

std::optional<ViewInForce> view_of(const recording::Input::View& message) {
  const auto range = RangeScale::from_index(message.range_scale());
  ViewInForce view;
  if (!range || !read_controls(message, view.controls)) return std::nullopt;
  view.number = message.view();
  view.controls.range_scale = *range;
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
