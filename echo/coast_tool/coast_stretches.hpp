// A coast cut into stretches, each measured by itself.
#pragma once

#include <vector>

#include "echo/coast_tool/coast_fit.hpp"

namespace skerry::echo {

struct CoastStretch {
  GeoPoint middle;        // half way along
  double radius_m = 0.0;  // from the middle to its farthest vertex
  double length_m = 0.0;
  DimensionEstimate dimension;  // divider, rulers of 2 from_m to 16 from_m or an eighth of it
  double offset = 0.0;          // middle offset of chords that see through the chart, in chords
  double offset_error = 0.0;
};

struct CoastStretches {
  std::vector<CoastStretch> stretches;
  std::size_t left_out = 0;  // lines shorter than half a stretch
  double left_out_m = 0.0;   // their length
};

// Each line in equal stretches as near to `length_m` as they can be.
CoastStretches measure_stretches(const CoastLines& coast, const LocalPlane& plane, double length_m,
                                 double from_m, const Telling& tell);

}  // namespace skerry::echo
