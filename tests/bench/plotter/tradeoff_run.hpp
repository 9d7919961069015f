// What a plotter's choices cost and are worth, on the same rendered video.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "server/plotter/judge/track_score.hpp"
#include "server/plotter/plotter.hpp"
#include "tests/bench/plotter/scenes.hpp"

namespace skerry::bench {

struct PlotterChoice {
  std::string group, name;
  server::Plotter::Rule rule;
};

// Costs are CPU times, medians over turns; a floor is what a radar's cell costs at least
// (bench_support.hpp), measured in the same turn.
struct ChoiceOutcome {
  double ns_per_cell = 0.0, floors = 0.0;      // of extraction, over the radar's cells
  double followed = 0.0, us_per_target = 0.0;  // of tracking, for each one followed and turn
  double plots = 0.0;                          // a turn
  server::SceneScore score;                    // from the second minute on
};

// Every choice gets the same spokes, of `minutes` of the scene.  In the order of `choices`.
std::vector<ChoiceOutcome> try_choices(const PlotterScene& scene, double minutes,
                                       std::span<const PlotterChoice> choices,
                                       const echo::ChartSource& chart);

}  // namespace skerry::bench
