#include "protocol/wire/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace skerry::wire {
namespace {

bool is_message(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

// Recorded inputs hold choices as plain numbers.
bool holds_values(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_BOOL:
    case FieldDescriptor::CPPTYPE_ENUM:
    case FieldDescriptor::CPPTYPE_UINT32:
      return !field.is_repeated();
    default:
      return false;
  }
}

double number_in(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? 1.0 : 0.0;
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnumValue(message, &field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(message, &field);
    default:
      return reflection.GetDouble(message, &field);
  }
}

void put_number(Message& message, const FieldDescriptor& field, double value) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.SetBool(&message, &field, value != 0.0);
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.SetEnumValue(&message, &field, static_cast<int>(value));
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.SetUInt32(&message, &field, static_cast<std::uint32_t>(value));
    default:
      return reflection.SetDouble(&message, &field, value);
  }
}

std::string without_unit(const std::string& name) {
  static constexpr std::array<std::string_view, 10> kUnits = {
      "_mm_h", "_mps", "_rpm", "_deg", "_kn", "_nm", "_us", "_db", "_m", "_s"};
  for (const std::string_view unit : kUnits) {
    if (std::string_view(name).ends_with(unit)) return name.substr(0, name.size() - unit.size());
  }
  return name;
}

std::string with(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

// What all values of the enumeration begin with, up to a '_': "PULSE_", "GIVE_WAY_".
std::size_t common_start(const google::protobuf::EnumDescriptor& type) {
  const std::string& first = type.value(0)->name();
  std::size_t common = 0;
  for (std::size_t end; (end = first.find('_', common)) != std::string::npos; common = end + 1) {
    for (int i = 1; i < type.value_count(); ++i) {
      if (type.value(i)->name().compare(0, end + 1, first, 0, end + 1) != 0) return common;
    }
  }
  return common;
}

}  // namespace

const config::FieldRule& rule_of(const FieldDescriptor& field) {
  return field.options().GetExtension(config::rule);
}

const config::Control& control_of(const FieldDescriptor& field) {
  return field.options().GetExtension(config::control);
}

std::string allowed_by(const config::FieldRule& rule) {
  std::string allowed;
  if (rule.one_of_size() > 0) {
    allowed = fmt::format("{}", fmt::join(rule.one_of().begin(), rule.one_of().end(), ", "));
  } else if (rule.has_min() && rule.has_max()) {
    allowed = fmt::format("{} to {}", rule.min(), rule.max());
  } else if (rule.has_min()) {
    allowed = fmt::format("at least {}", rule.min());
  } else if (rule.has_max()) {
    allowed = fmt::format("at most {}", rule.max());
  }
  if (!allowed.empty() && !rule.unit().empty()) allowed += " " + rule.unit();
  return allowed;
}

std::string spoken_name(const FieldDescriptor& field) {
  const std::string& name = rule_of(field).name();
  return name.empty() ? with(without_unit(field.name()), '_', ' ') : name;
}

std::string option_name(const FieldDescriptor& field) {
  const std::string& option = control_of(field).option();
  return option.empty() ? with(without_unit(field.name()), '_', '-') : option;
}

std::string word_of(const EnumValueDescriptor& value) {
  std::string word = value.name();
  const auto is_lower = [](unsigned char c) { return std::islower(c) != 0; };
  if (std::any_of(word.begin(), word.end(), is_lower)) return word;
  word.erase(0, common_start(*value.type()));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::string word_of(const google::protobuf::EnumDescriptor& type, int number) {
  const EnumValueDescriptor* const value = type.FindValueByNumber(number);
  return value != nullptr ? word_of(*value) : "?";
}

std::string label_of(const EnumValueDescriptor& value) {
  const config::Choice& choice = value.options().GetExtension(config::choice);
  if (!choice.label().empty()) return choice.label();
  std::string label = with(word_of(value), '_', ' ');
  if (!label.empty())
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

std::string short_label_of(const EnumValueDescriptor& value) {
  const config::Choice& choice = value.options().GetExtension(config::choice);
  return choice.short_label().empty() ? label_of(value) : choice.short_label();
}

const EnumValueDescriptor* value_named(const FieldDescriptor& field, std::string_view word) {
  for (int i = 0; i < field.enum_type()->value_count(); ++i) {
    const EnumValueDescriptor* const value = field.enum_type()->value(i);
    if (word_of(*value) == word) return value;
  }
  return nullptr;
}

std::vector<const FieldDescriptor*> fields_of(const Descriptor& schema) {
  std::vector<const FieldDescriptor*> fields;
  for (int i = 0; i < schema.field_count(); ++i) fields.push_back(schema.field(i));
  return fields;
}

const FieldDescriptor* automatic_of(const FieldDescriptor& control) {
  for (const FieldDescriptor* field : fields_of(*control.containing_type())) {
    if (control_of(*field).automatic_of() == control.name()) return field;
  }
  return nullptr;
}

std::optional<FieldPlace> place_of(const Descriptor& message, const FieldDescriptor& control) {
  const FieldDescriptor* const own = message.FindFieldByName(control.name());
  if (own != nullptr && (holds_values(*own) || is_message(control)))
    return FieldPlace{nullptr, own};
  const std::string& opposite = control_of(control).opposite();
  if (!opposite.empty()) {
    const FieldDescriptor* const negated = message.FindFieldByName(opposite);
    if (negated != nullptr) return FieldPlace{nullptr, negated, true};
  }
  for (const FieldDescriptor* outer : fields_of(message)) {
    if (is_message(*outer) && !outer->is_repeated() &&
        outer->message_type() == control.containing_type()) {
      return FieldPlace{outer, &control};
    }
  }
  return std::nullopt;
}

std::optional<double> value_of(const Message& message, const FieldDescriptor& control) {
  const auto place = place_of(*message.GetDescriptor(), control);
  if (!place) return std::nullopt;
  const Message* holder = &message;
  if (place->outer != nullptr) holder = &message.GetReflection()->GetMessage(message, place->outer);
  if (place->field->has_presence() && !holder->GetReflection()->HasField(*holder, place->field)) {
    return std::nullopt;
  }
  const double value = number_in(*holder, *place->field);
  return place->negated ? 1.0 - value : value;
}

void put_value(Message& message, const FieldDescriptor& control, double value) {
  const auto place = place_of(*message.GetDescriptor(), control);
  if (!place) return;
  Message* holder = &message;
  if (place->outer != nullptr) {
    holder = message.GetReflection()->MutableMessage(&message, place->outer);
  }
  put_number(*holder, *place->field, place->negated ? 1.0 - value : value);
}

std::string value_text(const FieldDescriptor& control, double value) {
  switch (control.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return value != 0.0 ? "on" : "off";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* const named = control.enum_type()->FindValueByNumber(static_cast<int>(value));
      return named != nullptr ? named->name() : fmt::format("{}", value);
    }
    default:
      return fmt::format("{}", value);
  }
}

bool is_allowed(const FieldDescriptor& control, double value) {
  if (control.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return value == 0.0 || value == 1.0;
  if (control.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    return value >= 0.0 && value < 1e6 && value == static_cast<int>(value) &&
           control.enum_type()->FindValueByNumber(static_cast<int>(value)) != nullptr;
  }
  const config::FieldRule& rule = rule_of(control);
  if (rule.one_of_size() > 0) {
    return std::find(rule.one_of().begin(), rule.one_of().end(), value) != rule.one_of().end();
  }
  return value == value && (!rule.has_min() || value >= rule.min()) &&
         (!rule.has_max() || value <= rule.max());
}

}  // namespace skerry::wire
