#include "echo/coast_tool/judge_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace skerry::echo {
namespace {

std::string words_of(const CoastStyle& style) {
  std::string text = fmt::format("D {:.2f}", style.dimension);
  if (style.amplitude != 1.0) text += fmt::format(", amplitude {:.2f}", style.amplitude);
  if (style.method == CoastMethod::weierstrass) text += fmt::format(", gamma {:g}", style.gamma);
  return text;
}

Contestant printed_by(std::string name, CoastMethod method) {
  as_printed::Parameters parameters;
  parameters.method = method;
  parameters.iterations = 3;
  parameters.threshold_px = 10.0;
  parameters.most_points = 5'000'000;
  return {std::move(name), parameters};
}

struct Named {
  Contestant contestant;
  std::string how;
};

// The roughness of the thinned coast, which is all that a method is shown.
std::optional<CoastMeasurement> measured(const ThinnedCoast& coast, const CoastArea& area,
                                         const Telling& tell) {
  try {
    const CoastLines lines = coast_lines(coast.coarse(), LocalPlane(area.centre()), area);
    const double from = finest_scale_m(lines);
    return measure_coast(lines, from, 32.0 * from, tell);
  } catch (const TooLittleCoast&) {
    return std::nullopt;
  }
}

std::vector<Named> contestants_for(const ThinnedCoast& coast, const CoastArea& area,
                                   const Telling& tell) {
  std::vector<Named> all;
  const auto add = [&](std::string name, const CoastStyle& style, std::string how) {
    all.push_back({{std::move(name), style}, std::move(how)});
  };
  add("conventional", {.method = CoastMethod::straight, .dimension = 1.0},
      "the thinned chart's straight edges");
  add("random Koch, default", {}, words_of({}));
  const auto measurement = measured(coast, area, tell);
  for (const CoastMethodRow& row : coast_methods()) {
    if (row.method == CoastMethod::straight) continue;
    CoastStyle style{.method = row.method, .dimension = std::min(1.3, row.greatest_dimension)};
    if (measurement) {
      const Range95 offset = offset_at(*measurement, measurement->spacing_m);
      style = choose_style(measurement->box.dimension, offset.value, row.method).style;
    }
    add(fmt::format("{}, {}", row.label, measurement ? "fitted" : "unfitted"), style,
        words_of(style));
  }
  all.push_back({printed_by("printed: random Koch", CoastMethod::random_koch),
                 "as printed, c 15, L 10 pixels, 3 iterations"});
  all.push_back({printed_by("printed: fBm", CoastMethod::midpoint),
                 "as printed, H 0.6, sigma of the points' heights, L 10, 3 iterations"});
  all.push_back({printed_by("printed: WMF", CoastMethod::weierstrass),
                 "as printed, D = gamma = 1.5, phases 0, L 10, 3 iterations"});
  return all;
}

double median_edge(const CoastPieces& pieces) {
  std::vector<double> lengths;
  for (const PlaneLine& line : pieces) {
    for (std::size_t i = 1; i < line.size(); ++i)
      lengths.push_back(length_of(line[i] - line[i - 1]));
  }
  std::sort(lengths.begin(), lengths.end());
  return quantile_of(lengths, 0.5);
}

}  // namespace

Judgement judge(const CoastChart& chart, const CoastArea& area, const JudgeOptions& options,
                const Telling& tell) {
  tell("thinning the coast");
  ThinnedCoast coast(chart, area, options.keep);
  Judgement result;
  result.coast = area.name;
  result.source = chart.source;
  result.keep = options.keep;
  result.seeds = options.seeds;
  result.edges = coast.real().size();
  result.spacing_m = median_edge(coast.real());
  result.chord_m = median_edge(coast.chords());
  // The same as finest_scale_m() of the fine coast.
  result.scales.smallest_m = 100.0;
  while (result.scales.smallest_m < 0.6 * result.spacing_m) result.scales.smallest_m *= 2.0;
  while (result.scales.smallest_m > 1.2 * result.spacing_m) result.scales.smallest_m *= 0.5;
  result.scales.largest_m = 16.0 * result.scales.smallest_m;
  result.scales.least_depth_m = std::max(1.0, 0.1 * result.spacing_m);

  for (const double nm : options.scales_nm) {
    const auto scale = RangeScale::find(nm);
    if (!scale) throw std::invalid_argument(fmt::format("{:g} NM is no range scale", nm));
    const auto place = place_afloat(coast, area, *scale);
    if (!place)
      throw std::runtime_error(fmt::format(
          "no place afloat in {} has its nearest shore at a fifth to a third of {:g} NM; take "
          "another area or range, or --no-pictures",
          area.limits(), nm));
    result.pictures.push_back({{.scale = *scale, .beam_deg = options.beam_deg}, *place});
  }

  const std::vector<bool> chosen = has_offsets(coast.real());
  result.real.name = "real coast, held back";
  result.real.shapes = {shape_of(coast.real(), result.scales, chosen)};
  for (const Judgement::Picture& picture : result.pictures) {
    tell(fmt::format("picture of the real coast at {:g} NM",
                     picture.radar.scale.in_nautical_miles()));
    result.real.pictures.push_back({score_of_fine(coast, picture.place, picture.radar)});
  }
  for (const Named& named : contestants_for(coast, area, tell)) {
    JudgedMethod method{named.contestant.name, named.how, {}, {}, {}};
    method.pictures.resize(result.pictures.size());
    const int seeds = named.contestant.random() ? options.seeds : 1;
    for (int seed = 1; seed <= seeds; ++seed) {
      tell(fmt::format("{}, seed {} of {}", named.contestant.name, seed, seeds));
      const auto chance = static_cast<std::uint64_t>(seed);
      const CoastPieces made = coast.drawn_by(named.contestant, chance, options.detail_m);
      method.shapes.push_back(shape_of(made, result.scales, chosen));
      method.scores.push_back(
          score_of(coast.real(), result.real.shapes.front(), made, method.shapes.back(), chosen));
      for (std::size_t i = 0; i < result.pictures.size(); ++i) {
        method.pictures[i].push_back(score_of_drawn(
            coast, named.contestant, chance, result.pictures[i].place, result.pictures[i].radar));
      }
    }
    result.methods.push_back(std::move(method));
  }
  return result;
}

}  // namespace skerry::echo
