#include "echo/coast_tool/fit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skerry::echo {
namespace {

// With fewer chords the dimension of offsets is chance.
constexpr std::size_t kFewestChords = 30;

std::string scale_text(double metres) {
  return metres < 1000.0 ? fmt::format("{:.3g} m", metres) : fmt::format("{:.3g} km", metres / 1e3);
}

std::string number_or_dash(double x, const char* format) {
  return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "-";
}

// Box counts and chords on one line per size; the first chord is twice the first box.
std::string scales_table(const CoastMeasurement& m) {
  std::string out = fmt::format("{:>8} {:>8} {:>11}   {:>8} {:>7} {:>16} {:>12}\n", "box", "boxes",
                                "D by octave", "chord", "chords", "middle offset", "D of offsets");
  const std::size_t rows = std::max(m.census.sizes_m.size(), m.chords.size());
  for (std::size_t k = 0; k < rows; ++k) {
    std::string box = fmt::format("{:>8} {:>8} {:>11}", "", "", "");
    if (k < m.census.sizes_m.size()) {
      const bool has_octave = k < m.octaves.size();
      box =
          fmt::format("{:>8} {:>8} {:>9}{:<2}", scale_text(m.census.sizes_m[k]), m.census.boxes[k],
                      has_octave ? fmt::format("{:.3f}", m.octaves[k].dimension) : "",
                      has_octave && !m.sees_octave(m.octaves[k].scale_m) ? " *" : "");
    }
    std::string chord;
    if (k < m.chords.size()) {
      const ChordOffsets& c = m.chords[k];
      chord =
          fmt::format("{:>8} {:>7} {:>14}{:<2} {:>12}", scale_text(c.chord_m), c.chords,
                      fmt::format("{:.3f} +- {:.3f}", c.middle_rms, c.middle_error),
                      m.sees_chord(c.chord_m) ? "" : " *",
                      c.chords < kFewestChords ? "-" : number_or_dash(c.graph_dimension, "{:.2f}"));
    }
    out += box + "   " + chord + "\n";
  }
  return out +
         "D by octave: between a size and the next. Middle offset: rms, square to the chord, of "
         "the\n"
         "coast's middle, in chords. *: so fine that the chart's own straight edges show.\n";
}

std::string estimates_table(const CoastMeasurement& m) {
  const auto line = [](const std::string& what, const DimensionEstimate& d, const char* note) {
    return fmt::format("{:<30} {:.3f} +- {:.3f}   {:.2f} .. {:.2f}   {}\n", what, d.dimension,
                       d.standard_error, std::max(0.0, d.interval95.low),
                       std::min(2.0, d.interval95.high), note);
  };
  std::string out = fmt::format("{:<30} {:<14}   {:<12}\n", "dimension", "", "95 %");
  out += line(fmt::format("boxes {} to {}", scale_text(m.census.sizes_m.front()),
                          scale_text(m.census.sizes_m.back())),
              m.box, "outlines, islands and all");
  if (!m.rulers.empty()) {
    out += line(fmt::format("rulers {} to {}", scale_text(m.rulers.front().ruler_m),
                            scale_text(m.rulers.back().ruler_m)),
                m.divider,
                m.ruled_lines == 1 ? "along the one long line" : "along the long lines only");
  }
  for (auto c = m.chords.rbegin(); c != m.chords.rend(); ++c) {
    if (!std::isfinite(c->graph_dimension) || c->chords < kFewestChords) continue;
    out += fmt::format("{:<30} {:.2f}{:<28} {}\n",
                       fmt::format("offsets from chords of {}", scale_text(c->chord_m)),
                       c->graph_dimension, "", "variogram; reads high where bays overhang");
    break;
  }
  return out;
}

std::string below_table(const CoastMeasurement& m) {
  std::string out = fmt::format("Extrapolated below the chart's mean edge of {}, 95 %:\n",
                                scale_text(m.spacing_m));
  for (double part : {1.0, 4.0, 16.0}) {
    const double scale = m.spacing_m / part;
    const Range95 d = dimension_at(m, scale), o = offset_at(m, scale);
    out += fmt::format("{:>8}   D {:.2f} ({:.2f} .. {:.2f})", scale_text(scale), d.value, d.low,
                       d.high);
    if (std::isfinite(o.value)) {
      out += fmt::format("   middle offset {:.2f} ", o.value);
      out += o.high > 25.0 * o.low ? "(not known to a factor of 5)"
                                   : fmt::format("({:.2f} .. {:.2f})", o.low, o.high);
    }
    out += "\n";
  }
  const LineFit drift = octave_drift(m);
  if (drift.points > 2 &&
      std::fabs(drift.slope) > student95(static_cast<int>(drift.points) - 2) * drift.slope_error) {
    out += fmt::format(
        "The local D {} by {:.2f} at every doubling of the scale: no one dimension describes this\n"
        "coast, and finer detail is probably {} than the style below.\n",
        drift.slope > 0.0 ? "rises" : "falls", std::fabs(drift.slope),
        drift.slope > 0.0 ? "smoother" : "rougher");
  }
  return out;
}

}  // namespace

std::string_view scenario_name(CoastType type) {
  switch (type) {
    case CoastType::unknown:
      return "unknown";
    case CoastType::artificial:
      return "artificial";
    case CoastType::rocky:
      return "rocky";
    case CoastType::sandy:
      return "sandy";
  }
  return "";
}

std::string style_text(const CoastStyle& style) {
  if (style.method == CoastMethod::straight) return "{method: straight, dimension: 1}";
  return fmt::format("{{method: {}, dimension: {:g}, amplitude: {:g}}}", name_of(style.method),
                     style.dimension, style.amplitude);
}

std::string fit_text(const CoastFit& fit) {
  const CoastLines& c = fit.coast;
  std::string out = fmt::format(
      "\n{} coast: {:.0f} km in {} line{}, {} edges of {} (median), {} (mean), {} (90 %)\n\n",
      fit.name, c.length_m / 1000.0, c.lines.size(), c.lines.size() == 1 ? "" : "s", c.edges,
      scale_text(c.median_spacing_m), scale_text(c.mean_spacing_m), scale_text(c.p90_spacing_m));
  out += scales_table(fit.measurement) + "\n";
  out += estimates_table(fit.measurement) + "\n";
  out += below_table(fit.measurement) + "\n";
  out += "Style " + style_text(fit.chosen.style) + "\n";
  for (const std::string& word : fit.chosen.words) out += "  " + word + "\n";
  return out;
}

std::string stretches_text(const CoastStretches& found,
                           const std::vector<StyledStretch>& stretches) {
  std::string out = fmt::format("\n{:>8} {:>9} {:>8} {:>16} {:>16}   style\n", "lat", "lon",
                                "length", "D by rulers", "middle offset");
  for (const auto& [s, style] : stretches) {
    out += fmt::format("{:>8.3f} {:>9.3f} {:>5.1f} km {:>7.3f} +- {:.3f} {:>8.3f} +- {:.3f}   {}\n",
                       s.middle.latitude_deg, s.middle.longitude_deg, s.length_m / 1000.0,
                       s.dimension.dimension, s.dimension.standard_error, s.offset, s.offset_error,
                       style_text(style));
  }
  std::vector<double> d;
  for (const auto& [s, style] : stretches) {
    if (std::isfinite(s.dimension.dimension)) d.push_back(s.dimension.dimension);
  }
  std::sort(d.begin(), d.end());
  if (!d.empty()) {
    out += fmt::format("{} stretches: D from {:.2f} to {:.2f}, half of them {:.2f} to {:.2f}\n",
                       d.size(), d.front(), d.back(), d[d.size() / 4], d[d.size() * 3 / 4]);
  }
  if (found.left_out > 0) {
    out += fmt::format("left out: {} lines shorter than half a stretch, {:.0f} km together\n",
                       found.left_out, found.left_out_m / 1000.0);
  }
  return out;
}

std::string scenario_text(const std::vector<CoastFit>& fits,
                          const std::vector<StyledStretch>& stretches) {
  std::string out = "coast:\n";
  for (const CoastFit& fit : fits) {
    for (const std::string& kind : fit.kinds) {
      out += fmt::format("  {}: {}\n", kind, style_text(fit.chosen.style));
    }
  }
  if (!stretches.empty()) out += "  places:\n";
  for (const auto& [s, style] : stretches) {
    out += fmt::format(
        "    - {{position: {{lat: {:.5f}, lon: {:.5f}}}, radius_nm: {:.2f}, style: {}}}\n",
        s.middle.latitude_deg, s.middle.longitude_deg, std::max(0.01, s.radius_m / 1852.0),
        style_text(style));
  }
  return out;
}

std::string scales_csv(const std::vector<CoastFit>& fits) {
  std::string out =
      "coast,scale_m,boxes,local_dimension_to_next,chords,middle_offset,middle_offset_error,"
      "offset_dimension\n";
  for (const CoastFit& fit : fits) {
    const CoastMeasurement& m = fit.measurement;
    std::vector<double> scales = m.census.sizes_m;
    for (const ChordOffsets& c : m.chords) scales.push_back(c.chord_m);
    std::sort(scales.begin(), scales.end());
    scales.erase(std::unique(scales.begin(), scales.end()), scales.end());
    for (double scale : scales) {
      out += fmt::format("{},{:g},", fit.name, scale);
      const auto size = std::find(m.census.sizes_m.begin(), m.census.sizes_m.end(), scale);
      if (size != m.census.sizes_m.end()) {
        const auto k = static_cast<std::size_t>(size - m.census.sizes_m.begin());
        out += fmt::format("{},", m.census.boxes[k]);
        if (k < m.octaves.size()) out += fmt::format("{:.6f}", m.octaves[k].dimension);
      } else {
        out += ",";
      }
      out += ",";
      const auto chord = std::find_if(m.chords.begin(), m.chords.end(),
                                      [&](const ChordOffsets& c) { return c.chord_m == scale; });
      if (chord == m.chords.end()) {
        out += ",,,\n";
        continue;
      }
      out +=
          fmt::format("{},{:.6f},{:.6f},", chord->chords, chord->middle_rms, chord->middle_error);
      out += std::isfinite(chord->graph_dimension) ? fmt::format("{:.6f}\n", chord->graph_dimension)
                                                   : "\n";
    }
  }
  return out;
}

}  // namespace skerry::echo
