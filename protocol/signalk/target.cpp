#include "protocol/signalk/target.hpp"

#include <fmt/format.h>

#include <chrono>

#include "protocol/quantity/angle.hpp"

namespace skerry::signalk {
namespace {

const char* word_of(Target::Status status) {
  switch (status) {
    case Target::Status::acquiring:
      return "acquiring";
    case Target::Status::lost:
      return "lost";
    case Target::Status::tracking:
      break;
  }
  return "tracking";
}

const char* word_of(NotificationState state) {
  switch (state) {
    case NotificationState::alert:
      return "alert";
    case NotificationState::warn:
      return "warn";
    case NotificationState::alarm:
      return "alarm";
    case NotificationState::normal:
      break;
  }
  return "normal";
}

}  // namespace

Json target_document(const Target& target) {
  Json document{
      {"id", target.number},
      {"status", word_of(target.status)},
      {"position",
       {{"bearing", wrapped_degrees(target.bearing_deg) * kRadiansPerDegree},
        {"distance", target.range_m},
        {"latitude", target.position.latitude_deg},
        {"longitude", target.position.longitude_deg}}},
      {"acquisition", target.acquired_by_hand ? "manual" : "auto"},
      {"firstSeen", iso_time(target.first_seen)},
      {"lastSeen", iso_time(target.last_seen)},
  };
  if (target.course_deg && target.speed_mps) {
    document["motion"] = {{"course", wrapped_degrees(*target.course_deg) * kRadiansPerDegree},
                          {"speed", *target.speed_mps}};
  }
  if (target.cpa_m && target.tcpa_s && *target.tcpa_s > 0.0) {
    document["danger"] = {{"cpa", *target.cpa_m}, {"tcpa", *target.tcpa_s}};
  }
  if (!target.name.empty()) document["name"] = target.name;
  if (target.mmsi != 0) document["mmsi"] = fmt::format("{:09}", target.mmsi);
  return document;
}

Json notification_document(NotificationState state, bool sounds, const std::string& message,
                           UtcTime time) {
  Json method = Json::array({"visual"});
  if (sounds) method.push_back("sound");
  return {{"state", word_of(state)},
          {"method", std::move(method)},
          {"message", message},
          {"timestamp", iso_time(time)}};
}

std::string iso_time(UtcTime time) {
  namespace chrono = std::chrono;
  const auto day = chrono::floor<chrono::days>(time);
  const chrono::year_month_day date(day);
  const chrono::hh_mm_ss clock(chrono::floor<chrono::milliseconds>(time - day));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", int{date.year()},
                     unsigned{date.month()}, unsigned{date.day()}, clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

}  // namespace skerry::signalk
