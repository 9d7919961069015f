#include "clients/cli/exercise/waypoint_option.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/cli/field_words.hpp"
#include "clients/cli/message_options.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {

using wire::FieldDescriptor;

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
