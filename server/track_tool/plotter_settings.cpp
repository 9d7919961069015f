#include "server/track_tool/plotter_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace skerry::server {
namespace {

using Rule = Plotter::Rule;

// clang-format off
constexpr std::array<PlotterSetting, 9> kSettings = {{
    {"beam", 0.1, 10.0, "deg", false,
     [](const Rule& rule) { return rule.plots.beam_deg; },
     [](Rule& rule, double value) { rule.plots.beam_deg = value; },
     "width of the beam, -3 dB, one way; if the recording tells it, that"},
    {"pulse", 0.0, 500.0, "m", false,
     [](const Rule& rule) { return rule.plots.pulse_m; },
     [](Rule& rule, double value) { rule.plots.pulse_m = value; },
     "length that the pulse adds behind an echo; 0: learnt from the echoes"},
    {"threshold", 0.0, 100.0, "steps", false,
     [](const Rule& rule) { return rule.plots.threshold.roughnesses; },
     [](Rule& rule, double value) { rule.plots.threshold.roughnesses = value; },
     "an echo is over its surroundings by so many mean steps from cell to cell"},
    {"least-step", 1.0, 255.0, "levels", true,
     [](const Rule& rule) { return static_cast<double>(rule.plots.threshold.least_step); },
     [](Rule& rule, double value) {
       rule.plots.threshold.least_step = static_cast<std::uint8_t>(value);
     },
     "and by no less than this"},
    {"least-cells", 1.0, 1000.0, "", true,
     [](const Rule& rule) { return static_cast<double>(rule.plots.least_cells); },
     [](Rule& rule, double value) { rule.plots.least_cells = static_cast<std::uint32_t>(value); },
     "cells of an echo; with fewer it is noise"},
    {"most-size", 10.0, 5000.0, "m", false,
     [](const Rule& rule) { return rule.plots.most_size_m; },
     [](Rule& rule, double value) { rule.plots.most_size_m = value; },
     "length and width of an echo; what is larger is land or rain"},
    {"most-tracks", 1.0, 1000.0, "", true,
     [](const Rule& rule) { return static_cast<double>(rule.tracks.most_tracks); },
     [](Rule& rule, double value) { rule.tracks.most_tracks = static_cast<std::uint32_t>(value); },
     "targets that are tracked at once"},
    {"acquire", 0.0, 2.0, "", true,
     [](const Rule& rule) { return static_cast<double>(rule.tracks.acquire); },
     [](Rule& rule, double value) { rule.tracks.acquire = static_cast<Tracker::Acquire>(value); },
     "what is tracked by itself: 0 nothing, 1 what moves, 2 also what stays, as ships at anchor"},
    {"least-speed", 0.0, 20.0, "kn", false,
     [](const Rule& rule) { return rule.tracks.least_speed_kn; },
     [](Rule& rule, double value) { rule.tracks.least_speed_kn = value; },
     "of what moves"},
}};
// clang-format on

// Written so that a NaN fails, which CLI::Range lets pass.
std::string refusal_of(const PlotterSetting& setting, double value) {
  if (!(value >= setting.least && value <= setting.most)) {
    return fmt::format("{} is not in {:g} to {:g}", value, setting.least, setting.most);
  }
  if (setting.whole && value != std::floor(value)) {
    return fmt::format("{} is no whole number", value);
  }
  return "";
}

}  // namespace

std::span<const PlotterSetting> plotter_settings() { return kSettings; }

void ChosenSettings::add_options(CLI::App& command) {
  values_.assign(kSettings.size(), std::nullopt);
  const Rule usual;
  for (std::size_t i = 0; i < kSettings.size(); ++i) {
    const PlotterSetting& setting = kSettings[i];
    const std::string name = fmt::format("--{}", setting.name);
    command
        .add_option_function<double>(
            name,
            [this, i, name](double value) {
              const std::string refusal = refusal_of(kSettings[i], value);
              if (!refusal.empty()) throw CLI::ValidationError(name, refusal);
              values_[i] = value;
            },
            fmt::format("{}; {:g} to {:g}{}{} ({:g})", setting.help, setting.least, setting.most,
                        setting.unit[0] == '\0' ? "" : " ", setting.unit, setting.get(usual)))
        ->type_name(setting.whole ? "INT" : "FLOAT")
        ->group("The plotter");
  }
}

Plotter::Rule ChosenSettings::rule() const {
  Rule rule;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (values_[i]) kSettings[i].set(rule, *values_[i]);
  }
  return rule;
}

bool ChosenSettings::has(std::string_view name) const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (kSettings[i].name == name) return values_[i].has_value();
  }
  return false;
}

}  // namespace skerry::server
