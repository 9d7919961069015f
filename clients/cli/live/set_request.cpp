#include "clients/cli/live/set_request.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "clients/cli/field_words.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

using wire::FieldDescriptor;

void add_options(std::vector<SetOption>& to, const wire::Descriptor& message,
                 const char* group = nullptr) {
  for (const FieldDescriptor* field : wire::fields_of(message)) {
    const auto& control = wire::control_of(*field);
    if (control.help().empty() || field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const char* const scope = control.scope() == config::Control::RADAR ? kRadarGroup : kViewGroup;
    to.push_back({field, "--" + wire::option_name(*field), help_of(*field),
                  group != nullptr ? group : scope, words_of(*field)});
  }
}

std::vector<const FieldDescriptor*> artefacts() {
  return wire::fields_of(*wire::Artefacts::descriptor());
}

}  // namespace

std::vector<SetOption> set_options() {
  std::vector<SetOption> all;
  add_options(all, *wire::Set::descriptor(), kShipGroup);
  add_options(all, *wire::ConOrder::descriptor(), kConGroup);
  add_options(all, *wire::Controls::descriptor());
  add_options(all, *wire::WorldChange::descriptor(), kWorldGroup);
  return all;
}

void put_option(wire::Set& set, const SetOption& option, const std::string& text) {
  const wire::Descriptor* const type = option.field->containing_type();
  wire::Message* message = &set;
  if (type == wire::WorldChange::descriptor()) message = set.mutable_world();
  if (type == wire::ConOrder::descriptor()) message = set.mutable_con();
  wire::put_value(*message, *option.field, number_of(*option.field, text));
}

std::optional<std::string> add_blanked(const std::vector<std::string>& texts, wire::Set& set) {
  if (texts.empty()) return std::nullopt;
  set.mutable_blanked_sectors();
  if (texts == std::vector<std::string>{"none"}) return std::nullopt;
  for (const std::string& text : texts) {
    const std::size_t dash = text.find('-', 1);
    char* end_from = nullptr;
    char* end_to = nullptr;
    if (dash != std::string::npos) {
      auto& sector = *set.mutable_blanked_sectors()->add_sectors();
      sector.set_from_deg(std::strtod(text.c_str(), &end_from));
      sector.set_to_deg(std::strtod(text.c_str() + dash + 1, &end_to));
    }
    if (dash == std::string::npos || end_from != text.c_str() + dash || *end_to != '\0' ||
        dash + 1 == text.size()) {
      return fmt::format(
          "--blank: '{}' is no sector; expected FROM-TO in degrees from the bow, as "
          "350-10, or none",
          printable(text, 40));
    }
  }
  return std::nullopt;
}

std::vector<std::string> rain_kinds() {
  return words_of(*wire::RainChange::descriptor()->FindFieldByName("kind"));
}

std::optional<std::string> add_rain(const RainOptions& options, wire::WorldChange& change) {
  for (const std::uint32_t id : options.remove) change.add_remove_rain(id);
  if (options.remove_all) change.set_remove_all_rain(true);
  const bool described = options.radius_nm || options.rate_mm_h || options.drift_deg ||
                         options.drift_kn || !options.kind.empty();
  if (options.add.empty() && !options.change) {
    if (!described) return std::nullopt;
    return "which rain cell? Give --add-rain LATITUDE LONGITUDE or --change-rain NUMBER; skerry "
           "status shows the numbers";
  }
  if (options.change && *options.change == 0) return "--change-rain: rain cells count from 1";
  wire::RainChange& rain = *change.add_rain();
  rain.set_id(options.change.value_or(0));
  const std::vector<double>& place = options.add.empty() ? options.at : options.add;
  if (place.size() == 2) {
    rain.set_latitude_deg(place[0]);
    rain.set_longitude_deg(place[1]);
  }
  if (options.radius_nm) rain.set_radius_nm(*options.radius_nm);
  if (options.rate_mm_h) rain.set_rate_mm_h(*options.rate_mm_h);
  if (options.drift_deg) rain.set_drift_deg(*options.drift_deg);
  if (options.drift_kn) rain.set_drift_kn(*options.drift_kn);
  if (!options.kind.empty()) {
    const FieldDescriptor& kind = *wire::RainChange::descriptor()->FindFieldByName("kind");
    wire::put_value(rain, kind, number_of(kind, options.kind));
  }
  return std::nullopt;
}

std::optional<std::string> add_artefact(const std::string& text, wire::WorldChange& change) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string word = equals == std::string::npos ? "" : text.substr(equals + 1);
  for (const FieldDescriptor* artefact : artefacts()) {
    if (name != artefact->name()) continue;
    if (word != "on" && word != "off") {
      return fmt::format("--artefact {}: '{}' is neither on nor off", name, printable(word, 20));
    }
    wire::put_value(change, *artefact, word == "on" ? 1.0 : 0.0);
    return std::nullopt;
  }
  return fmt::format("--artefact: '{}' is none of {}", printable(name, 40), artefact_names());
}

std::string artefact_names() {
  std::string names;
  for (const FieldDescriptor* artefact : artefacts()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", artefact->name());
  }
  return names;
}

}  // namespace skerry::client
