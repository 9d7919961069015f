#include "protocol/signalk/control_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "protocol/signalk/radar_message.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::signalk {
namespace {

using Choices = std::vector<ControlChoice>;
constexpr double kPi = std::numbers::pi;

Choices range_choices() {
  Choices choices;
  for (const double nm : RangeScale::kNauticalMiles) {
    choices.push_back({.value = static_cast<double>(whole_metres(nautical_miles(nm))),
                       .label = fmt::format("{:g} NM", nm)});
  }
  return choices;
}

Choices numbered(std::initializer_list<const char*> labels) {
  Choices choices;
  for (const char* label : labels) {
    choices.push_back({.value = static_cast<double>(choices.size()), .label = label});
  }
  return choices;
}

class Table {
 public:
  // A knob from 0 to 100.
  void knob(const char* category, const char* key, const char* name, const char* description,
            bool has_auto = false) {
    ControlDefinition& control = add(category, key, name, description);
    control.max = 100.0;
    control.has_auto = has_auto;
  }
  void choice(const char* category, const char* key, const char* name, const char* description,
              Choices choices) {
    ControlDefinition& control = add(category, key, name, description);
    control.kind = ControlKind::choice;
    control.min = choices.front().value;
    control.max = choices.back().value;
    control.choices = std::move(choices);
  }
  void measure(const char* category, const char* key, const char* name, const char* description,
               const char* units, double min, double max, double step) {
    ControlDefinition& control = add(category, key, name, description);
    control.units = units;
    control.min = min;
    control.max = max;
    control.step = step;
  }
  ControlDefinition& add(const char* category, std::string key, std::string name,
                         const char* description) {
    controls.push_back({.key = std::move(key),
                        .id = static_cast<int>(controls.size()),
                        .name = std::move(name),
                        .description = description,
                        .category = category});
    return controls.back();
  }

  std::vector<ControlDefinition> controls;
};

void add_base(Table& table) {
  table.choice("base", "power", "Power", "What the radar does",
               {{kPowerOff, "Off", false},
                {kPowerStandby, "Standby", true},
                {kPowerTransmit, "Transmit", true},
                {3, "Preparing", false},
                {4, "Fault", false}});
  const Choices ranges = range_choices();
  table.measure("base", "range", "Range", "How far the picture reaches", "m", ranges.front().value,
                ranges.back().value, 1.0);
  table.controls.back().choices = ranges;
  table.choice("base", "mode", "Mode", "What the picture is set for",
               numbered({"Custom", "Harbour", "Offshore", "Buoy", "Weather", "Bird"}));
  table.knob("base", "gain", "Gain", "How weak an echo is still shown", true);
  table.knob("base", "sea", "Sea clutter", "How much of the echo of waves is taken away", true);
  table.knob("base", "rain", "Rain clutter", "How much of the echo of rain is taken away");
}

void add_picture(Table& table) {
  table.knob("targets", "targetExpansion", "Target expansion", "Draws echoes longer");
  table.choice("targets", "targetExpansionBearing", "Expansion in bearing",
               "Whether echoes grow across spokes, too", numbered({"Off", "On"}));
  table.knob("targets", "targetBoost", "Target boost", "Makes small echoes stronger");
  table.knob("targets", "targetSeparation", "Target separation", "Sharpens the beam");
  table.choice("targets", "doppler", "Doppler", "Which moving echoes are coloured",
               numbered({"Off", "Both", "Approaching"}));
  table.measure("targets", "dopplerSpeedThreshold", "Doppler threshold",
                "Slower echoes are not coloured", "m/s", 0.1, 20.0, 0.1);
  table.knob("advanced", "interferenceRejection", "Interference rejection",
             "Takes away the pulses of other radars");
  table.knob("advanced", "sideLobeSuppression", "Side lobe suppression",
             "Takes away echoes seen by the antenna's side lobes", true);
  table.knob("advanced", "noiseRejection", "Noise rejection", "Takes away receiver noise");
  table.knob("advanced", "integration", "Integration", "Averages the spokes of a beam");
  table.choice("advanced", "decimation", "Decimation", "What becomes of samples that share a cell",
               numbered({"Peak", "Mean"}));
  table.choice("advanced", "pulseWidth", "Pulse width", "Length of the transmitted pulse",
               numbered({"By range", "Short", "Medium", "Long"}));
  table.knob("advanced", "tune", "Tune", "Receiver frequency; 50 is right", true);
  table.measure("advanced", "rotationSpeed", "Rotation speed", "How fast the antenna turns",
                "rad/s", 10 * kPi / 30, 60 * kPi / 30, kPi / 30);
}

void add_installation(Table& table) {
  table.measure("installation", "bearingAlignment", "Bearing alignment",
                "Turns the whole picture clockwise", "rad", -kPi, kPi, kPi / 1800);
  table.measure("installation", "antennaHeight", "Antenna height", "Above the water", "m", 1.0,
                100.0, 0.1);
  for (int i = 1; i <= kNoTransmitSectors; ++i) {
    ControlDefinition& sector =
        table.add("installation", fmt::format("noTransmitSector{}", i),
                  fmt::format("No transmit sector {}", i), "Where the transmitter is off");
    sector.kind = ControlKind::sector;
    sector.units = "rad";
    sector.min = -kPi;
    sector.max = kPi;
    sector.step = kPi / 1800;
  }
  for (const auto& [key, name] : {std::pair{"modelName", "Model"}, {"firmwareVersion", "Server"}}) {
    ControlDefinition& info = table.add("info", key, name, name);
    info.kind = ControlKind::text;
    info.read_only = true;
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

const std::vector<ControlDefinition>& control_definitions() {
  static const std::vector<ControlDefinition> definitions = [] {
    Table table;
    add_base(table);
    add_picture(table);
    add_installation(table);
    return std::move(table.controls);
  }();
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
