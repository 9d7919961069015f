// CoastFit: how rough a stretch of coast is over scales, and the style that goes on as it does.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "echo/coast_tool/coast_lines.hpp"
#include "echo/fractal/coast_style.hpp"
#include "echo/measure/chord_offsets.hpp"
#include "echo/measure/coast_dimension.hpp"

namespace skerry::echo {

// Slope of log length over log ruler, with the error of the regression.
DimensionEstimate divider_estimate(std::span<const RulerLength> lengths);

struct CoastMeasurement {
  double spacing_m = 0.0;  // mean edge of the chart
  BoxCensus census;
  DimensionEstimate box;
  std::vector<ScaleDimension> octaves;
  // Along the lines that are at least four of the longest ruler; empty if that would be less than
  // four of the shortest.
  std::vector<RulerLength> rulers;
  std::size_t ruled_lines = 0;
  DimensionEstimate divider;
  std::vector<ChordOffsets> chords;
  // log(middle offset / chord) over log(chord), of the chords that sees_chord().
  LineFit offset_trend;

  // Whether the coast and not the chart's straight edges is what shows at a scale.
  bool sees_octave(double scale_m) const { return scale_m >= 1.5 * spacing_m; }
  bool sees_chord(double chord_m) const { return chord_m >= 2.0 * spacing_m; }
};

// Error of measure_coast().
class TooLittleCoast : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Says what is being done: for a terminal.
using Telling = std::function<void(const std::string&)>;

// Boxes of `from_m`, doubled up to `to_m`; rulers of 2 from_m to to_m or a quarter
// of the longest line; chords of 2 from_m, doubled
// up to 2 to_m.  Error: TooLittleCoast where it fills fewer than 8 boxes of the third size, or all
// boxes are finer than the chart.
CoastMeasurement measure_coast(const CoastLines& coast, double from_m, double to_m,
                               const Telling& tell);

// The sizes a chart supports: 100 m by powers of two, the least that is 0.6 of the median edge or
// more; and 32 of that.
double finest_scale_m(const CoastLines& coast);

struct Range95 {
  double value = 0.0, low = 0.0, high = 0.0;
};

// Expected values below the chart's spacing.
//  - Dimension: that of the box count.  Its standard error there is made of its own, of the scatter
//    of the octaves, and of their drift per octave times the octaves from the finest that shows.
//  - Offset of a chord's middle, in chords: from the line through the logarithms; NaN where fewer
//    than three chord lengths show.
Range95 dimension_at(const CoastMeasurement& coast, double scale_m);
Range95 offset_at(const CoastMeasurement& coast, double chord_m);
// The change of D per doubling of the scale, over the octaves that show.
LineFit octave_drift(const CoastMeasurement& coast);

// A style and why.
struct ChosenStyle {
  CoastStyle style;
  double offset = 0.0;             // of the middle of an edge, in edges: asked for
  double offset_made = 0.0;        // what the style makes
  std::vector<std::string> words;  // whole sentences, without full stop
};

// The style whose dimension is `dimension` and whose edges stand out in their middle as `offset`
// says.  Method, where none is asked for: straight below 1.01, random Koch up to what it can,
// midpoint displacement above.  A dimension that the method cannot have becomes the nearest it can,
// with a word.  Rounded to hundredths.  `edges`: how many are made to find the amplitude, which is
// then off by 1 / sqrt(2 edges).
ChosenStyle choose_style(double dimension, double offset, std::optional<CoastMethod> method,
                         int edges = 256);

// Root mean square of the offset of the middles of edges with all the room an edge can have, in
// edges.
double offset_of(const CoastStyle& style, int edges = 256);

}  // namespace skerry::echo
