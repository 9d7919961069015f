// CoastLines: the shoreline of an area as lines on a plane.
#pragma once

#include <optional>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/coast_tool/coast_area.hpp"
#include "echo/measure/box_count.hpp"

namespace skerry::echo {

// Shoreline edges whose middle lies in the area, joined where rings of neighbouring storage bins
// have the same vertex; land on the left.  The first point of a line that closes is repeated at its
// end.  Bin borders and seams are no coast and left out.
struct CoastLines {
  std::vector<PlaneLine> lines;
  std::size_t edges = 0;
  double length_m = 0.0;
  // The median length of an edge, metres.
  double median_spacing_m = 0.0;
  double mean_spacing_m = 0.0;
  double p90_spacing_m = 0.0;
};

// `type`: only shore that the chart says is of this type.
CoastLines coast_lines(const CoastChart& chart, const LocalPlane& plane, const CoastArea& area,
                       std::optional<CoastType> type = std::nullopt);

// A stretch of a line, from one place along it to another.
PlaneLine stretch_of(const PlaneLine& line, double from_m, double to_m);

}  // namespace skerry::echo
