#include "server/net/signalk/signalk_controls.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "protocol/quantity/angle.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::server {
namespace {

using signalk::ControlChange;
using signalk::ControlDefinition;
using signalk::ControlState;
using wire::Set;
using wire::Settings;

constexpr std::string_view kSector = "noTransmitSector";

bool is_locked(const Settings& settings, const wire::FieldDescriptor* field) {
  return field != nullptr && std::find(settings.locked().begin(), settings.locked().end(),
                                       field->name()) != settings.locked().end();
}

// Between the values of the schema and those of Signal K; a choice of a length is in whole metres
// there.
double display_value(const ControlDefinition& definition, double value) {
  if (definition.key == signalk::kPower) {
    return value == 0.0 ? signalk::kPowerStandby : signalk::kPowerTransmit;
  }
  const double scaled = value * definition.per_unit;
  return definition.choices.empty() ? scaled : std::round(scaled);
}

// Nothing if it stands for no value of the schema.
std::optional<double> schema_value(const ControlDefinition& definition, double value) {
  if (definition.key == signalk::kPower) return value == signalk::kPowerTransmit ? 1.0 : 0.0;
  const auto& rule = wire::rule_of(*definition.field);
  for (const double choice : rule.one_of()) {
    if (display_value(definition, choice) == value) return choice;
  }
  if (rule.one_of_size() > 0) return std::nullopt;
  const double unscaled = value / definition.per_unit;
  // A limit may have been rounded on its way to radians and back.
  return rule.has_min() && rule.has_max() ? std::clamp(unscaled, rule.min(), rule.max()) : unscaled;
}

double half_turn_radians(double deg) { return std::remainder(deg, 360.0) * kRadiansPerDegree; }
double turn_degrees(double radians) {
  const double deg = std::fmod(radians / kRadiansPerDegree, 360.0);
  return deg < 0.0 ? deg + 360.0 : deg;
}

ControlState sector_state(const SectorPlaces::Place& place, bool locked) {
  return {.value = half_turn_radians(place.from_deg),
          .enabled = place.enabled,
          .end = half_turn_radians(place.to_deg),
          .locked = locked};
}

}  // namespace

wire::BlankedSectors SectorPlaces::list_of(const Places& places) {
  wire::BlankedSectors list;
  for (const Place& place : places) {
    if (!place.enabled) continue;
    list.add_sectors()->set_from_deg(place.from_deg);
    list.mutable_sectors(list.sectors_size() - 1)->set_to_deg(place.to_deg);
  }
  return list;
}

const SectorPlaces::Places& SectorPlaces::places(const wire::BlankedSectors& sectors) {
  if (list_of(places_).SerializeAsString() == sectors.SerializeAsString()) return places_;
  places_ = {};
  const int count = std::min<int>(sectors.sectors_size(), static_cast<int>(places_.size()));
  for (int i = 0; i < count; ++i) {
    places_[static_cast<std::size_t>(i)] = {sectors.sectors(i).from_deg(),
                                            sectors.sectors(i).to_deg(), true};
  }
  return places_;
}

wire::BlankedSectors SectorPlaces::change(std::size_t place, const ControlChange& change,
                                          const wire::BlankedSectors& sectors) {
  Places wanted = places(sectors);
  Place& mine = wanted.at(place);
  if (change.value) mine.from_deg = turn_degrees(*change.value);
  if (change.end) mine.to_deg = turn_degrees(*change.end);
  mine.enabled = change.enabled.value_or(mine.enabled);
  places_ = wanted;
  return list_of(wanted);
}

signalk::ControlStates control_states(const Settings& settings, SectorPlaces& sectors) {
  signalk::ControlStates states;
  const SectorPlaces::Places& places = sectors.places(settings.blanked_sectors());
  std::size_t sector = 0;
  for (const signalk::ControlDefinition& definition : signalk::control_definitions()) {
    if (definition.kind == signalk::ControlKind::sector) {
      states.emplace_back(definition.key,
                          sector_state(places.at(sector++), is_locked(settings, definition.field)));
      continue;
    }
    if (definition.field == nullptr) continue;
    ControlState state{
        .value = display_value(definition, value_of(settings, *definition.field).value_or(0.0))};
    if (definition.automatic != nullptr) {
      state.automatic = wire::value_of(settings, *definition.automatic).value_or(0.0) != 0.0;
    }
    state.locked =
        is_locked(settings, definition.field) || is_locked(settings, definition.automatic);
    states.emplace_back(definition.key, state);
  }
  return states;
}

Set set_of(const signalk::ControlDefinition& definition, const ControlChange& change,
           const Settings& settings, SectorPlaces& sectors) {
  Set set;
  if (definition.kind == signalk::ControlKind::sector) {
    const auto place = static_cast<std::size_t>(definition.key[kSector.size()] - '1');
    *set.mutable_blanked_sectors() = sectors.change(place, change, settings.blanked_sectors());
  } else if (definition.field != nullptr) {
    const auto value = change.value ? schema_value(definition, *change.value) : std::nullopt;
    if (value) wire::put_value(set, *definition.field, *value);
    if (definition.automatic != nullptr) {
      wire::put_value(set, *definition.automatic, change.automatic.value_or(false) ? 1.0 : 0.0);
    }
  }
  return set;
}

}  // namespace skerry::server
