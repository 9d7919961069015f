#include "server/app/control_ranges.hpp"

#include <fmt/format.h>
#include <google/protobuf/message.h>
#include <google/protobuf/unknown_field_set.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

struct Range {
  std::string_view field;  // of the message
  std::string_view name;   // in replies
  double min, max;
  std::string_view unit;
};

// Each number of Set, BlankedSectors, WorldChange and RainChange; the ranges of the world are those
// of scenario.proto, and an instrumented range goes to twice the longest range scale.  Held by
// ControlRanges.EveryNumberHasARange.
constexpr Range kRanges[] = {
    {"course_deg", "course", 0.0, 360.0, " deg"},
    {"speed_kn", "speed", -10.0, 60.0, " kn"},
    {"range_nm", "range", 0.125, 96.0, " NM"},
    {"gain", "gain", 0.0, 100.0, ""},
    {"sea", "sea", 0.0, 100.0, ""},
    {"rain", "rain", 0.0, 100.0, ""},
    {"interference_rejection", "interference rejection", 0.0, 100.0, ""},
    {"echo_stretch", "echo stretch", 0.0, 100.0, ""},
    {"integration", "integration", 0.0, 100.0, ""},
    {"tune", "tune", 0.0, 100.0, ""},
    {"side_lobe_suppression", "side lobe suppression", 0.0, 100.0, ""},
    {"noise_rejection", "noise rejection", 0.0, 100.0, ""},
    {"target_separation", "target separation", 0.0, 100.0, ""},
    {"target_boost", "target boost", 0.0, 100.0, ""},
    {"doppler_threshold_mps", "doppler threshold", 0.1, 20.0, " m/s"},
    {"instrumented_range_m", "instrumented range", 0.0, 355'584.0, " m"},
    {"rotation_rpm", "rotation", 10.0, 60.0, " turns/min"},
    {"bearing_alignment_deg", "bearing alignment", -180.0, 180.0, " deg"},
    {"antenna_height_m", "antenna height", 1.0, 100.0, " m"},
    {"from_deg", "blanked sector from", 0.0, 360.0, " deg"},
    {"to_deg", "blanked sector to", 0.0, 360.0, " deg"},
    {"sea_state", "sea state", 0.0, 6.0, ""},
    {"wind_from_deg", "wind from", 0.0, 360.0, " deg"},
    {"swell_height_m", "swell height", 0.0, 15.0, " m"},
    {"swell_period_s", "swell period", 4.0, 25.0, " s"},
    {"swell_from_deg", "swell from", 0.0, 360.0, " deg"},
    {"wave_height_m", "wave height", 0.0, 15.0, " m"},
    {"k_factor", "k factor", 0.8, 4.0, ""},
    {"ducting", "ducting", 0.0, 1.0, ""},
    {"latitude_deg", "rain latitude", -90.0, 90.0, " deg"},
    {"longitude_deg", "rain longitude", -180.0, 180.0, " deg"},
    {"radius_nm", "rain radius", 0.1, 50.0, " NM"},
    {"rate_mm_h", "rain rate", 0.1, 100.0, " mm/h"},
    {"drift_deg", "rain drift", 0.0, 360.0, " deg"},
    {"drift_kn", "rain drift", 0.0, 60.0, " kn"},
};

std::string range_scales_text() {
  return fmt::format("{}", fmt::join(RangeScale::kNauticalMiles, ", "));
}

std::optional<wire::Reply> refusal_of_number(const FieldDescriptor& field, double value) {
  const auto range = std::find_if(std::begin(kRanges), std::end(kRanges),
                                  [&](const Range& r) { return r.field == field.name(); });
  if (range == std::end(kRanges)) {
    return refusal(wire::Reply::UNKNOWN, fmt::format("{}: has no range here", field.name()));
  }
  if (field.name() == "range_nm") {
    if (RangeScale::find(value)) return std::nullopt;
    return refusal(
        wire::Reply::OUT_OF_RANGE,
        fmt::format("range: {} NM is no range scale; allowed: {}", value, range_scales_text()));
  }
  if (value >= range->min && value <= range->max) return std::nullopt;  // false for NaN
  return refusal(wire::Reply::OUT_OF_RANGE,
                 fmt::format("{}: {} is out of range; allowed: {} to {}{}", range->name, value,
                             range->min, range->max, range->unit));
}

std::optional<wire::Reply> refusal_of_message(const Message& message);

std::optional<wire::Reply> refusal_of_field(const Message& message, const FieldDescriptor& field) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return refusal_of_number(field, reflection.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_ENUM: {
      const int value = reflection.GetEnumValue(message, &field);
      if (field.enum_type()->FindValueByNumber(value) != nullptr) return std::nullopt;
      return refusal(wire::Reply::OUT_OF_RANGE,
                     fmt::format("{}: {} is out of range; allowed: 0 to {}", field.name(), value,
                                 field.enum_type()->value_count() - 1));
    }
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      if (!field.is_repeated()) return refusal_of_message(reflection.GetMessage(message, &field));
      for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
        auto wrong = refusal_of_message(reflection.GetRepeatedMessage(message, &field, i));
        if (wrong) return wrong;
      }
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<wire::Reply> refusal_of_message(const Message& message) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  const auto& unknown = reflection.GetUnknownFields(message);
  if (!unknown.empty()) {
    return refusal(wire::Reply::UNKNOWN,
                   fmt::format("{}: this server knows no control with field number {}",
                               message.GetDescriptor()->name(), unknown.field(0).number()));
  }
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (auto wrong = refusal_of_field(message, *field)) return wrong;
  }
  return std::nullopt;
}

// What says where a Set goes and how, and changes nothing by itself.
constexpr std::array<std::string_view, 6> kNotControls = {"radar", "view",   "token",
                                                          "lock",  "unlock", "instructor"};

std::optional<wire::Reply> refusal_of_locks(const wire::Set& set) {
  if (set.lock().empty() && set.unlock().empty()) return std::nullopt;
  if (!set.instructor()) {
    return refusal(wire::Reply::REFUSED, "lock: only the instructor locks and unlocks controls");
  }
  for (const auto* names : {&set.lock(), &set.unlock()}) {
    for (const std::string& name : *names) {
      if (is_control(name)) continue;
      return refusal(wire::Reply::UNKNOWN,
                     fmt::format("lock: there is no control \"{}\"; allowed: {}",
                                 name.substr(0, 40), fmt::join(control_names(), ", ")));
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> control_names() {
  std::vector<std::string> names;
  const google::protobuf::Descriptor& set = *wire::Set::descriptor();
  for (int i = 0; i < set.field_count(); ++i) {
    const std::string& name = set.field(i)->name();
    if (std::find(kNotControls.begin(), kNotControls.end(), name) == kNotControls.end()) {
      names.push_back(name);
    }
  }
  return names;
}

bool is_control(const std::string& name) {
  const FieldDescriptor* const field = wire::Set::descriptor()->FindFieldByName(name);
  return field != nullptr &&
         std::find(kNotControls.begin(), kNotControls.end(), name) == kNotControls.end();
}

wire::Reply refusal(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

std::optional<wire::Reply> refusal_of(const wire::Set& set) {
  if (auto wrong = refusal_of_message(set)) return wrong;
  if (set.blanked_sectors().sectors_size() > kMaxSectorsSet) {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("blanked sectors: {} of them; allowed: at most {}",
                               set.blanked_sectors().sectors_size(), kMaxSectorsSet));
  }
  return refusal_of_locks(set);
}

}  // namespace skerry::server
