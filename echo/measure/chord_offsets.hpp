// How far a coast stands off the straight lines a coarser chart would draw instead of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "echo/measure/box_count.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Coasts cut by a ruler into chords of one length.
struct ChordOffsets {
  double chord_m = 0.0;
  std::size_t chords = 0;
  // Root mean square of the offset, square to the chord, of the coast's middle (half way by its own
  // length) over the chord's length; and its standard error, from the scatter over the chords.
  // NaN for fewer than two chords.
  double middle_rms = 0.0;
  double middle_error = 0.0;
  // The dimension of the graph of offsets over the chord, each where the coast first passes: D = 2
  // - slope/2 of their variogram of second differences (the ends are pinned) over lags of step_m to
  // a quarter of the chord.  NaN for chords of fewer than 16 steps.  What overhangs becomes a jump,
  // so it reads high on a coast of many narrow bays.
  double graph_dimension = 0.0;
};

// Offset of a line's middle, half way by its own length, from the chord between its ends: square to
// the chord, positive on its left, in chord lengths.  NaN where the ends are one place.
double middle_offset(std::span<const PlanePoint> line);

// Error: std::invalid_argument for lengths that are not positive or a step below 1/4096 of the
// chord.
ChordOffsets chord_offsets(std::span<const PlaneLine> lines, double chord_m, double step_m);

}  // namespace skerry::echo
