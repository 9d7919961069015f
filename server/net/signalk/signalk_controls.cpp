#include "server/net/signalk/signalk_controls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "protocol/quantity/angle.hpp"
#include "protocol/signalk/radar_message.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using signalk::ControlChange;
using signalk::ControlState;
using wire::Set;
using wire::Settings;

constexpr double kRadianPerSecond = std::numbers::pi / 30.0;  // of one rpm

// A number that both sides have in the same units, and its automatic if there is one.
struct Knob {
  std::string_view key, field;  // ours: as Settings.locked has it
  double (Settings::*get)() const;
  void (Set::*put)(double);
  std::string_view auto_field = {};
  bool (Settings::*get_auto)() const = nullptr;
  void (Set::*put_auto)(bool) = nullptr;
};
constexpr Knob kKnobs[] = {
    {"gain", "gain", &Settings::gain, &Set::set_gain, "gain_auto", &Settings::gain_auto,
     &Set::set_gain_auto},
    {"sea", "sea", &Settings::sea, &Set::set_sea, "sea_auto", &Settings::sea_auto,
     &Set::set_sea_auto},
    {"rain", "rain", &Settings::rain, &Set::set_rain},
    {"targetExpansion", "echo_stretch", &Settings::echo_stretch, &Set::set_echo_stretch},
    {"targetBoost", "target_boost", &Settings::target_boost, &Set::set_target_boost},
    {"targetSeparation", "target_separation", &Settings::target_separation,
     &Set::set_target_separation},
    {"dopplerSpeedThreshold", "doppler_threshold_mps", &Settings::doppler_threshold_mps,
     &Set::set_doppler_threshold_mps},
    {"interferenceRejection", "interference_rejection", &Settings::interference_rejection,
     &Set::set_interference_rejection},
    {"sideLobeSuppression", "side_lobe_suppression", &Settings::side_lobe_suppression,
     &Set::set_side_lobe_suppression, "side_lobe_auto", &Settings::side_lobe_auto,
     &Set::set_side_lobe_auto},
    {"noiseRejection", "noise_rejection", &Settings::noise_rejection, &Set::set_noise_rejection},
    {"integration", "integration", &Settings::integration, &Set::set_integration},
    {"tune", "tune", &Settings::tune, &Set::set_tune, "tune_auto", &Settings::tune_auto,
     &Set::set_tune_auto},
    {"antennaHeight", "antenna_height_m", &Settings::antenna_height_m, &Set::set_antenna_height_m},
};

// What needs a word of its own.
struct Other {
  std::string_view key, field;
  double (*get)(const Settings&);
  void (*put)(double, Set&);
};
constexpr Other kOthers[] = {
    {"power", "transmit",
     [](const Settings& s) {
       return s.standby() ? signalk::kPowerStandby : signalk::kPowerTransmit;
     },
     [](double v, Set& set) { set.set_transmit(v == signalk::kPowerTransmit); }},
    {"range", "range_nm",
     [](const Settings& s) {
       return static_cast<double>(signalk::whole_metres(nautical_miles(s.range_nm())));
     },
     [](double v, Set& set) {
       for (const double nm : RangeScale::kNauticalMiles) {
         if (signalk::whole_metres(nautical_miles(nm)) == v) set.set_range_nm(nm);
       }
     }},
    {"mode", "mode", [](const Settings& s) { return static_cast<double>(s.mode()); },
     [](double v, Set& set) { set.set_mode(static_cast<wire::PictureMode>(v)); }},
    {"targetExpansionBearing", "stretch_bearing",
     [](const Settings& s) { return s.stretch_bearing() ? 1.0 : 0.0; },
     [](double v, Set& set) { set.set_stretch_bearing(v != 0.0); }},
    {"doppler", "doppler", [](const Settings& s) { return static_cast<double>(s.doppler()); },
     [](double v, Set& set) { set.set_doppler(static_cast<wire::DopplerMode>(v)); }},
    {"decimation", "decimation",
     [](const Settings& s) { return static_cast<double>(s.decimation()); },
     [](double v, Set& set) { set.set_decimation(static_cast<wire::Decimation>(v)); }},
    {"pulseWidth", "pulse", [](const Settings& s) { return static_cast<double>(s.pulse()); },
     [](double v, Set& set) { set.set_pulse(static_cast<wire::PulseChoice>(v)); }},
    {"rotationSpeed", "rotation_rpm",
     [](const Settings& s) { return s.rotation_rpm() * kRadianPerSecond; },
     [](double v, Set& set) {
       set.set_rotation_rpm(std::clamp(v / kRadianPerSecond, 10.0, 60.0));
     }},
    {"bearingAlignment", "bearing_alignment_deg",
     [](const Settings& s) { return s.bearing_alignment_deg() * kRadiansPerDegree; },
     [](double v, Set& set) {
       set.set_bearing_alignment_deg(std::clamp(v / kRadiansPerDegree, -180.0, 180.0));
     }},
};
constexpr std::string_view kSector = "noTransmitSector";

template <typename Table>
const auto* row_of(const Table& table, std::string_view key) {
  const auto found = std::find_if(std::begin(table), std::end(table),
                                  [key](const auto& row) { return row.key == key; });
  return found == std::end(table) ? nullptr : &*found;
}

bool is_locked(const Settings& settings, std::string_view field) {
  return !field.empty() && std::find(settings.locked().begin(), settings.locked().end(), field) !=
                               settings.locked().end();
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
    if (const Knob* knob = row_of(kKnobs, definition.key)) {
      ControlState state{.value = (settings.*knob->get)()};
      if (knob->get_auto != nullptr) state.automatic = (settings.*knob->get_auto)();
      state.locked = is_locked(settings, knob->field) || is_locked(settings, knob->auto_field);
      states.emplace_back(definition.key, state);
    } else if (const Other* other = row_of(kOthers, definition.key)) {
      states.emplace_back(
          definition.key,
          ControlState{.value = other->get(settings), .locked = is_locked(settings, other->field)});
    } else if (definition.kind == signalk::ControlKind::sector) {
      states.emplace_back(definition.key, sector_state(places.at(sector++),
                                                       is_locked(settings, "blanked_sectors")));
    }
  }
  return states;
}

Set set_of(const signalk::ControlDefinition& definition, const ControlChange& change,
           const Settings& settings, SectorPlaces& sectors) {
  Set set;
  if (const Knob* knob = row_of(kKnobs, definition.key)) {
    if (change.value) (set.*knob->put)(*change.value);
    if (knob->put_auto != nullptr) (set.*knob->put_auto)(change.automatic.value_or(false));
  } else if (const Other* other = row_of(kOthers, definition.key)) {
    if (change.value) other->put(*change.value, set);
  } else if (definition.kind == signalk::ControlKind::sector) {
    const auto place = static_cast<std::size_t>(definition.key[kSector.size()] - '1');
    *set.mutable_blanked_sectors() = sectors.change(place, change, settings.blanked_sectors());
  }
  return set;
}

}  // namespace skerry::server
