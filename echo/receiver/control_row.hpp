// ControlRow: the controls of a radar and of a view by name, as tables.  The schema that messages
// and people see (protocol/wire/controls.proto) has the same names, ranges and defaults.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "echo/receiver/controls.hpp"

namespace skerry::echo {

// A number, a switch (0 or 1) or a choice (its number).
template <typename Controls>
struct ControlRow {
  std::string_view name;
  double (*get)(const Controls&);
  void (*set)(Controls&, double);  // requires allows(value)
  double min = 0.0, max = 100.0;
  bool or_zero = false;  // 0 leaves it to the set

  // False for NaN.
  bool allows(double value) const {
    if (or_zero && value == 0.0) return true;
    return value >= min && value <= max;
  }
};

template <typename Member>
struct MemberOf;
template <typename Controls_, typename Value_>
struct MemberOf<Value_ Controls_::*> {
  using Controls = Controls_;
  using Value = Value_;
};

template <auto kMember>
constexpr auto control_row(std::string_view name, double min, double max, bool or_zero = false) {
  using Controls = typename MemberOf<decltype(kMember)>::Controls;
  using Value = typename MemberOf<decltype(kMember)>::Value;
  return ControlRow<Controls>{name,
                              [](const Controls& c) { return static_cast<double>(c.*kMember); },
                              [](Controls& c, double value) {
                                if constexpr (std::is_enum_v<Value>) {
                                  c.*kMember = static_cast<Value>(static_cast<std::uint8_t>(value));
                                } else if constexpr (std::is_same_v<Value, bool>) {
                                  c.*kMember = value != 0.0;
                                } else {
                                  c.*kMember = value;
                                }
                              },
                              min,
                              max,
                              or_zero};
}
template <auto kMember>
constexpr auto knob_row(std::string_view name) {
  return control_row<kMember>(name, 0.0, 100.0);
}
template <auto kMember>
constexpr auto switch_row(std::string_view name) {
  return control_row<kMember>(name, 0.0, 1.0);
}
template <auto kMember>
constexpr auto choice_row(std::string_view name, typename MemberOf<decltype(kMember)>::Value last) {
  return control_row<kMember>(name, 0.0, static_cast<double>(last));
}

// All but the range scale, which is no number.
inline constexpr std::array kViewControlRows = {
    knob_row<&ViewControls::gain>("gain"),
    knob_row<&ViewControls::sea>("sea"),
    knob_row<&ViewControls::rain>("rain"),
    knob_row<&ViewControls::interference_rejection>("interference_rejection"),
    knob_row<&ViewControls::echo_stretch>("echo_stretch"),
    knob_row<&ViewControls::integration>("integration"),
    switch_row<&ViewControls::sea_auto>("sea_auto"),
    switch_row<&ViewControls::stretch_bearing>("stretch_bearing"),
    choice_row<&ViewControls::decimation>("decimation", Decimation::mean),
    switch_row<&ViewControls::gain_auto>("gain_auto"),
    knob_row<&ViewControls::side_lobe_suppression>("side_lobe_suppression"),
    switch_row<&ViewControls::side_lobe_auto>("side_lobe_auto"),
    knob_row<&ViewControls::noise_rejection>("noise_rejection"),
    knob_row<&ViewControls::target_separation>("target_separation"),
    knob_row<&ViewControls::target_boost>("target_boost"),
    choice_row<&ViewControls::doppler>("doppler", DopplerMode::approaching),
    control_row<&ViewControls::doppler_threshold_mps>("doppler_threshold_mps", 0.1, 20.0),
    choice_row<&ViewControls::mode>("mode", PictureMode::bird),
    control_row<&ViewControls::instrumented_range_m>("instrumented_range_m", 0.0, kFarthestShownM),
};

// All but the blanked sectors, which are a list.
inline constexpr std::array kRadarControlRows = {
    switch_row<&RadarControls::transmit>("transmit"),
    choice_row<&RadarControls::pulse>("pulse", PulseChoice::long_pulse),
    switch_row<&RadarControls::tune_auto>("tune_auto"),
    knob_row<&RadarControls::tune>("tune"),
    control_row<&RadarControls::rotation_rpm>("rotation_rpm", 10.0, 60.0, true),
    control_row<&RadarControls::bearing_alignment_deg>("bearing_alignment_deg", -180.0, 180.0),
    control_row<&RadarControls::antenna_height_m>("antenna_height_m", 1.0, 100.0, true),
};

}  // namespace skerry::echo
