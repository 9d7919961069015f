#include "protocol/signalk/control_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/signalk/radar_message.hpp"
#include "protocol/wire/controls.pb.h"

namespace skerry::signalk {
namespace {

using wire::FieldDescriptor;

struct SchemaUnit {
  std::string_view schema;  // as FieldRule.unit has it
  const char* units;        // as Signal K has it
  double per_unit;
};
constexpr SchemaUnit kSchemaUnits[] = {{"deg", "rad", kRadiansPerDegree},
                                       {"turns/min", "rad/s", kRadiansPerTurn / 60.0},
                                       {"NM", "m", nautical_miles(1.0).in_metres()},
                                       {"m", "m", 1.0},
                                       {"m/s", "m/s", 1.0}};

// A switch that is a state of the radar: what it can be in, and what it can be put into.
std::vector<ControlChoice> power_choices() {
  return {{kPowerOff, "Off", false},
          {kPowerStandby, "Standby", true},
          {kPowerTransmit, "Transmit", true},
          {3, "Preparing", false},
          {4, "Fault", false}};
}

std::vector<ControlChoice> choices_of(const FieldDescriptor& field) {
  std::vector<ControlChoice> choices;
  if (wire::control_of(field).signalk() == kPower) return power_choices();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return {{0.0, "Off"}, {1.0, "On"}};
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    for (int i = 0; i < field.enum_type()->value_count(); ++i) {
      const auto& value = *field.enum_type()->value(i);
      choices.push_back({static_cast<double>(value.number()), wire::label_of(value)});
    }
  }
  // Signal K has lengths that can be chosen in whole metres.
  for (const double value : wire::rule_of(field).one_of()) {
    choices.push_back({static_cast<double>(whole_metres(nautical_miles(value))),
                       fmt::format("{:g} {}", value, wire::rule_of(field).unit())});
  }
  return choices;
}

ControlDefinition definition_of(const FieldDescriptor& field) {
  const auto& control = wire::control_of(field);
  const auto& rule = wire::rule_of(field);
  const double step = control.has_step() ? control.step() : 1.0;
  ControlDefinition made{.key = control.signalk(),
                         .name = control.label(),
                         .description = control.help(),
                         .category = control.group(),
                         .min = rule.min(),
                         .max = rule.max(),
                         .step = step,
                         .choices = choices_of(field),
                         .field = &field,
                         .automatic = wire::automatic_of(field)};
  made.has_auto = made.automatic != nullptr;
  for (const SchemaUnit& unit : kSchemaUnits) {
    if (unit.schema != rule.unit()) continue;
    made.units = unit.units;
    made.per_unit = unit.per_unit;
  }
  if (made.choices.empty()) {
    made.min *= made.per_unit;
    made.max *= made.per_unit;
    made.step *= made.per_unit;
  } else {
    made.min = made.choices.front().value;
    made.max = made.choices.back().value;
    if (made.units.empty()) made.kind = ControlKind::choice;
  }
  return made;
}

// A place of each for what the server has a list of.
void add_sectors(std::vector<ControlDefinition>& to, const FieldDescriptor& field) {
  for (int i = 1; i <= kNoTransmitSectors; ++i) {
    ControlDefinition sector = definition_of(field);
    sector.key += std::to_string(i);
    sector.name += fmt::format(" {}", i);
    sector.kind = ControlKind::sector;
    sector.units = "rad";
    sector.min = -std::numbers::pi;
    sector.max = std::numbers::pi;
    sector.step = 0.1 * kRadiansPerDegree;
    to.push_back(std::move(sector));
  }
}

const char* type_of(ControlKind kind) {
  switch (kind) {
    case ControlKind::choice:
      return "enum";
    case ControlKind::text:
      return "string";
    case ControlKind::sector:
      return "sector";
    case ControlKind::number:
      break;
  }
  return "number";
}

}  // namespace

std::vector<ControlDefinition> definitions_of(const wire::Descriptor& schema) {
  std::vector<ControlDefinition> all;
  for (const FieldDescriptor* field : wire::fields_of(schema)) {
    if (wire::control_of(*field).signalk().empty()) continue;
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      add_sectors(all, *field);
    } else {
      all.push_back(definition_of(*field));
    }
  }
  for (const auto& [key, name] : {std::pair{"modelName", "Model"}, {"firmwareVersion", "Server"}}) {
    all.push_back({.key = key,
                   .name = name,
                   .description = name,
                   .category = "info",
                   .kind = ControlKind::text,
                   .read_only = true});
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i].id = static_cast<int>(i);
  return all;
}

const std::vector<ControlDefinition>& control_definitions() {
  static const std::vector<ControlDefinition> definitions =
      definitions_of(*wire::Controls::descriptor());
  return definitions;
}

const ControlDefinition* find_control(std::string_view key) {
  const auto& all = control_definitions();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [key](const ControlDefinition& each) { return each.key == key; });
  return found == all.end() ? nullptr : &*found;
}

Json definition_document(const ControlDefinition& definition) {
  Json document{{"id", definition.id},
                {"name", definition.name},
                {"description", definition.description},
                {"category", definition.category},
                {"dataType", type_of(definition.kind)}};
  if (definition.kind != ControlKind::text) {
    document["minValue"] = number_document(definition.min);
    document["maxValue"] = number_document(definition.max);
    document["stepValue"] = number_document(definition.step);
  }
  if (!definition.units.empty()) document["units"] = definition.units;
  if (!definition.choices.empty()) {
    Json valid = Json::array(), labels = Json::object();
    for (const ControlChoice& choice : definition.choices) {
      if (choice.settable) valid.push_back(number_document(choice.value));
      labels[fmt::format("{:g}", choice.value)] = choice.label;
    }
    document["validValues"] = std::move(valid);
    document["descriptions"] = std::move(labels);
  }
  document["hasAuto"] = definition.has_auto;
  document["hasAutoAdjustable"] = false;
  if (definition.kind == ControlKind::sector) document["hasEnabled"] = true;
  document["isReadOnly"] = definition.read_only;
  return document;
}

}  // namespace skerry::signalk
