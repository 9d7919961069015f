// How like the real coast a refined one is.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "echo/measure/box_count.hpp"

namespace skerry::echo {

// A coast in pieces, each grown between the ends of one edge of a coarser chart: its chord.  Land
// on the left.
using CoastPieces = std::vector<PlaneLine>;

// Limits of a coast's measurement.
struct ScoreScales {
  double smallest_m = 100.0, largest_m = 1600.0;  // boxes, doubled
  double least_depth_m = 10.0;                    // of a bay; what is less is the chart's own error
};

// Spectrum of the offsets from the chord: half waves in a chord, by octaves: 1, 2-3, 4-7.
inline constexpr std::size_t kSpectrumOctaves = 3;

// Measures of one coast.
struct CoastShape {
  double length_km = 0.0;
  std::vector<ScaleDimension> dimensions;
  // Bays and headlands: stretches on one side of the chord.  Depth: the farthest from it; width:
  // along it, from where the coast leaves it to where it comes back.
  std::vector<double> depths_m, widths_m;  // ascending
  double bays_per_km = 0.0;                // of chord
  // Root mean square, over chords, of the amplitudes of the octave's half waves over the chord.
  std::array<double, kSpectrumOctaves> spectrum{};
};

// `chosen`: by piece, whether it counts where offsets from the chord do: has_offsets().
CoastShape shape_of(const CoastPieces& pieces, const ScoreScales& scales,
                    const std::vector<bool>& chosen);

// Pieces whose coast is at most three chords long: others are loops, which have no offset from a
// chord to speak of.
std::vector<bool> has_offsets(const CoastPieces& real);

// The score of one coast beside the real one between the same chords.  Everything is 0 for the
// real coast itself.
struct CoastScore {
  // Root mean square, over places at equal parts of both curves' lengths, of the difference of
  // their offsets from the chord, metres.  No method that draws by chance can beat the straight
  // chord in the mean here: what it adds is independent of what it should be, so their squares add
  // up.  A price to be kept low, not a merit.
  double apart_rms_m = 0.0;
  // Distance from one curve to the nearest of the other within the piece, metres: p50 and p90, from
  // the real one to the made one and back.  To be read together: a curve that wanders comes nearer
  // to the real one and strays farther from it.
  double real_to_made_p50_m = 0.0, real_to_made_p90_m = 0.0;
  double made_to_real_p50_m = 0.0, made_to_real_p90_m = 0.0;
  double dimension_error = 0.0;  // root mean square over scales of the difference of local D
  // Kolmogorov-Smirnov distances between the distributions, 0 .. 1; 1 where there are none.
  double depth_distance = 0.0, width_distance = 0.0;
  // Root mean square over octaves of (made - real) / real amplitude; 1 where there is nothing.
  double spectrum_error = 0.0;
};

// Error: std::invalid_argument where the pieces do not have the same ends, and as box_census().
// `chosen` as for shape_of(): also what counts in apart_rms_m.
CoastScore score_of(const CoastPieces& real, const CoastShape& real_shape, const CoastPieces& made,
                    const CoastShape& made_shape, const std::vector<bool>& chosen);

// Largest difference of the two distribution functions.  Both ascending; 1 where one is empty and
// the other is not, 0 where both are.
double kolmogorov_smirnov(std::span<const double> a, std::span<const double> b);

// Quantile of ascending values; NaN for none.
double quantile_of(std::span<const double> ascending, double part);

}  // namespace skerry::echo
