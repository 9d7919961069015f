#include "clients/cli/field_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {

using wire::FieldDescriptor;

std::string help_of(const FieldDescriptor& field) {
  const auto& control = wire::control_of(field);
  const std::string allowed = wire::allowed_by(wire::rule_of(field));
  std::string help = control.help();
  if (!control.label().empty() && control.label() != help) {
    help = control.label() + (help.empty() ? "" : ": " + help);
  }
  if (!allowed.empty()) help += ", " + allowed;
  if (!control.note().empty()) help += "; " + control.note();
  return help;
}

std::vector<std::string> words_of(const FieldDescriptor& field) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return {"on", "off"};
  std::vector<std::string> words;
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    for (int i = 0; i < field.enum_type()->value_count(); ++i) {
      words.push_back(wire::word_of(*field.enum_type()->value(i)));
    }
  }
  return words;
}

std::string distinct_name(const FieldDescriptor& field) {
  std::string name = wire::option_name(field);
  for (const FieldDescriptor* other : wire::fields_of(*field.containing_type())) {
    if (other == &field || wire::option_name(*other) != name) continue;
    name = field.name();
    std::replace(name.begin(), name.end(), '_', '-');
    break;
  }
  return name;
}

double number_of(const FieldDescriptor& field, const std::string& text) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return text == "on" ? 1.0 : 0.0;
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    return wire::value_named(field, text)->number();
  }
  return std::strtod(text.c_str(), nullptr);
}

std::string text_of(const wire::Message& message, const FieldDescriptor& field) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    return printable(message.GetReflection()->GetString(message, &field));
  }
  const double value = wire::value_of(message, field).value_or(0.0);
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return value != 0.0 ? "on" : "off";
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    return wire::word_of(*field.enum_type(), static_cast<int>(value));
  }
  const std::string& unit = wire::rule_of(field).unit();
  return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit);
}

}  // namespace skerry::client
