// How rough the outline of a coast's echo is, by scale.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "echo/measure/box_count.hpp"
#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// Box sizes between which the outline's two regimes are measured, metres.
struct OutlineScales {
  double below_from_m = 0.0, below_to_m = 0.0;
  double above_from_m = 0.0, above_to_m = 0.0;
};

// The scales at which the pictures of SOURCES.md "Pictures (a)" were measured: pictures of 1024
// cells out to `range_m`: R/512 to R/66 and R/47 to R/12, which is 0.05-0.39 and 0.54-2.1 beam
// widths on the ground in the HALO20's picture, 0.06-0.48 and 0.68-2.7 in the 3G's.
OutlineScales recorded_scales(double range_m);

// Split at `beam_m`: from 4 picture elements, where the estimator no longer sees them as such, to
// the beam, and from the beam to four of them.
OutlineScales scales_at_beam(double beam_m, double element_m);

// The radar smears details narrower than beam and pulse, so an outline is smooth there; above, it
// is the coast's and the relief's.
struct OutlineDimension {
  double beam_m = 0.0;  // beam width on the ground at the outline's mean range
  double element_m = 0.0;
  // Slopes between the scales, with their standard errors; NaN where nothing echoes and for scales
  // less than half an octave apart, or below two picture elements.
  double below = 0.0, below_error = 0.0;
  double above = 0.0, above_error = 0.0;
};

struct OutlineDimensions {
  OutlineDimension at_beam;   // by scales_at_beam()
  OutlineDimension recorded;  // by recorded_scales()
  // D by scale, half an octave each, from 2 picture elements to a twelfth of the range.
  std::vector<ScaleDimension> local;
};

// Box-count dimension of the outline of a thresholded coast echo; `range_m` is the range scale.
// The echo is laid into a square grid of elements of one cell (two or more where a turn has over
// 1100 cells), nearest neighbour; connected patches (8 neighbours) of less than the square of the
// beam at the first echoes' mean range, targets and specks, are left out; the outline is all
// elements that miss one of 4 neighbours; a box count is the least of 4 placings of the grid.
// Error: boxes of 2 elements read 0.1 low on smooth outlines, 4 and more 0.02.  Reproduces
// SOURCES.md "Pictures (a)" within 0.02 for HALO20 and 0.02 for the 3G at 1633 m
// (picture_recording_test). std::invalid_argument as require_valid().
OutlineDimensions outline_dimensions(const PictureTurn& turn, const PictureWindow& window,
                                     double range_m);

// The picture elements of an outline: column and row from the north-west, of side x side.
struct OutlinePicture {
  std::uint32_t side = 0;
  double element_m = 1.0;
  std::vector<std::array<std::uint32_t, 2>> elements;
};

// The thresholded coast echo's outline; patches of less than `least_m2` are left out.
OutlinePicture outline_of(const PictureTurn& turn, const PictureWindow& window, double least_m2);

// Number of boxes of `box` elements (2 or more, not necessarily whole) the outline touches.
double boxes_touched(const OutlinePicture& outline, double box);

}  // namespace skerry::echo
