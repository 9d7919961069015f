#include "protocol/signalk/control_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::signalk {
namespace {

using Failed = Failure<std::string>;
using Number = Result<std::optional<double>, std::string>;
using Switch = Result<std::optional<bool>, std::string>;

// One unit of the definition.
struct Unit {
  std::string_view of, name;
  double factor;
};
constexpr Unit kUnits[] = {{"m", "km", 1000.0},
                           {"m", "nm", Length::kMetresPerNauticalMile},
                           {"m/s", "kn", kKnot},
                           {"rad", "deg", kRadiansPerDegree},
                           {"rad/s", "rpm", std::numbers::pi / 30.0}};

// A choice is meant that is off by at most so much of itself: 3 NM may come as 5556 or 5560 m.
constexpr double kChoiceTolerance = 0.01;

bool same_words(std::string_view a, std::string_view b) {
  const auto same = [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same);
}

std::string choices_text(const ControlDefinition& definition) {
  std::vector<std::string> texts;
  for (const ControlChoice& choice : definition.choices) {
    if (choice.settable) texts.push_back(fmt::format("{:g} ({})", choice.value, choice.label));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

Result<double, std::string> factor_of(const Json& body, const ControlDefinition& definition) {
  const Json* named = member(body, "units");
  if (named == nullptr || !named->is_string() || *named == definition.units) return 1.0;
  for (const Unit& unit : kUnits) {
    if (unit.of == definition.units && *named == std::string(unit.name)) return unit.factor;
  }
  return Failed{fmt::format("{}: no units of that name; they are {}", definition.key,
                            definition.units.empty() ? "none" : definition.units)};
}

Number nearest_choice(double wanted, const ControlDefinition& definition) {
  for (const ControlChoice& choice : definition.choices) {
    if (std::fabs(choice.value - wanted) <= kChoiceTolerance * std::fabs(choice.value) &&
        choice.settable) {
      return std::optional(choice.value);
    }
  }
  return Failed{fmt::format("{}: {:g} cannot be set; allowed: {}", definition.key, wanted,
                            choices_text(definition))};
}

Number number_of(const Json& value, double factor, const ControlDefinition& definition) {
  if (value.is_null()) return std::optional<double>();
  if (value.is_string()) {
    for (const ControlChoice& choice : definition.choices) {
      if (choice.settable && same_words(value.get_ref<const std::string&>(), choice.label)) {
        return std::optional(choice.value);
      }
    }
  }
  const auto number =
      value.is_boolean() ? std::optional(value.get<bool>() ? 1.0 : 0.0) : number_in(value);
  if (!number) return Failed{fmt::format("{}: the value is no number", definition.key)};
  const double wanted = *number * factor;
  if (!definition.choices.empty()) return nearest_choice(wanted, definition);
  const double slack = 1e-6 * (definition.max - definition.min);
  if (!(wanted >= definition.min - slack && wanted <= definition.max + slack)) {
    return Failed{fmt::format("{}: {:g} is out of range; allowed: {:g} to {:g}{}{}", definition.key,
                              wanted, definition.min, definition.max,
                              definition.units.empty() ? "" : " ", definition.units)};
  }
  return std::optional(std::clamp(wanted, definition.min, definition.max));
}

Switch switch_of(const Json& body, const char* name, const ControlDefinition& definition) {
  const Json* value = member(body, name);
  if (value == nullptr || value->is_null()) return std::optional<bool>();
  if (value->is_boolean()) return std::optional(value->get<bool>());
  return Failed{fmt::format("{}: \"{}\" is neither true nor false", definition.key, name)};
}

// {"auto": b}, or "mode": "auto" or "manual".  Displays send "auto": false with everything, so that
// is no fault of a control without automatic.
Switch automatic_of(const Json& body, const ControlDefinition& definition) {
  const auto named = switch_of(body, "auto", definition);
  if (!named) return Failed{named.error()};
  std::optional<bool> wanted = *named;
  if (const Json* mode = member(body, "mode"); mode != nullptr && !mode->is_null()) {
    const bool is_auto = *mode == "auto";
    if (!is_auto && *mode != "manual") {
      return Failed{fmt::format("{}: \"mode\" is neither \"auto\" nor \"manual\"", definition.key)};
    }
    if (wanted && *wanted != is_auto) {
      return Failed{fmt::format("{}: \"auto\" and \"mode\" say different things", definition.key)};
    }
    wanted = is_auto;
  }
  if (definition.has_auto) return wanted;
  if (wanted.value_or(false)) return Failed{fmt::format("{}: has no automatic", definition.key)};
  return std::optional<bool>();
}

}  // namespace

Json state_document(const ControlDefinition& definition, const ControlState& state) {
  Json document = Json::object();
  if (state.automatic) document["auto"] = *state.automatic;
  if (state.enabled) document["enabled"] = *state.enabled;
  if (definition.kind == ControlKind::text) {
    document["value"] = state.text;
  } else {
    document["value"] = number_document(state.value);
  }
  if (state.end) document["endValue"] = number_document(*state.end);
  if (state.locked) document["allowed"] = false;
  return document;
}

Result<ControlChange, std::string> read_change(const Json& body,
                                               const ControlDefinition& definition) {
  if (definition.read_only) {
    return Failed{fmt::format("{}: can be read but not be set", definition.key)};
  }
  const Json* value = body.is_object() ? member(body, "value") : &body;
  if (value != nullptr && value->is_object() && body.is_object()) {
    return value->contains("value") && (*value)["value"].is_object()
               ? Result<ControlChange, std::string>(
                     Failed{fmt::format("{}: a value within a value", definition.key)})
               : read_change(*value, definition);
  }
  const auto factor = factor_of(body, definition);
  if (!factor) return Failed{factor.error()};
  ControlChange change;
  if (value != nullptr) {
    const auto number = number_of(*value, *factor, definition);
    if (!number) return Failed{number.error()};
    change.value = *number;
  }
  const auto automatic = automatic_of(body, definition);
  if (!automatic) return Failed{automatic.error()};
  change.automatic = *automatic;
  if (definition.kind == ControlKind::sector) {
    const auto enabled = switch_of(body, "enabled", definition);
    if (!enabled) return Failed{enabled.error()};
    change.enabled = *enabled;
    if (const Json* end = member(body, "endValue")) {
      const auto number = number_of(*end, *factor, definition);
      if (!number) return Failed{number.error()};
      change.end = *number;
    }
  }
  if (!change.value && !change.automatic && !change.enabled && !change.end) {
    return Failed{fmt::format("{}: nothing to set; expected {{\"value\": ...}}{}", definition.key,
                              definition.has_auto ? " or {\"auto\": true or false}" : "")};
  }
  return change;
}

}  // namespace skerry::signalk
