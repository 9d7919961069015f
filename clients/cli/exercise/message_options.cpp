#include "clients/cli/exercise/message_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

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

std::optional<double> finite_number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

void add_message_options(CLI::App& command, wire::Message& message, std::string_view left_out) {
  static const CLI::Validator number(
      [](const std::string& text) {
        return finite_number(text) ? std::string()
                                   : fmt::format("'{}' is not a number", printable(text));
      },
      "", "finite");
  for (const FieldDescriptor* field : wire::fields_of(*message.GetDescriptor())) {
    if (field->is_repeated() || field->name() == left_out ||
        field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
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
      option->check(number);
    }
  }
}

void add_waypoint_option(CLI::App& command, std::vector<std::string>& texts) {
  std::string names;
  for (const FieldDescriptor* field : wire::fields_of(*wire::Waypoint::descriptor())) {
    if (!field->has_presence()) continue;  // latitude and longitude
    names += fmt::format("{}{}", names.empty() ? "" : ", ", distinct_name(*field));
  }
  command.add_option(
      "--waypoint", texts,
      "LATITUDE,LONGITUDE[,NAME=VALUE...] of her route, as often as wanted; names: " + names);
}

std::optional<std::string> read_waypoint(const std::string& text, wire::Waypoint& waypoint) {
  const auto wrong = [&](const std::string& part) {
    return fmt::format(
        "--waypoint {}: '{}' is wrong; expected LATITUDE,LONGITUDE[,NAME=VALUE...] as "
        "in 60.1,5.2,speed=10",
        printable(text, 60), printable(part, 40));
  };
  int placed = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, comma - at);
    at = comma + 1;
    const std::size_t equals = part.find('=');
    const auto value = finite_number(part.substr(equals == std::string::npos ? 0 : equals + 1));
    if (!value) return wrong(part);
    if (equals == std::string::npos) {
      if (placed == 2) return wrong(part);
      if (placed++ == 0) {
        waypoint.set_lat(*value);
      } else {
        waypoint.set_lon(*value);
      }
      continue;
    }
    const FieldDescriptor* named = nullptr;
    for (const FieldDescriptor* field : wire::fields_of(*wire::Waypoint::descriptor())) {
      if (field->has_presence() && distinct_name(*field) == part.substr(0, equals)) named = field;
    }
    if (named == nullptr || placed < 2) return wrong(part);
    wire::put_value(waypoint, *named, *value);
  }
  if (placed != 2) return wrong(text);
  return std::nullopt;
}

}  // namespace skerry::client
