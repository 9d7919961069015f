#include "echo/receiver/controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "echo/receiver/control_row.hpp"

namespace skerry::echo {
namespace {

std::optional<std::string> fault(std::string_view name, double value, double least, double most,
                                 bool or_zero = false) {
  // Comparisons are false for NaN.
  if ((value >= least && value <= most) || (or_zero && value == 0.0)) return std::nullopt;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%.*s must lie within %g and %g%s, is %g",
                static_cast<int>(name.size()), name.data(), least, most, or_zero ? " or be 0" : "",
                value);
  return std::string(text.data());
}

template <typename Rows, typename Controls>
std::optional<std::string> first_fault(const Rows& rows, const Controls& controls) {
  for (const auto& row : rows) {
    if (auto found = fault(row.name, row.get(controls), row.min, row.max, row.or_zero))
      return found;
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
    if (auto found = fault("blanked from", sector.from_deg, 0.0, 360.0)) return found;
    if (auto found = fault("blanked to", sector.to_deg, 0.0, 360.0)) return found;
  }
  return first_fault(kRadarControlRows, controls);
}

std::optional<std::string> fault_of(const ViewControls& controls) {
  return first_fault(kViewControlRows, controls);
}

double tune_loss_db(const RadarControls& controls) {
  if (controls.tune_auto) return 0.0;
  const double bandwidths = kTuningSpan * (controls.tune - 50.0) / 50.0;
  return 12.0 * bandwidths * bandwidths;
}

}  // namespace skerry::echo
