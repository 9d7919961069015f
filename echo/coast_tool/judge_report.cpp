#include "echo/coast_tool/judge_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "echo/tool_console/text_table.hpp"

namespace skerry::echo {
namespace {

struct Spread {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = 0.0;  // over the seeds
};

template <typename Items, typename Measure>
Spread spread_of(const Items& items, const Measure& measure) {
  if (items.empty()) return {};
  Spread spread{0.0, 0.0};
  const auto n = static_cast<double>(items.size());
  for (const auto& item : items) spread.mean += measure(item) / n;
  for (const auto& item : items) {
    const double off = measure(item) - spread.mean;
    spread.deviation += off * off;
  }
  spread.deviation = n > 1.0 ? std::sqrt(spread.deviation / (n - 1.0)) : 0.0;
  return spread;
}

// "1.23~0.04", "-" for nothing; the deviation only where there is one to be seen.
std::string cell(const Spread& s, int digits) {
  std::string text = std::isfinite(s.mean) ? fmt::format("{:.{}f}", s.mean, digits) : "-";
  if (s.deviation >= 0.5 * std::pow(10.0, -digits))
    text += fmt::format("~{:.{}f}", s.deviation, digits);
  return text;
}

// A column: its heading, digits, and what it takes of one seed.
template <typename Item>
struct Column {
  std::string name;
  int digits;
  std::function<double(const Item&)> of;
};
using ShapeColumn = Column<CoastShape>;
using ScoreColumn = Column<CoastScore>;
using PictureColumn = Column<PictureScore>;

std::vector<ShapeColumn> curve_columns(const Judgement& judgement) {
  std::vector<ShapeColumn> columns = {{"km", 0, [](const CoastShape& s) { return s.length_km; }}};
  const auto& scales = judgement.real.shapes.front().dimensions;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    columns.push_back({fmt::format("D {:.0f} m", scales[i].scale_m), 2, [i](const CoastShape& s) {
                         return i < s.dimensions.size() ? s.dimensions[i].dimension
                                                        : std::numeric_limits<double>::quiet_NaN();
                       }});
  }
  return columns;
}
const std::vector<ScoreColumn>& curve_scores() {
  static const std::vector<ScoreColumn> all = {
      {"D error", 3, [](const CoastScore& s) { return s.dimension_error; }},
      {"apart m", 0, [](const CoastScore& s) { return s.apart_rms_m; }},
      {"real to made p50", 0, [](const CoastScore& s) { return s.real_to_made_p50_m; }},
      {"p90 m", 0, [](const CoastScore& s) { return s.real_to_made_p90_m; }},
      {"made to real p50", 0, [](const CoastScore& s) { return s.made_to_real_p50_m; }},
      {"p90 m", 0, [](const CoastScore& s) { return s.made_to_real_p90_m; }}};
  return all;
}
const std::vector<ShapeColumn>& structure_columns() {
  static const std::vector<ShapeColumn> all = {
      {"bays/km", 2, [](const CoastShape& s) { return s.bays_per_km; }},
      {"depth p50", 0, [](const CoastShape& s) { return quantile_of(s.depths_m, 0.5); }},
      {"p90 m", 0, [](const CoastShape& s) { return quantile_of(s.depths_m, 0.9); }},
      {"width p50", 0, [](const CoastShape& s) { return quantile_of(s.widths_m, 0.5); }},
      {"p90 m", 0, [](const CoastShape& s) { return quantile_of(s.widths_m, 0.9); }},
      {"wave 1", 3, [](const CoastShape& s) { return s.spectrum[0]; }},
      {"2-3", 3, [](const CoastShape& s) { return s.spectrum[1]; }},
      {"4-7", 3, [](const CoastShape& s) { return s.spectrum[2]; }}};
  return all;
}
const std::vector<ScoreColumn>& structure_scores() {
  static const std::vector<ScoreColumn> all = {
      {"KS depth", 2, [](const CoastScore& s) { return s.depth_distance; }},
      {"width", 2, [](const CoastScore& s) { return s.width_distance; }},
      {"spectrum error", 2, [](const CoastScore& s) { return s.spectrum_error; }}};
  return all;
}
const std::vector<PictureColumn>& picture_columns() {
  static const std::vector<PictureColumn> all = {
      {"D below", 2, [](const PictureScore& s) { return s.below_recorded; }},
      {"above", 2, [](const PictureScore& s) { return s.above_recorded; }},
      {"at beam", 2, [](const PictureScore& s) { return s.below_beam; }},
      {"above", 2, [](const PictureScore& s) { return s.above_beam; }},
      {"thick m p10", 0, [](const PictureScore& s) { return s.thickness_m[0]; }},
      {"p50", 0, [](const PictureScore& s) { return s.thickness_m[2]; }},
      {"p90", 0, [](const PictureScore& s) { return s.thickness_m[4]; }},
      {"edge<=1", 2, [](const PictureScore& s) { return s.within_a_cell; }},
      {"p99 m", 0, [](const PictureScore& s) { return s.change_p99_m; }},
      {"spokes 1", 2, [](const PictureScore& s) { return s.spoke_correlation[0]; }},
      {"4", 2, [](const PictureScore& s) { return s.spoke_correlation[2]; }},
      {"16", 2, [](const PictureScore& s) { return s.spoke_correlation[4]; }},
      {"cells 1", 2, [](const PictureScore& s) { return s.range_correlation[0]; }},
      {"4", 2, [](const PictureScore& s) { return s.range_correlation[2]; }}};
  return all;
}

template <typename Columns>
void add_heads(const Columns& columns, TextTable& table) {
  for (const auto& column : columns) table.add(column.name);
}
template <typename Columns, typename Items>
void add_cells(const Columns& columns, const Items& items, TextTable& table) {
  for (const auto& column : columns) table.add(cell(spread_of(items, column.of), column.digits));
}

template <typename Shapes, typename Scores>
std::string curve_table(const Judgement& judgement, const Shapes& shapes, const Scores& scores) {
  TextTable table;
  table.begin("");
  add_heads(shapes, table);
  add_heads(scores, table);
  table.begin(judgement.real.name);
  add_cells(shapes, judgement.real.shapes, table);
  for (const JudgedMethod& method : judgement.methods) {
    table.begin(method.name);
    add_cells(shapes, method.shapes, table);
    add_cells(scores, method.scores, table);
  }
  return table.text();
}

std::string nearest_line(const Judgement& judgement) {
  const auto nearest = [&](const ScoreColumn& column) {
    const JudgedMethod* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const JudgedMethod& method : judgement.methods) {
      const double value = spread_of(method.scores, column.of).mean;
      if (value >= least) continue;
      least = value;
      best = &method;
    }
    return best != nullptr ? fmt::format("{} ({:.{}f})", best->name, least, column.digits)
                           : std::string("none");
  };
  return fmt::format(
      "Nearest to the real coast in dimension: {}; in depth of bays: {}; in width: {};\n"
      "in spectrum: {}; in place (apart, m): {}.\n",
      nearest(curve_scores()[0]), nearest(structure_scores()[0]), nearest(structure_scores()[1]),
      nearest(structure_scores()[2]), nearest(curve_scores()[1]));
}

std::string picture_table(const Judgement& judgement, std::size_t which) {
  const Judgement::Picture& picture = judgement.pictures[which];
  TextTable table;
  table.begin("");
  add_heads(picture_columns(), table);
  for (const RecordedPicture& recorded : kRecordedPictures) {
    table.begin(fmt::format("recorded: {}", recorded.name));
    add_cells(picture_columns(), std::vector{recorded.score}, table);
  }
  const auto add_row = [&](const JudgedMethod& method) {
    table.begin(method.name);
    add_cells(picture_columns(), method.pictures[which], table);
  };
  add_row(judgement.real);
  for (const JudgedMethod& method : judgement.methods) add_row(method);
  std::string text = fmt::format(
      "\nEcho picture at {:g} NM from {:.4f},{:.4f}: {} spokes of {} cells, beam {:g} degrees, "
      "mean of thresholds of a\nquarter and half of full scale.  Recorded: ",
      picture.radar.scale.in_nautical_miles(), picture.place.latitude_deg,
      picture.place.longitude_deg, picture.radar.geometry.spokes_per_turn,
      picture.radar.geometry.cells, picture.radar.beam_deg);
  for (const RecordedPicture& recorded : kRecordedPictures)
    text += fmt::format("{} out to {:.0f} m, beam {:g}; ", recorded.name, recorded.range_m,
                        recorded.beam_deg);
  return text +
         "threshold half.\nD of the echo's outline below R/66 | above R/47, and below | above the "
         "beam on the ground; thickness of the\nfirst echo; leading edge from spoke to spoke: "
         "share "
         "within a cell, p99; correlation by spokes and by cells apart.\n" +
         table.text();
}

}  // namespace

std::string judgement_text(const Judgement& judgement) {
  std::string text = fmt::format(
      "{}, {}: {} edges are left when every {}th vertex is kept, {:.0f} m each in the middle\n"
      "where the fine coast has {:.0f} m; {} seeds, ~ is the deviation over them.\n",
      judgement.coast, judgement.source, judgement.edges, judgement.keep, judgement.chord_m,
      judgement.spacing_m, judgement.seeds);
  for (const JudgedMethod& method : judgement.methods)
    text += fmt::format("  {:25}{}\n", method.name, method.how);
  text +=
      "\nCurves: length, box-count D by scale and its error; how far the curves are apart at the "
      "same\n"
      "place (rms of the difference of their offsets from the chord), where no method that draws "
      "by\n"
      "chance can beat the straight line, since what it adds is not what is missing; and from "
      "each\n"
      "curve to the nearest of the other, which are to be read together: a curve that wanders "
      "comes\n"
      "nearer to the real one and strays farther from it.\n";
  text += curve_table(judgement, curve_columns(judgement), curve_scores());
  text += fmt::format(
      "\nStructure: bays and headlands deeper than {:g} m, half waves in a chord (rms over the\n"
      "chord), and how far their distributions are from the real ones.\n",
      judgement.scales.least_depth_m);
  text += curve_table(judgement, structure_columns(), structure_scores());
  text += '\n' + nearest_line(judgement);
  for (std::size_t i = 0; i < judgement.pictures.size(); ++i) text += picture_table(judgement, i);
  return text;
}

std::string judgement_csv_head() { return "coast,method,seed,picture_nm,measure,value\n"; }

std::string judgement_csv(const Judgement& judgement) {
  std::string text;
  const auto add = [&](const JudgedMethod& method, std::size_t seed, const std::string& picture,
                       const std::string& measure, double value) {
    text += fmt::format("{},\"{}\",{},{},{},{:.6g}\n", judgement.coast, method.name, seed + 1,
                        picture, measure, value);
  };
  const auto add_method = [&](const JudgedMethod& method) {
    for (std::size_t s = 0; s < method.shapes.size(); ++s) {
      const CoastShape& shape = method.shapes[s];
      add(method, s, "", "length_km", shape.length_km);
      for (const ScaleDimension& d : shape.dimensions)
        add(method, s, "", fmt::format("dimension_{:.0f}m", d.scale_m), d.dimension);
      add(method, s, "", "bays_per_km", shape.bays_per_km);
      for (const double part : {0.5, 0.9}) {
        add(method, s, "", fmt::format("depth_p{:.0f}_m", 100.0 * part),
            quantile_of(shape.depths_m, part));
        add(method, s, "", fmt::format("width_p{:.0f}_m", 100.0 * part),
            quantile_of(shape.widths_m, part));
      }
      for (std::size_t k = 0; k < kSpectrumOctaves; ++k)
        add(method, s, "", fmt::format("spectrum_{}", 1 << k), shape.spectrum[k]);
    }
    for (std::size_t s = 0; s < method.scores.size(); ++s) {
      const CoastScore& score = method.scores[s];
      add(method, s, "", "dimension_error", score.dimension_error);
      add(method, s, "", "apart_rms_m", score.apart_rms_m);
      add(method, s, "", "real_to_made_p50_m", score.real_to_made_p50_m);
      add(method, s, "", "real_to_made_p90_m", score.real_to_made_p90_m);
      add(method, s, "", "made_to_real_p50_m", score.made_to_real_p50_m);
      add(method, s, "", "made_to_real_p90_m", score.made_to_real_p90_m);
      add(method, s, "", "depth_distance", score.depth_distance);
      add(method, s, "", "width_distance", score.width_distance);
      add(method, s, "", "spectrum_error", score.spectrum_error);
    }
    for (std::size_t p = 0; p < method.pictures.size(); ++p) {
      const std::string nm =
          fmt::format("{:g}", judgement.pictures[p].radar.scale.in_nautical_miles());
      for (std::size_t s = 0; s < method.pictures[p].size(); ++s) {
        const PictureScore& score = method.pictures[p][s];
        add(method, s, nm, "outline_below_recorded", score.below_recorded);
        add(method, s, nm, "outline_above_recorded", score.above_recorded);
        add(method, s, nm, "outline_below_beam", score.below_beam);
        add(method, s, nm, "outline_above_beam", score.above_beam);
        constexpr int kParts[] = {10, 25, 50, 75, 90};
        for (std::size_t q = 0; q < 5; ++q)
          add(method, s, nm, fmt::format("thickness_p{}_m", kParts[q]), score.thickness_m[q]);
        add(method, s, nm, "edge_within_a_cell", score.within_a_cell);
        add(method, s, nm, "edge_change_p99_m", score.change_p99_m);
        for (std::size_t k = 0; k < kCorrelationLags.size(); ++k) {
          add(method, s, nm, fmt::format("spoke_correlation_{}", kCorrelationLags[k]),
              score.spoke_correlation[k]);
          add(method, s, nm, fmt::format("range_correlation_{}", kCorrelationLags[k]),
              score.range_correlation[k]);
        }
      }
    }
  };
  add_method(judgement.real);
  for (const JudgedMethod& method : judgement.methods) add_method(method);
  return text;
}

}  // namespace skerry::echo
