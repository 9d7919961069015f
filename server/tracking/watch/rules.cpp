#include "server/tracking/watch/rules.hpp"

#include <fmt/format.h>

#include <vector>

#include "protocol/wire/schema.hpp"

namespace skerry::server {
namespace {

// "out of range; allowed: 0 to 10 NM", "none of these: moving, all".
std::string what_is_allowed(const wire::FieldDescriptor& field) {
  if (field.enum_type() == nullptr) {
    return "out of range; allowed: " + wire::allowed_by(wire::rule_of(field));
  }
  std::vector<std::string> words;
  for (int k = 0; k < field.enum_type()->value_count(); ++k) {
    words.push_back(wire::word_of(*field.enum_type()->value(k)));
  }
  return fmt::format("none of these: {}", fmt::join(words, ", "));
}

}  // namespace

wire::TargetRules default_target_rules() {
  wire::TargetRules rules;
  for (const wire::FieldDescriptor* field : wire::fields_of(*wire::TargetRules::descriptor())) {
    wire::put_value(rules, *field, wire::rule_of(*field).default_());
  }
  return rules;
}

Tracker::Rule tracker_rule(const wire::TargetRules& rules) {
  Tracker::Rule rule;
  rule.most_tracks = rules.capacity();
  switch (rules.acquire()) {
    case wire::AUTO_ACQUIRE_NONE:
      rule.acquire = Tracker::Acquire::none;
      break;
    case wire::AUTO_ACQUIRE_ALL:
      rule.acquire = Tracker::Acquire::all;
      break;
    default:
      rule.acquire = Tracker::Acquire::moving;
  }
  rule.least_speed_kn = rules.least_speed_kn();
  rule.furthest_nm = rules.furthest_nm();
  return rule;
}

std::optional<std::string> value_not_allowed(const google::protobuf::Message& message) {
  for (const wire::FieldDescriptor* field : wire::fields_of(*message.GetDescriptor())) {
    const auto value = wire::value_of(message, *field);
    if (!value || wire::is_allowed(*field, *value)) continue;
    return fmt::format("{} {} is {}", wire::spoken_name(*field), *value, what_is_allowed(*field));
  }
  return std::nullopt;
}

}  // namespace skerry::server
