// Tracked targets, and alerts about them, as Signal K displays are told of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/signalk/json.hpp"

namespace skerry::signalk {

// Absent: not known yet, or not at all.
struct Target {
  enum class Status : std::uint8_t { acquiring, tracking, lost };

  std::uint32_t number = 0;
  Status status = Status::tracking;
  GeoPoint position;
  double range_m = 0.0;
  double bearing_deg = 0.0;                               // true
  std::optional<double> course_deg = {}, speed_mps = {};  // true
  std::optional<double> cpa_m = {}, tcpa_s = {};          // told only if it is to come
  bool acquired_by_hand = false;
  std::string name = {};   // of the ship, by AIS; empty: not known
  std::uint32_t mmsi = 0;  // the same; 0
  UtcTime first_seen{}, last_seen{};
};
Json target_document(const Target& target);

// A value of a path below `notifications`; Signal K specification 1.7, "Notifications".
enum class NotificationState : std::uint8_t { normal, alert, warn, alarm };
// `sounds`: it is not yet acknowledged.
Json notification_document(NotificationState state, bool sounds, const std::string& message,
                           UtcTime time);

// "2026-11-21T08:15:30.250Z"
std::string iso_time(UtcTime time);

}  // namespace skerry::signalk
