#include "echo/picture_tool/radar_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "echo/radar/set_checks.hpp"

namespace skerry::echo {
namespace {

constexpr std::array<std::string_view, kFitKnobs> kKnobNames = {"video range, dB",
                                                                "integration, %",
                                                                "gain",
                                                                "pulse length, times the set's",
                                                                "bandwidth, times the set's",
                                                                "beam, deg"};

// The grid with the set's own value in its place.
std::vector<double> with(std::vector<double> values, double own) {
  for (const double v : values) {
    if (std::fabs(v - own) < 1e-9) return values;
  }
  values.push_back(own);
  std::sort(values.begin(), values.end());
  return values;
}

std::size_t place_of(const std::vector<double>& values, double own) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (std::fabs(values[i] - own) < std::fabs(values[best] - own)) best = i;
  }
  return best;
}

std::vector<double> beams_about(double own) {
  std::vector<double> beams;
  for (const double times : {0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4}) {
    const double beam = times * own;
    if (beam >= 0.3 && beam <= 7.5) beams.push_back(beam);  // kSetLimits
  }
  return beams;
}

}  // namespace

std::string_view knob_name(FitKnob knob) { return kKnobNames[static_cast<std::size_t>(knob)]; }

FitGrid::FitGrid(MadeRadar start) : start_(std::move(start)) {
  const std::vector<double> times = {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8};
  const std::array<double, kFitKnobs> own = {
      start_.set.video_range_db,
      std::max(start_.set.integration, start_.controls.integration),
      start_.controls.gain,
      1.0,
      1.0,
      start_.set.beam_width_deg};
  values_ = {with({4.0, 6.0, 8.0, 12.0, 18.0, 30.0, 45.0}, own[0]),
             with({0.0, 20.0, 40.0, 60.0, 80.0, 100.0}, own[1]),
             with({30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0}, own[2]),
             times,
             times,
             beams_about(own[5])};
  for (std::size_t k = 0; k < kFitKnobs; ++k) start_point_[k] = place_of(values_[k], own[k]);
}

MadeRadar FitGrid::at(const FitPoint& point) const {
  const auto value = [&](FitKnob knob) {
    return values(knob)[point[static_cast<std::size_t>(knob)]];
  };
  MadeRadar radar = start_;
  radar.set.video_range_db = value(FitKnob::video_range);
  radar.set.integration = value(FitKnob::integration);
  radar.controls.integration = 0.0;
  radar.controls.gain = value(FitKnob::gain);
  for (Pulse& pulse : radar.set.pulses) {
    pulse.length_s *= value(FitKnob::pulse);
    pulse.bandwidth_hz *= value(FitKnob::bandwidth);
  }
  radar.set.beam_width_deg = value(FitKnob::beam);
  radar.set.antenna_gain_db +=
      gain_of_beams_db(radar.set.beam_width_deg, radar.set.vertical_beam_deg) -
      gain_of_beams_db(start_.set.beam_width_deg, start_.set.vertical_beam_deg);
  return radar;
}

bool FitGrid::sound(const FitPoint& point) const { return faults_of(at(point).set).empty(); }

bool counts_for_fit(const StatisticRow& row) {
  return row.of != &PictureStatistics::turn_lag1 && row.of != &PictureStatistics::bow_seam;
}

double fit_distance(const PictureStatistics& real, const PictureStatistics& ours,
                    const PictureStatistics& spread) {
  double sum = 0.0, n = 0.0;
  for (const StatisticRow& row : statistic_rows()) {
    if (!counts_for_fit(row) || !std::isfinite(real.*row.of)) continue;
    // A figure that ours has not is as far off as can be.
    const double off = std::fabs(ours.*row.of - real.*row.of) / spread.*row.of;
    const double counted = std::isfinite(off) ? std::min(off, kMostOff) : kMostOff;
    sum += counted * counted, n += 1.0;
  }
  return n > 0.0 ? sum / n : kMostOff * kMostOff;
}

FitResult search_grid(const FitGrid& grid,
                      const std::function<double(const FitPoint&)>& distance_at, std::uint32_t most,
                      const std::function<bool()>& stop) {
  FitResult result;
  std::map<FitPoint, double> known;
  const auto distance = [&](const FitPoint& point) {
    const auto found = known.find(point);
    if (found != known.end()) return found->second;
    ++result.renders;
    return known[point] = distance_at(point);
  };
  const auto stopped = [&] { return result.renders >= most || stop(); };
  result.point = grid.start();
  result.distance = result.distance_before = distance(result.point);
  // Whether a step that way makes it better.
  const auto step = [&](std::size_t knob, bool up) {
    FitPoint next = result.point;
    const std::size_t count = grid.values(static_cast<FitKnob>(knob)).size();
    if (up ? next[knob] + 1 >= count : next[knob] == 0) return false;
    next[knob] = up ? next[knob] + 1 : next[knob] - 1;
    if (!grid.sound(next)) return false;
    const double there = distance(next);
    if (!(there < result.distance)) return false;
    result.point = next, result.distance = there;
    return true;
  };
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t knob = 0; knob < kFitKnobs; ++knob) {
      for (const bool up : {true, false}) {
        bool better = false;
        while (!stopped() && step(knob, up)) better = true;
        moved = moved || better;
        if (better) break;
      }
    }
    if (stopped()) return result;
  }
  result.ended = true;
  return result;
}

std::string scenario_of(const FitGrid& grid, const FitPoint& point) {
  const MadeRadar radar = grid.at(point), start = grid.at(grid.start());
  const RadarSet &set = radar.set, &from = start.set;
  std::string text = fmt::format("      - set: {}\n", set.name);
  const auto line = [&](const char* key, double value, bool differs) {
    if (differs) text += fmt::format("        {}: {:.4g}\n", key, value);
  };
  text += fmt::format(
      "        spokes: {}\n        cells: {}\n        bits: {}\n        range_nm: {:g}\n",
      radar.geometry.spokes_per_turn, radar.geometry.cells, radar.geometry.bits,
      radar.controls.range_scale.in_nautical_miles());
  line("gain", radar.controls.gain, true);
  line("beam_width_deg", set.beam_width_deg, set.beam_width_deg != from.beam_width_deg);
  line("video_range_db", set.video_range_db, set.video_range_db != from.video_range_db);
  line("set_integration", set.integration, set.integration != from.integration);
  if (set.pulses == from.pulses) return text;
  text += "        pulses:\n";
  for (const Pulse& pulse : set.pulses)
    text += fmt::format(
        "          - {{length_us: {:.4g}, bandwidth_mhz: {:.4g}, prf_hz: {:g}, up_to_nm: {:g}, "
        "compression_db: {:.4g}}}\n",
        pulse.length_s * 1e6, pulse.bandwidth_hz * 1e-6, pulse.prf_hz, pulse.up_to_nm,
        pulse.compression_db);
  return text;
}

}  // namespace skerry::echo
