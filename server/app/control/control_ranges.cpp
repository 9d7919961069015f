#include "server/app/control/control_ranges.hpp"

#include <fmt/format.h>
#include <google/protobuf/message.h>
#include <google/protobuf/unknown_field_set.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::server {
namespace {

using wire::Descriptor;
using wire::FieldDescriptor;
using wire::Message;

// The field of `set` whose type is the schema of controls; nullptr if there is none.
const FieldDescriptor* carrier_of(const Descriptor& set, const Descriptor& controls) {
  for (const FieldDescriptor* field : wire::fields_of(set)) {
    if (field->message_type() == &controls) return field;
  }
  return nullptr;
}

// The field of the schema that says what a number of a Set may be; nullptr if none does.
const FieldDescriptor* ruled(const FieldDescriptor& field, const Descriptor& controls) {
  const auto& own = wire::rule_of(field);
  if (own.has_min() || own.has_max() || own.one_of_size() > 0) return &field;
  return controls.FindFieldByName(field.name());
}

std::optional<wire::Reply> refusal_of_number(const FieldDescriptor& field, double value) {
  if (wire::is_allowed(field, value)) return std::nullopt;
  const auto& rule = wire::rule_of(field);
  if (field.name() == "range_nm") {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("range: {} NM is no range scale; allowed: {}", value,
                               fmt::join(rule.one_of().begin(), rule.one_of().end(), ", ")));
  }
  return refusal(wire::Reply::OUT_OF_RANGE,
                 fmt::format("{}: {} is out of range; allowed: {}", wire::spoken_name(field), value,
                             wire::allowed_by(rule)));
}

std::optional<wire::Reply> refusal_of_message(const Message& message, const Descriptor& controls);

std::optional<wire::Reply> refusal_of_field(const Message& message, const FieldDescriptor& field,
                                            const Descriptor& controls) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      if (const FieldDescriptor* const rule = ruled(field, controls)) {
        return refusal_of_number(*rule, reflection.GetDouble(message, &field));
      }
      return refusal(wire::Reply::UNKNOWN, fmt::format("{}: has no range here", field.name()));
    case FieldDescriptor::CPPTYPE_ENUM: {
      const int value = reflection.GetEnumValue(message, &field);
      if (field.enum_type()->FindValueByNumber(value) != nullptr) return std::nullopt;
      return refusal(wire::Reply::OUT_OF_RANGE,
                     fmt::format("{}: {} is out of range; allowed: 0 to {}", field.name(), value,
                                 field.enum_type()->value_count() - 1));
    }
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      if (!field.is_repeated()) {
        return refusal_of_message(reflection.GetMessage(message, &field), controls);
      }
      for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
        auto wrong =
            refusal_of_message(reflection.GetRepeatedMessage(message, &field, i), controls);
        if (wrong) return wrong;
      }
      return std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<wire::Reply> refusal_of_message(const Message& message, const Descriptor& controls) {
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
    if (auto wrong = refusal_of_field(message, *field, controls)) return wrong;
  }
  return std::nullopt;
}

// Fields of Set that say where it goes and how, and change nothing by themselves.
constexpr std::array<std::string_view, 6> kNotControls = {"radar", "view",   "token",
                                                          "lock",  "unlock", "instructor"};

// Controls that a Set has fields of its own for do not come within `controls` as well.
std::optional<wire::Reply> refusal_of_places(const Message& set, const Descriptor& controls) {
  const FieldDescriptor* const outer = carrier_of(*set.GetDescriptor(), controls);
  if (outer == nullptr) return std::nullopt;
  const Message& inner = set.GetReflection()->GetMessage(set, outer);
  std::vector<const FieldDescriptor*> present;
  inner.GetReflection()->ListFields(inner, &present);
  for (const FieldDescriptor* field : present) {
    if (wire::place_of(*set.GetDescriptor(), *field)->outer != nullptr) continue;
    return refusal(wire::Reply::MALFORMED,
                   fmt::format("{}: is a field of {} itself, not of its {}", field->name(),
                               set.GetDescriptor()->name(), outer->name()));
  }
  return std::nullopt;
}

// An order to the wheel or the lever and one to who or what keeps course or speed instead: one of
// them would silently win.
std::optional<wire::Reply> refusal_of_orders(const wire::Set& set) {
  const wire::ConOrder& con = set.con();
  if (set.has_speed_kn() && con.has_engine_percent()) {
    return refusal(wire::Reply::REFUSED,
                   "engine: given together with an ordered speed; expected one of the two");
  }
  if (set.has_course_deg() &&
      (con.has_rudder_deg() || con.has_heading_deg() || con.has_steering())) {
    return refusal(wire::Reply::REFUSED,
                   fmt::format("{}: given together with an ordered course; expected one of the two",
                               con.has_rudder_deg()    ? "rudder"
                               : con.has_heading_deg() ? "heading"
                                                       : "steering"));
  }
  return std::nullopt;
}

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

std::vector<std::string> control_names(const Descriptor& set, const Descriptor& controls) {
  std::vector<std::string> names;
  for (const FieldDescriptor* field : wire::fields_of(set)) {
    const auto& name = field->name();
    if (field != carrier_of(set, controls) &&
        std::find(kNotControls.begin(), kNotControls.end(), name) == kNotControls.end()) {
      names.push_back(name);
    }
  }
  for (const FieldDescriptor* field : wire::fields_of(controls)) {
    if (set.FindFieldByName(field->name()) == nullptr) names.push_back(field->name());
  }
  return names;
}

std::vector<std::string> control_names() {
  return control_names(*wire::Set::descriptor(), *wire::Controls::descriptor());
}

bool is_control(const std::string& name) {
  const std::vector<std::string> names = control_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

wire::Reply refusal(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

std::optional<wire::Reply> refusal_of_values(const Message& set, const Descriptor& controls) {
  if (auto wrong = refusal_of_message(set, controls)) return wrong;
  return refusal_of_places(set, controls);
}

std::optional<wire::Reply> refusal_of(const wire::Set& set) {
  if (auto wrong = refusal_of_values(set, *wire::Controls::descriptor())) return wrong;
  if (set.blanked_sectors().sectors_size() > kMaxSectorsSet) {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("blanked sectors: {} of them; allowed: at most {}",
                               set.blanked_sectors().sectors_size(), kMaxSectorsSet));
  }
  if (auto wrong = refusal_of_orders(set)) return wrong;
  return refusal_of_locks(set);
}

}  // namespace skerry::server
