#include "server/world/radar_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "echo/radar/set_checks.hpp"
#include "echo/radar/shipped_sets.hpp"

namespace skerry::server {
namespace {

// The scenario's keys for what RadarSet calls otherwise.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kKeys = {{
    {"frequency_hz", "frequency_ghz"},
    {"peak_power_w", "peak_power_kw"},
    {"length_s", "length_us"},
    {"bandwidth_hz", "bandwidth_mhz"},
}};

// "pulses[1].length_us" of "pulses[1].length_s".
std::string key_of(std::string name) {
  const std::size_t dot = name.rfind('.');
  const std::size_t last = dot == std::string::npos ? 0 : dot + 1;
  for (const auto& [theirs, ours] : kKeys) {
    if (std::string_view(name).substr(last) == theirs) {
      name.replace(last, std::string::npos, ours);
      break;
    }
  }
  return name;
}

const echo::RadarSet* find_shipped(std::string_view name) {
  const auto sets = echo::shipped_sets();
  const auto found = std::find_if(sets.begin(), sets.end(),
                                  [&](const echo::RadarSet& set) { return set.name == name; });
  return found == sets.end() ? nullptr : &*found;
}

}  // namespace

std::optional<echo::RadarSet> shipped_set(const std::string& name) {
  const echo::RadarSet* const set = find_shipped(name);
  return set ? std::optional(*set) : std::nullopt;
}

std::string complain_of_name(const std::string& name) {
  std::string names;
  for (const echo::RadarSet& set : echo::shipped_sets()) {
    names += (names.empty() ? "" : ", ") + set.name;
  }
  return fmt::format("\"{}\" is no shipped set; allowed: {}", name, names);
}

echo::RangeFilter range_filter(scenario::RangeFilter filter) {
  if (filter == scenario::two_poles) return echo::RangeFilter::two_poles;
  if (filter == scenario::gaussian) return echo::RangeFilter::gaussian;
  return echo::RangeFilter::none;
}

echo::RadarSet radar_set(const scenario::Radar& radar) {
  echo::RadarSet set = radar.has_set() ? *shipped_set(radar.set()) : echo::shipped_sets().front();
  const double gain_of_beams = echo::gain_of_beams_db(set.beam_width_deg, set.vertical_beam_deg);
  if (radar.has_frequency_ghz()) set.frequency_hz = radar.frequency_ghz() * 1e9;
  if (radar.has_peak_power_kw()) set.peak_power_w = radar.peak_power_kw() * 1e3;
  if (radar.has_beam_width_deg()) set.beam_width_deg = radar.beam_width_deg();
  if (radar.has_vertical_beam_deg()) set.vertical_beam_deg = radar.vertical_beam_deg();
  // An antenna of another beam has another gain.
  set.antenna_gain_db +=
      echo::gain_of_beams_db(set.beam_width_deg, set.vertical_beam_deg) - gain_of_beams;
  if (radar.has_antenna_gain_db()) set.antenna_gain_db = radar.antenna_gain_db();
  if (radar.has_near_side_lobe_db()) set.near_side_lobe_db = radar.near_side_lobe_db();
  if (radar.has_far_side_lobe_db()) set.far_side_lobe_db = radar.far_side_lobe_db();
  if (radar.has_polarisation()) {
    set.polarisation =
        radar.polarisation() == scenario::vv ? echo::Polarisation::vv : echo::Polarisation::hh;
  }
  if (radar.has_rpm()) set.rpm = radar.rpm();
  if (radar.has_antenna_height_m()) set.antenna_height_m = radar.antenna_height_m();
  if (radar.has_noise_figure_db()) set.noise_figure_db = radar.noise_figure_db();
  if (radar.has_losses_db()) set.losses_db = radar.losses_db();
  if (radar.has_video_range_db()) set.video_range_db = radar.video_range_db();
  if (radar.has_set_integration()) set.integration = radar.set_integration();
  if (radar.has_range_filter()) set.range_filter = range_filter(radar.range_filter());
  if (radar.has_video_smoothing()) set.video_smoothing = radar.video_smoothing();
  if (radar.pulses_size() > 0) set.pulses.clear();
  for (const scenario::Pulse& pulse : radar.pulses()) {
    set.pulses.push_back({pulse.length_us() * 1e-6, pulse.bandwidth_mhz() * 1e6, pulse.prf_hz(),
                          pulse.up_to_nm(), pulse.compression_db()});
  }
  return set;
}

std::vector<SetComplaint> complaints_of(const scenario::Radar& radar) {
  std::vector<SetComplaint> complaints;
  for (const std::string& fault : echo::faults_of(radar_set(radar))) {
    const std::size_t colon = fault.find(": ");
    complaints.push_back({key_of(fault.substr(0, colon)), fault.substr(colon + 2)});
  }
  return complaints;
}

}  // namespace skerry::server
