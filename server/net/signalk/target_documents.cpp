#include "server/net/signalk/target_documents.hpp"

#include <fmt/format.h>

#include "protocol/quantity/length.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

std::optional<double> scaled(bool is_there, double value, double scale) {
  return is_there ? std::optional(value * scale) : std::nullopt;
}

signalk::Target::Status status_of(wire::TargetState state) {
  switch (state) {
    case wire::TARGET_ACQUIRING:
      return signalk::Target::Status::acquiring;
    case wire::TARGET_LOST:
      return signalk::Target::Status::lost;
    default:
      return signalk::Target::Status::tracking;
  }
}

UtcTime utc_of(std::uint64_t nanoseconds) {
  return UtcTime(Duration(static_cast<std::int64_t>(nanoseconds)));
}

}  // namespace

signalk::Json target_document(const wire::Target& target, const wire::TargetList& list) {
  const UtcTime now = utc_of(list.utc_ns());
  return signalk::target_document(
      {.number = target.number(),
       .status = status_of(target.state()),
       .position = {target.latitude_deg(), target.longitude_deg()},
       .range_m = target.range_m(),
       .bearing_deg = target.bearing_deg(),
       .course_deg = scaled(target.has_course_deg(), target.course_deg(), 1.0),
       .speed_mps = scaled(target.has_speed_kn(), target.speed_kn(), kKnot),
       .cpa_m = scaled(target.has_cpa_nm(), target.cpa_nm(), Length::kMetresPerNauticalMile),
       .tcpa_s = scaled(target.has_tcpa_min(), target.tcpa_min(), 60.0),
       .acquired_by_hand = target.by_hand(),
       .name = target.name(),
       .mmsi = target.mmsi(),
       .first_seen = now - seconds_as_duration(target.tracked_s()),
       .last_seen = now - seconds_as_duration(target.age_s())});
}

signalk::OtherVessel tracked_vessel(const wire::Target& target, const wire::TargetList& list) {
  signalk::OtherVessel vessel{.key = signalk::tracked_vessel_key(list.radar(), target.number()),
                              .ship = {.name = fmt::format("Radar target {}", target.number())}};
  vessel.ship.position = GeoPoint{target.latitude_deg(), target.longitude_deg()};
  if (list.stabilisation() == wire::STABILISATION_GROUND && target.has_course_deg()) {
    vessel.ship.course_over_ground_deg = target.course_deg();
    vessel.ship.speed_over_ground_mps = target.speed_kn() * kKnot;
  }
  return vessel;
}

signalk::Json notification_of(const wire::Alert& alert) {
  using signalk::NotificationState;
  NotificationState state = NotificationState::alert;
  if (alert.state() == wire::ALERT_RECTIFIED) {
    state = NotificationState::normal;
  } else if (alert.priority() == wire::ALERT_ALARM) {
    state = NotificationState::alarm;
  } else if (alert.priority() == wire::ALERT_WARNING) {
    state = NotificationState::warn;
  }
  return signalk::notification_document(state, alert.state() == wire::ALERT_ACTIVE, alert.text(),
                                        utc_of(alert.utc_ns()));
}

}  // namespace skerry::server
