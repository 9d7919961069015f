#include "clients/cli/message_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "clients/cli/field_words.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using wire::FieldDescriptor;

bool is_text(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_STRING;
}

// Its help, or its name where it has none.
std::string said_of(const FieldDescriptor& field) {
  std::string help = help_of(field);
  if (wire::control_of(field).help().empty()) {
    std::string name = wire::spoken_name(field);
    if (!name.empty())
      name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    help = name + help;
  }
  return help;
}

bool is_whole(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32;
}

// What is wrong with the text of a number, if anything is.
std::string fault_of(const FieldDescriptor& field, const std::string& text) {
  const auto value = finite_number(text);
  if (!value) return fmt::format("'{}' is not a number", printable(text, 40));
  constexpr double kMost = 4294967295.0;
  if (is_whole(field) && (*value < 0.0 || *value > kMost || *value != std::floor(*value))) {
    return fmt::format("'{}' is not a whole number from 0 on", printable(text, 40));
  }
  return {};
}

}  // namespace

std::optional<double> finite_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

void add_message_options(CLI::App& command, wire::Message& message,
                         std::initializer_list<std::string_view> left_out) {
  for (const FieldDescriptor* field : wire::fields_of(*message.GetDescriptor())) {
    if (field->is_repeated() || field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ||
        std::find(left_out.begin(), left_out.end(), field->name()) != left_out.end()) {
      continue;
    }
    const std::vector<std::string> words = words_of(*field);
    CLI::Option* const option =
        command
            .add_option_function<std::string>(
                "--" + distinct_name(*field),
                [&message, field](const std::string& text) {
                  if (is_text(*field)) {
                    message.GetReflection()->SetString(&message, field, text);
                  } else {
                    wire::put_value(message, *field, number_of(*field, text));
                  }
                },
                said_of(*field))
            ->type_name(words.empty() && !is_text(*field) ? "FLOAT" : "TEXT");
    if (!words.empty()) {
      option->check(CLI::IsMember(words));
    } else if (!is_text(*field)) {
      option->check(CLI::Validator(
          [field](const std::string& text) { return fault_of(*field, text); }, "", "number"));
    }
  }
}

}  // namespace skerry::client
