#include "echo/receiver/controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace skerry::echo {
namespace {

struct Named {
  const char* name;
  double value;
  double least = 0.0, most = 100.0;
  bool or_zero = false;
};

std::optional<std::string> fault(const Named& control) {
  // Comparisons are false for NaN.
  if (control.value >= control.least && control.value <= control.most) return std::nullopt;
  if (control.or_zero && control.value == 0.0) return std::nullopt;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%s must lie within %g and %g%s, is %g", control.name,
                control.least, control.most, control.or_zero ? " or be 0" : "", control.value);
  return std::string(text.data());
}

template <std::size_t N>
std::optional<std::string> first_control_fault(const std::array<Named, N>& all) {
  for (const Named& control : all) {
    if (auto found = fault(control)) return found;
  }
  return std::nullopt;
}

// 3 dB more than the side lobes themselves.
constexpr double kAutoSideLobes = 62.0;

// Settings of a picture mode; gain is automatic in all but two.
struct ModeSettings {
  bool gain_auto, sea_auto;
  double gain, sea, rain, interference_rejection, echo_stretch, integration, noise_rejection,
      target_separation, target_boost;
};

// This receiver's own choice: near and sharp in harbour; steady at sea; small and far echoes for
// buoys and birds; all of the rain for the weather.
ModeSettings settings_of(PictureMode mode) {
  switch (mode) {
    case PictureMode::offshore:
      return {true, true, 50.0, 50.0, 20.0, 60.0, 34.0, 60.0, 40.0, 0.0, 0.0};
    case PictureMode::buoy:
      return {true, true, 50.0, 40.0, 0.0, 40.0, 0.0, 20.0, 20.0, 60.0, 60.0};
    case PictureMode::weather:
      return {false, false, 60.0, 20.0, 0.0, 80.0, 0.0, 60.0, 0.0, 0.0, 0.0};
    case PictureMode::bird:
      return {false, false, 75.0, 15.0, 0.0, 40.0, 34.0, 0.0, 0.0, 0.0, 80.0};
    case PictureMode::harbour:
    case PictureMode::custom:
      break;
  }
  return {true, true, 50.0, 50.0, 10.0, 40.0, 0.0, 0.0, 30.0, 60.0, 0.0};
}

constexpr double kFarthestShown =
    2.0 * nautical_miles(RangeScale::kNauticalMiles.back()).in_metres();
constexpr double kShortestReach = 1.0 / 16.0, kLongestReach = 2.0;  // of the range scale

}  // namespace

ViewControls effective_controls(const ViewControls& controls) {
  ViewControls out = controls;
  if (controls.mode != PictureMode::custom) {
    const ModeSettings set = settings_of(controls.mode);
    out.mode = PictureMode::custom;
    out.gain_auto = set.gain_auto;
    out.sea_auto = set.sea_auto;
    out.gain = set.gain;
    out.sea = set.sea;
    out.rain = set.rain;
    out.interference_rejection = set.interference_rejection;
    out.echo_stretch = set.echo_stretch;
    out.stretch_bearing = false;
    out.integration = set.integration;
    out.noise_rejection = set.noise_rejection;
    out.target_separation = set.target_separation;
    out.target_boost = set.target_boost;
    out.side_lobe_auto = true;
  }
  if (out.side_lobe_auto) {
    out.side_lobe_auto = false;
    out.side_lobe_suppression = kAutoSideLobes;
  }
  return out;
}

Length reach_of(const ViewControls& controls) {
  const Length scale = controls.range_scale.length();
  if (!(controls.instrumented_range_m > 0.0)) return scale;
  return metres(std::clamp(controls.instrumented_range_m, kShortestReach * scale.in_metres(),
                           kLongestReach * scale.in_metres()));
}

std::uint32_t row_cells_for(const ScanGeometry& geometry, RangeScale scale,
                            const ViewControls& controls) {
  const double share = reach_of(controls).in_metres() / scale.length().in_metres();
  const auto quarters =
      static_cast<std::uint32_t>(std::ceil(4.0 * std::clamp(share, 1.0, kLongestReach) - 1e-9));
  return (geometry.cells * quarters + 3) / 4;
}

std::optional<std::string> fault_of(const RadarControls& controls) {
  if (controls.blanked.size() > kMostBlanked) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "blanked: %zu sectors; allowed: at most %zu",
                  controls.blanked.size(), kMostBlanked);
    return std::string(text.data());
  }
  for (const BlankedSector& sector : controls.blanked) {
    if (auto found =
            first_control_fault(std::array{Named{"blanked from", sector.from_deg, 0.0, 360.0},
                                           Named{"blanked to", sector.to_deg, 0.0, 360.0}}))
      return found;
  }
  return first_control_fault(std::array{
      Named{"tune", controls.tune}, Named{"rotation_rpm", controls.rotation_rpm, 10.0, 60.0, true},
      Named{"bearing_alignment_deg", controls.bearing_alignment_deg, -180.0, 180.0},
      Named{"antenna_height_m", controls.antenna_height_m, 1.0, 100.0, true}});
}

std::optional<std::string> fault_of(const ViewControls& controls) {
  return first_control_fault(std::array{
      Named{"gain", controls.gain}, Named{"sea", controls.sea}, Named{"rain", controls.rain},
      Named{"interference_rejection", controls.interference_rejection},
      Named{"echo_stretch", controls.echo_stretch}, Named{"integration", controls.integration},
      Named{"side_lobe_suppression", controls.side_lobe_suppression},
      Named{"noise_rejection", controls.noise_rejection},
      Named{"target_separation", controls.target_separation},
      Named{"target_boost", controls.target_boost},
      Named{"doppler_threshold_mps", controls.doppler_threshold_mps, 0.1, 20.0},
      Named{"instrumented_range_m", controls.instrumented_range_m, 0.0, kFarthestShown}});
}

double tune_loss_db(const RadarControls& controls) {
  if (controls.tune_auto) return 0.0;
  const double bandwidths = kTuningSpan * (controls.tune - 50.0) / 50.0;
  return 12.0 * bandwidths * bandwidths;
}

}  // namespace skerry::echo
