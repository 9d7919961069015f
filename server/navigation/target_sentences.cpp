#include "server/navigation/target_sentences.hpp"

#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr double kNm = Length::kMetresPerNauticalMile;

std::optional<double> divided(const std::optional<double>& value, double by) {
  return value ? std::optional(*value / by) : std::nullopt;
}

nmea::TargetStatus status_of(const ToldTarget& target) {
  switch (target.status) {
    case ToldTarget::Status::lost:
      return nmea::TargetStatus::lost;
    case ToldTarget::Status::acquiring:
      return nmea::TargetStatus::acquiring;
    default:
      return nmea::TargetStatus::tracking;
  }
}

std::string ttm_of(const ToldTarget& target, UtcTime utc) {
  return encode(nmea::Ttm{.number = target.number,
                          .range_nm = target.range_m / kNm,
                          .bearing_deg = target.bearing_deg,
                          .speed_kn = divided(target.speed_mps, kKnot),
                          .course_deg = target.course_deg,
                          .cpa_nm = divided(target.cpa_m, kNm),
                          .tcpa_min = divided(target.tcpa_s, 60.0),
                          .name = target.name,
                          .status = status_of(target),
                          .time_of_day = nmea::time_of_day(utc),
                          .is_reference = target.is_reference,
                          .acquisition = target.by_hand ? nmea::TargetAcquisition::manual
                                                        : nmea::TargetAcquisition::automatic});
}

std::string tll_of(const ToldTarget& target, UtcTime utc) {
  return encode(nmea::Tll{.number = target.number,
                          .position = target.place,
                          .name = target.name,
                          .time_of_day = nmea::time_of_day(utc),
                          .status = status_of(target),
                          .is_reference = target.is_reference});
}

nmea::TtdStatus ttd_status_of(const ToldTarget& target) {
  switch (target.status) {
    case ToldTarget::Status::acquiring:
      return nmea::TtdStatus::acquiring;
    case ToldTarget::Status::lost:
      return nmea::TtdStatus::lost;
    case ToldTarget::Status::alarm:
      return nmea::TtdStatus::tracking_alarm;
    case ToldTarget::Status::alarm_acknowledged:
      return nmea::TtdStatus::tracking_confirmed;
    case ToldTarget::Status::tracking:
      break;
  }
  return nmea::TtdStatus::tracking;
}

nmea::TtdTarget ttd_of(const ToldTarget& target) {
  return {.number = target.number,
          .bearing_deg = target.bearing_deg,
          // The sentence says that they are over ground.
          .speed_kn = target.through_water ? std::nullopt : divided(target.speed_mps, kKnot),
          .course_deg = target.through_water ? std::nullopt : target.course_deg,
          .heading_deg = target.heading_deg,
          .range_nm = target.range_m / kNm,
          .status = ttd_status_of(target)};
}

}  // namespace

std::vector<std::string> target_sentences(NavigationSentence sentence,
                                          std::span<const ToldTarget> targets, UtcTime utc,
                                          unsigned identifier) {
  if (sentence == NavigationSentence::ttd) {
    std::vector<nmea::TtdTarget> packed;
    for (const ToldTarget& target : targets) packed.push_back(ttd_of(target));
    return nmea::encode_ttd(packed, identifier);
  }
  if (sentence == NavigationSentence::tlb) {
    std::vector<nmea::TargetLabel> labels;
    for (const ToldTarget& target : targets) {
      const std::string& label = target.name.empty() ? target.label : target.name;
      if (!label.empty()) labels.push_back({target.number, label});
    }
    return nmea::encode_tlb(labels);
  }
  std::vector<std::string> lines;
  for (const ToldTarget& target : targets) {
    lines.push_back(sentence == NavigationSentence::ttm ? ttm_of(target, utc)
                                                        : tll_of(target, utc));
  }
  return lines;
}

}  // namespace skerry::server
