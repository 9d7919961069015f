#include "echo/coast_tool/coast_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void measure_by_rulers(const CoastLines& coast, double shortest, double longest,
                       CoastMeasurement& out) {
  double longest_line = 0.0;
  for (const PlaneLine& line : coast.lines) longest_line = std::max(longest_line, length_of(line));
  longest = std::min(longest, longest_line / 4.0);
  if (longest < 4.0 * shortest) return;
  for (const PlaneLine& line : coast.lines) {
    if (length_of(line) < 3.999 * longest) continue;
    const auto lengths = divider_lengths(line, shortest, longest);
    if (lengths.empty()) continue;
    ++out.ruled_lines;
    if (out.rulers.empty()) out.rulers.assign(lengths.size(), {});
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      out.rulers[k].ruler_m = lengths[k].ruler_m;
      out.rulers[k].length_m += lengths[k].length_m;
    }
  }
  out.divider = divider_estimate(out.rulers);
}

void measure_by_chords(const CoastLines& coast, double shortest, double longest,
                       const Telling& tell, CoastMeasurement& out) {
  std::vector<double> x, y, weights;
  for (double chord = shortest; chord <= longest * 1.001; chord *= 2.0) {
    tell(fmt::format("offsets from chords of {:.0f} m", chord));
    const double step = std::max(chord / 64.0, coast.median_spacing_m);
    const ChordOffsets offsets = chord_offsets(coast.lines, chord, step);
    if (offsets.chords < 2) break;
    out.chords.push_back(offsets);
    const double relative = offsets.middle_error / offsets.middle_rms;
    if (!out.sees_chord(chord) || offsets.chords < 8 || !(relative > 0.0)) continue;
    x.push_back(std::log(chord));
    y.push_back(std::log(offsets.middle_rms));
    weights.push_back(1.0 / (relative * relative));
  }
  out.offset_trend = fitted_line(x, y, weights);
}

}  // namespace

DimensionEstimate divider_estimate(std::span<const RulerLength> lengths) {
  std::vector<double> x, y;
  for (const RulerLength& l : lengths) {
    x.push_back(std::log(l.ruler_m));
    y.push_back(std::log(l.length_m));
  }
  const LineFit fit = fitted_line(x, y);
  const double d = 1.0 - fit.slope;
  const double reach = student95(static_cast<int>(x.size()) - 2) * fit.slope_error;
  return {d, fit.slope_error, {d - reach, d + reach}};
}

CoastMeasurement measure_coast(const CoastLines& coast, double from_m, double to_m,
                               const Telling& tell) {
  CoastMeasurement out;
  out.spacing_m = coast.mean_spacing_m;
  tell("counting boxes");
  out.census = box_census(coast.lines, from_m, to_m);
  while (!out.census.boxes.empty() && out.census.boxes.back() < 8) {
    out.census.boxes.pop_back();
    out.census.sizes_m.pop_back();
    for (auto& tile : out.census.tiles) tile.pop_back();
  }
  if (out.census.sizes_m.size() < 3)
    throw TooLittleCoast(fmt::format(
        "{:.1f} km of coast fill fewer than 8 boxes of {:g} m: too little for a dimension over "
        "three sizes of box. Take a larger area, or begin with smaller boxes (--from)",
        coast.length_m / 1000.0, 4.0 * from_m));
  const double coarsest = out.census.sizes_m.back() / std::sqrt(2.0);
  if (!out.sees_octave(coarsest))
    throw TooLittleCoast(fmt::format(
        "boxes of {:g} to {:g} m are finer than the chart's own edges of {:.3g} m, whose straight "
        "lines they would measure. Take larger boxes (--to), a larger area or a finer chart",
        out.census.sizes_m.front(), out.census.sizes_m.back(), out.spacing_m));
  tell("drawing samples of the boxes");
  out.box = box_dimension(out.census);
  out.octaves = local_dimensions(out.census);
  tell("walking rulers");
  measure_by_rulers(coast, 2.0 * from_m, to_m, out);
  measure_by_chords(coast, 2.0 * from_m, 2.0 * to_m, tell, out);
  return out;
}

double finest_scale_m(const CoastLines& coast) {
  double scale = 100.0;
  while (scale >= 1.2 * coast.median_spacing_m && scale > 1.0) scale /= 2.0;
  while (scale < 0.6 * coast.median_spacing_m) scale *= 2.0;
  return scale;
}

LineFit octave_drift(const CoastMeasurement& coast) {
  std::vector<double> x, y;
  for (const ScaleDimension& octave : coast.octaves) {
    if (!coast.sees_octave(octave.scale_m)) continue;
    x.push_back(std::log2(octave.scale_m));
    y.push_back(octave.dimension);
  }
  return fitted_line(x, y);
}

Range95 dimension_at(const CoastMeasurement& coast, double scale_m) {
  double finest = coast.octaves.empty() ? 0.0 : coast.octaves.back().scale_m;
  double n = 0.0, mean = 0.0, squares = 0.0;
  for (const ScaleDimension& octave : coast.octaves) {
    if (!coast.sees_octave(octave.scale_m)) continue;
    finest = std::min(finest, octave.scale_m);
    n += 1.0;
    mean += octave.dimension;
    squares += octave.dimension * octave.dimension;
  }
  double variance = coast.box.standard_error * coast.box.standard_error;
  if (n > 1.0) variance += std::max(0.0, squares - mean * mean / n) / (n - 1.0);
  const LineFit drift = octave_drift(coast);
  if (n > 2.0) {
    const double far = std::max(0.0, std::log2(finest / scale_m)) * drift.slope;
    variance += far * far;
  }
  const double reach = 2.0 * std::sqrt(variance);
  const double value = std::clamp(coast.box.dimension, 1.0, 2.0);
  return {value, std::max(1.0, coast.box.dimension - reach),
          std::min(2.0, coast.box.dimension + reach)};
}

Range95 offset_at(const CoastMeasurement& coast, double chord_m) {
  const LineFit& trend = coast.offset_trend;
  if (trend.points < 3 || !std::isfinite(trend.slope)) return {kNone, kNone, kNone};
  const double x = std::log(chord_m);
  const double reach = student95(static_cast<int>(trend.points) - 2) * trend.error_at(x);
  return {std::exp(trend.at(x)), std::exp(trend.at(x) - reach), std::exp(trend.at(x) + reach)};
}

}  // namespace skerry::echo
