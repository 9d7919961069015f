// Output of `skerry coast fit`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/coast_tool/coast_stretches.hpp"

namespace skerry::echo {

// One kind of coast of the area, or all of it.
struct CoastFit {
  std::string name;                // "all", or the kind as a scenario writes it
  std::vector<std::string> kinds;  // keys of the scenario its style is for
  CoastLines coast;
  CoastMeasurement measurement;
  ChosenStyle chosen;
};

std::string_view scenario_name(CoastType type);

// Tables: of scales, of estimates, below the chart's spacing.
std::string fit_text(const CoastFit& fit);

// "{method: midpoint, dimension: 1.33, amplitude: 0.8}"
std::string style_text(const CoastStyle& style);

using StyledStretch = std::pair<CoastStretch, CoastStyle>;
std::string stretches_text(const CoastStretches& found,
                           const std::vector<StyledStretch>& stretches);

// The part of a scenario that says all this; later places win, so they come as along the coast.
std::string scenario_text(const std::vector<CoastFit>& fits,
                          const std::vector<StyledStretch>& stretches);

// A line per scale: kind, scale, boxes, local D, chords, middle offset and its error.  Empty where
// there is none.
std::string scales_csv(const std::vector<CoastFit>& fits);

}  // namespace skerry::echo
