#include "server/playback/recorded_values.hpp"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "server/playback/sendable_text.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

struct Range {
  std::string_view field;
  double min, max;
};

// The numbers of Settings, OwnShip, World, Traffic and RadarInfo; as in a Set, and wider where
// radars and ships of other makers are.
constexpr double kLast = 359.999999;  // [0, 360)
constexpr Range kRanges[] = {
    {"range_nm", 0.0, 96.0},
    {"radar_range_nm", 0.0, 96.0},
    {"gain", 0.0, 100.0},
    {"sea", 0.0, 100.0},
    {"rain", 0.0, 100.0},
    {"interference_rejection", 0.0, 100.0},
    {"echo_stretch", 0.0, 100.0},
    {"integration", 0.0, 100.0},
    {"tune", 0.0, 100.0},
    {"pulse_length_us", 0.0, 1000.0},
    {"prf_hz", 0.0, 100'000.0},
    {"side_lobe_suppression", 0.0, 100.0},
    {"noise_rejection", 0.0, 100.0},
    {"target_separation", 0.0, 100.0},
    {"target_boost", 0.0, 100.0},
    {"doppler_threshold_mps", 0.0, 20.0},
    {"instrumented_range_m", 0.0, 355'584.0},
    {"rotation_rpm", 0.0, 60.0},
    {"bearing_alignment_deg", -180.0, 180.0},
    {"antenna_height_m", 0.0, 100.0},
    {"from_deg", 0.0, 360.0},
    {"to_deg", 0.0, 360.0},
    {"scenario_s", 0.0, 1e9},
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
};

const Range* range_of(std::string_view field) {
  const auto found = std::find_if(std::begin(kRanges), std::end(kRanges),
                                  [field](const Range& range) { return range.field == field; });
  return found == std::end(kRanges) ? nullptr : &*found;
}

double in_range(const FieldDescriptor& field, double value) {
  const Range* range = range_of(field.name());
  if (range == nullptr) return std::isfinite(value) ? value : 0.0;
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

bool has_range(const std::string& field) { return range_of(field) != nullptr; }

}  // namespace skerry::server
