#include "server/app/control/controls_message.hpp"

#include <algorithm>

#include "server/radar/control_values.hpp"

namespace skerry::server {
namespace {

void change_range(const wire::Set& set, echo::ViewControls& controls) {
  const RangeScale before = controls.range_scale;
  if (set.has_range_nm()) controls.range_scale = *RangeScale::find(set.range_nm());
  if (!set.has_instrumented_range_m()) {
    controls.instrumented_range_m =
        carried_range_m(controls.instrumented_range_m, before, controls.range_scale);
  }
}

}  // namespace

void change_view(const wire::Set& set, echo::ViewControls& controls) {
  read_controls(set, controls);
  change_range(set, controls);
}

void change_radar(const wire::Set& set, echo::RadarControls& controls) {
  read_controls(set, controls);
  if (!set.has_blanked_sectors()) return;
  controls.blanked.clear();
  for (const auto& sector : set.blanked_sectors().sectors()) {
    controls.blanked.push_back({sector.from_deg(), sector.to_deg()});
  }
}

void tell_view(const echo::ViewControls& controls, wire::Settings& settings) {
  settings.set_range_nm(controls.range_scale.in_nautical_miles());
  write_controls(controls, settings);
}

void tell_radar(const echo::RadarControls& controls, const echo::RadarSet& set,
                wire::Settings& settings) {
  write_controls(controls, settings);
  if (!(controls.rotation_rpm > 0.0)) settings.set_rotation_rpm(set.rpm);
  if (!(controls.antenna_height_m > 0.0)) settings.set_antenna_height_m(set.antenna_height_m);
  settings.clear_blanked_sectors();
  for (const echo::BlankedSector& sector : controls.blanked) {
    auto& said = *settings.mutable_blanked_sectors()->add_sectors();
    said.set_from_deg(sector.from_deg);
    said.set_to_deg(sector.to_deg);
  }
}

double carried_range_m(double instrumented_range_m, RangeScale from, RangeScale to) {
  if (instrumented_range_m == 0.0 || from == to) return instrumented_range_m;
  const double to_m = to.length().in_metres();
  return std::clamp(instrumented_range_m / from.length().in_metres() * to_m, kShortestReach * to_m,
                    kLongestReach * to_m);
}

bool is_instrumented_range(double range_m, RangeScale scale) {
  const double scale_m = scale.length().in_metres();
  return range_m == 0.0 ||
         (range_m >= kShortestReach * scale_m && range_m <= kLongestReach * scale_m);
}

}  // namespace skerry::server
