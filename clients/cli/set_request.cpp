#include "clients/cli/set_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr const char* kShipGroup = "Own ship";
constexpr const char* kViewGroup = "View";
constexpr const char* kRadarGroup = "Radar (for all its views)";

constexpr std::array kNumbers = {
    NumberControl{"--course", "Ordered course, degrees true, 0 to 360", kShipGroup,
                  [](wire::Set& s, double v) { s.set_course_deg(v); }},
    NumberControl{"--speed", "Ordered speed, knots, -10 to 60", kShipGroup,
                  [](wire::Set& s, double v) { s.set_speed_kn(v); }},
    NumberControl{"--range",
                  "Range scale, NM: 0.125 0.25 0.5 0.75 1.5 3 6 12 24 48 72 96; of view 0 it is "
                  "the radar's, of others at most that",
                  kViewGroup, [](wire::Set& s, double v) { s.set_range_nm(v); }},
    NumberControl{"--gain", "Gain, 0 to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_gain(v); }},
    NumberControl{"--sea", "Sea clutter control (STC), 0 to 100; trims --sea-auto about 50",
                  kViewGroup, [](wire::Set& s, double v) { s.set_sea(v); }},
    NumberControl{"--rain", "Rain clutter control (FTC), 0 to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_rain(v); }},
    NumberControl{"--interference-rejection", "0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_interference_rejection(v); }},
    NumberControl{"--stretch", "Echo stretch, 0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_echo_stretch(v); }},
    NumberControl{"--integration", "Integration of the spokes of a beam, 0 (off) to 100",
                  kViewGroup, [](wire::Set& s, double v) { s.set_integration(v); }},
    NumberControl{"--side-lobe-suppression", "0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_side_lobe_suppression(v); }},
    NumberControl{"--noise-rejection", "0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_noise_rejection(v); }},
    NumberControl{"--target-separation", "Sharpens the beam, 0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_target_separation(v); }},
    NumberControl{"--target-boost", "Makes small echoes stronger, 0 (off) to 100", kViewGroup,
                  [](wire::Set& s, double v) { s.set_target_boost(v); }},
    NumberControl{"--doppler-threshold", "What is slower is not coloured, m/s, 0.1 to 20",
                  kViewGroup, [](wire::Set& s, double v) { s.set_doppler_threshold_mps(v); }},
    NumberControl{
        "--instrumented-range",
        "Where the last cell ends, m: a sixteenth of the range scale to twice that; 0: at "
        "the range scale",
        kViewGroup, [](wire::Set& s, double v) { s.set_instrumented_range_m(v); }},
    NumberControl{"--rotation", "Turns of the antenna a minute, 10 to 60", kRadarGroup,
                  [](wire::Set& s, double v) { s.set_rotation_rpm(v); }},
    NumberControl{"--bearing-alignment", "Added to every azimuth, degrees, -180 to 180",
                  kRadarGroup, [](wire::Set& s, double v) { s.set_bearing_alignment_deg(v); }},
    NumberControl{"--antenna-height", "Over the water, m, 1 to 100", kRadarGroup,
                  [](wire::Set& s, double v) { s.set_antenna_height_m(v); }},
    NumberControl{"--tune", "Tuning by hand, 0 to 100; 50 is right", kRadarGroup,
                  [](wire::Set& s, double v) { s.set_tune(v); }},
    NumberControl{"--sea-state", "Douglas sea state, 0 (no clutter) to 6, need not be whole",
                  kWorldGroup, [](wire::Set& s, double v) { s.mutable_world()->set_sea_state(v); }},
    NumberControl{"--wind-from", "Degrees true, 0 to 360", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_wind_from_deg(v); }},
    NumberControl{"--swell-height", "Crest to trough, m, 0 to 15", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_swell_height_m(v); }},
    NumberControl{"--swell-period", "s, 4 to 25", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_swell_period_s(v); }},
    NumberControl{"--swell-from", "Degrees true, 0 to 360", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_swell_from_deg(v); }},
    NumberControl{"--wave-height", "On the beaches, m, 0 to 15", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_wave_height_m(v); }},
    NumberControl{"--k-factor", "Effective Earth radius over the true one, 0.8 to 4", kWorldGroup,
                  [](wire::Set& s, double v) { s.mutable_world()->set_k_factor(v); }},
    NumberControl{"--ducting", "Share of the loss beyond the horizon taken away, 0 to 1",
                  kWorldGroup, [](wire::Set& s, double v) { s.mutable_world()->set_ducting(v); }},
};

bool is_on(const std::string& word) { return word == "on"; }

wire::PulseChoice pulse_named(const std::string& word) {
  if (word == "short") return wire::PULSE_SHORT;
  if (word == "medium") return wire::PULSE_MEDIUM;
  return word == "long" ? wire::PULSE_LONG : wire::PULSE_AUTO;
}

wire::DopplerMode doppler_named(const std::string& word) {
  if (word == "both") return wire::DOPPLER_BOTH;
  return word == "approaching" ? wire::DOPPLER_APPROACHING : wire::DOPPLER_OFF;
}

constexpr std::array kModes = {"custom", "harbour", "offshore", "buoy", "weather", "bird"};

wire::PictureMode mode_named(const std::string& word) {
  const auto found = std::find(kModes.begin(), kModes.end(), word);
  return static_cast<wire::PictureMode>(found - kModes.begin());
}

struct Artefact {
  const char* name;
  void (*set)(wire::WorldChange&, bool);
};
constexpr std::array kArtefacts = {
    Artefact{"side_lobes", [](wire::WorldChange& w, bool on) { w.set_side_lobes(on); }},
    Artefact{"multiple_echoes", [](wire::WorldChange& w, bool on) { w.set_multiple_echoes(on); }},
    Artefact{"indirect_echoes", [](wire::WorldChange& w, bool on) { w.set_indirect_echoes(on); }},
    Artefact{"shadow_sectors", [](wire::WorldChange& w, bool on) { w.set_shadow_sectors(on); }},
    Artefact{"second_trace", [](wire::WorldChange& w, bool on) { w.set_second_trace(on); }},
    Artefact{"interference", [](wire::WorldChange& w, bool on) { w.set_interference(on); }},
    Artefact{"overhead_cables", [](wire::WorldChange& w, bool on) { w.set_overhead_cables(on); }},
    Artefact{"saturation", [](wire::WorldChange& w, bool on) { w.set_saturation(on); }},
    Artefact{"minimum_range", [](wire::WorldChange& w, bool on) { w.set_minimum_range(on); }},
    Artefact{"antenna_motion", [](wire::WorldChange& w, bool on) { w.set_antenna_motion(on); }},
};

}  // namespace

std::span<const NumberControl> number_controls() { return kNumbers; }

std::span<const WordControl> word_controls() {
  static const std::vector<std::string> kSwitch = {"on", "off"};
  static const std::array kWords = {
      WordControl{"--sea-auto", "The sea control follows the clutter", kViewGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_sea_auto(is_on(w)); }},
      WordControl{"--stretch-bearing", "Echo stretch acts across spokes too", kViewGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_stretch_bearing(is_on(w)); }},
      WordControl{"--decimation",
                  "What becomes of samples that share a cell",
                  kViewGroup,
                  {"peak", "mean"},
                  [](wire::Set& s, const std::string& w) {
                    s.set_decimation(w == "mean" ? wire::MEAN : wire::PEAK);
                  }},
      WordControl{"--gain-auto", "The gain follows noise and clutter", kViewGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_gain_auto(is_on(w)); }},
      WordControl{"--side-lobe-auto", "Side lobe suppression by itself", kViewGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_side_lobe_auto(is_on(w)); }},
      WordControl{"--doppler",
                  "Which echoes are coloured by their radial speed",
                  kViewGroup,
                  {"off", "both", "approaching"},
                  [](wire::Set& s, const std::string& w) { s.set_doppler(doppler_named(w)); }},
      WordControl{"--mode",
                  "What the picture is set for; all but custom set gain, sea, rain and what cleans "
                  "the picture by themselves",
                  kViewGroup,
                  {kModes.begin(), kModes.end()},
                  [](wire::Set& s, const std::string& w) { s.set_mode(mode_named(w)); }},
      WordControl{"--transmit", "off is standby: no spokes come", kRadarGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_transmit(is_on(w)); }},
      WordControl{"--pulse",
                  "Pulse length; auto: by range scale",
                  kRadarGroup,
                  {"auto", "short", "medium", "long"},
                  [](wire::Set& s, const std::string& w) { s.set_pulse(pulse_named(w)); }},
      WordControl{"--tune-auto", "Tuning follows the transmitter", kRadarGroup, kSwitch,
                  [](wire::Set& s, const std::string& w) { s.set_tune_auto(is_on(w)); }},
  };
  return kWords;
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

std::optional<std::string> add_rain(const RainOptions& options, wire::WorldChange& change) {
  for (const std::uint32_t id : options.remove) change.add_remove_rain(id);
  if (options.remove_all) change.set_remove_all_rain(true);
  const bool described =
      options.radius_nm || options.rate_mm_h || options.drift_deg || options.drift_kn;
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
  return std::nullopt;
}

std::optional<std::string> add_artefact(const std::string& text, wire::WorldChange& change) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string word = equals == std::string::npos ? "" : text.substr(equals + 1);
  for (const Artefact& artefact : kArtefacts) {
    if (name != artefact.name) continue;
    if (word != "on" && word != "off") {
      return fmt::format("--artefact {}: '{}' is neither on nor off", name, printable(word, 20));
    }
    artefact.set(change, is_on(word));
    return std::nullopt;
  }
  return fmt::format("--artefact: '{}' is none of {}", printable(name, 40), artefact_names());
}

std::string artefact_names() {
  std::string names;
  for (const Artefact& artefact : kArtefacts) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", artefact.name);
  }
  return names;
}

}  // namespace skerry::client
