#include "server/relayed/values_in_range.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/wire/controls.pb.h"
#include "protocol/wire/schema.hpp"
#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

struct Range {
  std::string_view field;
  double min, max;
};

// The numbers of Settings, OwnShip, ConState, World, Traffic, RadarInfo, ExerciseState, TargetList
// and TargetPlots that are no controls; as in a Set, and wider where radars and ships of other
// makers are.  Those of faults and waypoints have their rules in the schema.
constexpr double kLast = 359.999999;  // [0, 360)
constexpr Range kRanges[] = {
    {"radar_range_nm", 0.0, 96.0},
    {"pulse_length_us", 0.0, 1000.0},
    {"prf_hz", 0.0, 100'000.0},
    {"from_deg", 0.0, 360.0},
    {"to_deg", 0.0, 360.0},
    {"scenario_s", 0.0, 1e9},
    {"exercise_s", 0.0, 1e10},
    {"rate", 0.0, 20.0},
    {"sea_state", 0.0, 6.0},
    {"wind_from_deg", 0.0, kLast},
    {"swell_height_m", 0.0, 15.0},
    {"swell_period_s", 0.0, 25.0},
    {"swell_from_deg", 0.0, kLast},
    {"wave_height_m", 0.0, 15.0},
    {"k_factor", 0.8, 4.0},
    {"ducting", 0.0, 1.0},
    {"latitude_deg", -90.0, 90.0},
    {"longitude_deg", -180.0, 180.0},
    {"radius_nm", 0.1, 50.0},
    {"rate_mm_h", 0.1, 100.0},
    {"drift_deg", 0.0, kLast},
    {"drift_kn", 0.0, 60.0},
    {"heading_deg", 0.0, kLast},
    {"speed_kn", -100.0, 100.0},
    {"rate_of_turn_deg_min", -1200.0, 1200.0},
    {"ordered_course_deg", 0.0, kLast},
    {"ordered_speed_kn", -100.0, 100.0},
    {"course_over_ground_deg", 0.0, kLast},
    {"speed_over_ground_kn", 0.0, 100.0},
    {"speed_mps", 0.0, 52.0},
    {"length_m", 0.0, 500.0},
    {"beam_m", 0.0, 100.0},
    {"rpm", 0.0, 60.0},
    {"beam_width_deg", 0.0, 90.0},
    // Of the water and the con.
    {"wind_kn", 0.0, 100.0},
    {"current_set_deg", 0.0, kLast},
    {"current_kn", 0.0, 12.0},
    {"depth_m", 0.0, 12'000.0},
    {"visibility_nm", 0.02, 30.0},
    {"rudder_deg", -90.0, 90.0},
    {"rudder_order_deg", -90.0, 90.0},
    {"engine_percent", -100.0, 100.0},
    {"shaft_rpm", -10'000.0, 10'000.0},
    {"bow_thruster_percent", -100.0, 100.0},
    {"stern_thruster_percent", -100.0, 100.0},
    {"heading_order_deg", 0.0, kLast},
    {"water_ahead_kn", -100.0, 100.0},
    {"water_starboard_kn", -100.0, 100.0},
    {"ground_ahead_kn", -100.0, 100.0},
    {"ground_starboard_kn", -100.0, 100.0},
    {"roll_deg", -180.0, 180.0},
    {"depth_below_keel_m", -100.0, 12'000.0},
    {"draught_m", 0.0, 100.0},
    {"turn_rate_deg_min", 0.0, 720.0},
    {"full_ahead_rpm", 0.0, 10'000.0},
    {"full_astern_rpm", 0.0, 10'000.0},
    {"service_speed_kn", 0.0, 100.0},
    {"rudder_limit_deg", 0.0, 90.0},
    {"waypoint_m", 0.0, 2e7},
    {"cross_track_m", -2e7, 2e7},
    // Of the exercise.
    {"gyro_error_deg", -360.0, 360.0},
    {"gnss_error_m", 0.0, 2e7},
    {"position_s", 0.0, 1e10},
    // Of targets; cpa_nm and tcpa_min also of TargetRules.
    {"course_deg", 0.0, kLast},
    {"range_m", 0.0, 2e7},
    {"bearing_deg", 0.0, kLast},
    {"relative_course_deg", 0.0, kLast},
    {"relative_speed_kn", 0.0, 1000.0},
    {"cpa_nm", 0.0, 10'800.0},
    {"tcpa_min", -1e6, 1e6},
    {"age_s", 0.0, 1e9},
    {"tracked_s", 0.0, 1e9},
    {"place_sigma_m", 0.0, 2e7},
    {"speed_sigma_kn", 0.0, 1000.0},
    {"width_m", 0.0, 2e7},
    {"own_course_deg", 0.0, kLast},
    {"own_speed_kn", 0.0, 100.0},
    {"own_latitude_deg", -90.0, 90.0},
    {"own_longitude_deg", -180.0, 180.0},
    {"own_heading_deg", 0.0, kLast},
    {"begins_s", 0.0, 1e9},
};

// Controls may be 0 as well: of radars of other makers they are not known.
std::optional<Range> range_of(const FieldDescriptor& described) {
  const std::string& field = described.name();
  const auto found = std::find_if(std::begin(kRanges), std::end(kRanges),
                                  [&](const Range& range) { return range.field == field; });
  if (found != std::end(kRanges)) return *found;
  const auto* const control = wire::Controls::descriptor()->FindFieldByName(field);
  const config::FieldRule& rule = wire::rule_of(control != nullptr ? *control : described);
  if (control == nullptr) {
    return rule.has_min() && rule.has_max() ? std::optional(Range{field, rule.min(), rule.max()})
                                            : std::nullopt;
  }
  if (rule.one_of_size() > 0) {
    return Range{field, 0.0, *std::max_element(rule.one_of().begin(), rule.one_of().end())};
  }
  if (!rule.has_max()) return std::nullopt;
  return Range{field, std::min(rule.min(), 0.0), rule.max()};
}

double in_range(const FieldDescriptor& field, double value) {
  const auto range = range_of(field);
  if (!range) return std::isfinite(value) ? value : 0.0;
  // A NaN too fails the first comparison.
  return value > range->min ? std::min(value, range->max) : range->min;
}

void visit_list(Message& message, const Reflection& at, const FieldDescriptor& field) {
  while (at.FieldSize(message, &field) > kLongestList) at.RemoveLast(&message, &field);
  for (int i = 0; i < at.FieldSize(message, &field); ++i) {
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      bring_into_range(*at.MutableRepeatedMessage(&message, &field, i));
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
      at.SetRepeatedDouble(&message, &field, i,
                           in_range(field, at.GetRepeatedDouble(message, &field, i)));
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      at.SetRepeatedString(&message, &field, i,
                           sendable(at.GetRepeatedString(message, &field, i), kLongestText));
    }
  }
}

// Absent numbers are 0, which may lie outside as well.
void visit(Message& message, const Reflection& at, const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      if (at.HasField(message, &field)) bring_into_range(*at.MutableMessage(&message, &field));
      break;
    case FieldDescriptor::CPPTYPE_DOUBLE:
      if (field.has_presence() && !at.HasField(message, &field)) break;
      at.SetDouble(&message, &field, in_range(field, at.GetDouble(message, &field)));
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      if (!field.enum_type()->FindValueByNumber(at.GetEnumValue(message, &field))) {
        at.SetEnumValue(&message, &field, 0);
      }
      break;
    case FieldDescriptor::CPPTYPE_STRING:
      at.SetString(&message, &field, sendable(at.GetString(message, &field), kLongestText));
      break;
    default:
      break;
  }
}

}  // namespace

void bring_into_range(Message& message) {
  const auto* descriptor = message.GetDescriptor();
  const Reflection& at = *message.GetReflection();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const FieldDescriptor& field = *descriptor->field(i);
    if (field.is_repeated()) {
      visit_list(message, at, field);
    } else {
      visit(message, at, field);
    }
  }
}

bool has_range(const FieldDescriptor& field) { return range_of(field).has_value(); }

}  // namespace skerry::server
