#include "server/net/http/controls_page.hpp"

#include "protocol/signalk/json.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {
namespace {

using signalk::Json;
using wire::Descriptor;
using wire::FieldDescriptor;

const char* type_of(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return "switch";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "choice";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "message";
    default:
      return "number";
  }
}

void add_place(Json& to, const char* member, const Descriptor& message,
               const FieldDescriptor& control) {
  const auto place = wire::place_of(message, control);
  if (place && place->outer == nullptr) to[member] = place->field->number();
}

void add_text(Json& to, const char* member, const std::string& text) {
  if (!text.empty()) to[member] = text;
}

void add_range(Json& to, const config::FieldRule& rule) {
  if (rule.has_min()) to["min"] = rule.min();
  if (rule.has_max()) to["max"] = rule.max();
  for (const double value : rule.one_of()) to["oneOf"].push_back(value);
  if (rule.has_default_()) to["default"] = rule.default_();
  add_text(to, "unit", rule.unit());
}

Json described(const FieldDescriptor& field, const Descriptor& set, const Descriptor& settings) {
  const config::Control& control = wire::control_of(field);
  Json made{{"name", field.json_name()},
            {"field", field.name()},
            {"number", field.number()},
            {"type", type_of(field)}};
  add_place(made, "set", set, field);
  add_place(made, "settings", settings, field);
  add_range(made, wire::rule_of(field));
  if (control.has_step()) made["step"] = control.step();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    for (int i = 0; i < field.enum_type()->value_count(); ++i) {
      const auto& value = *field.enum_type()->value(i);
      made["choices"].push_back(
          {{"value", value.number()}, {"label", wire::short_label_of(value)}});
    }
  }
  add_text(made, "label", control.short_label().empty() ? control.label() : control.short_label());
  add_text(made, "title",
           control.note().empty() ? control.help() : control.help() + "; " + control.note());
  add_text(made, "panel", control.panel());
  if (control.row() != 0) made["row"] = control.row();
  add_text(made, "lock", control.lock());
  if (!control.automatic_of().empty()) {
    made["automaticOf"] =
        field.containing_type()->FindFieldByName(control.automatic_of())->json_name();
  }
  return made;
}

}  // namespace

std::string controls_page(const Descriptor& controls, const Descriptor& artefacts,
                          const Descriptor& faults) {
  Json page{{"controls", Json::array()}, {"artefacts", Json::array()}, {"faults", Json::array()}};
  for (const FieldDescriptor* field : wire::fields_of(controls)) {
    page["controls"].push_back(
        described(*field, *wire::Set::descriptor(), *wire::Settings::descriptor()));
  }
  for (const FieldDescriptor* field : wire::fields_of(artefacts)) {
    page["artefacts"].push_back(
        described(*field, *wire::WorldChange::descriptor(), *wire::World::descriptor()));
  }
  // Neither Set nor Settings has fields of theirs.
  for (const FieldDescriptor* field : wire::fields_of(faults)) {
    page["faults"].push_back(
        described(*field, *wire::Set::descriptor(), *wire::Settings::descriptor()));
    add_text(page["faults"].back(), "group", wire::control_of(*field).group());
  }
  return page.dump();
}

const std::string& controls_page() {
  static const std::string page = controls_page(
      *wire::Controls::descriptor(), *wire::Artefacts::descriptor(), *wire::Faults::descriptor());
  return page;
}

}  // namespace skerry::server
