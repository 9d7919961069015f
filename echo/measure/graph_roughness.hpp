// How rough a graph is: heights at equal steps, as of fractional Brownian motion.
#pragma once

#include <span>
#include <vector>

#include "echo/measure/line_fit.hpp"

namespace skerry::echo {

// Mean of |h(t + lag) - h(t)|^power over a graph, by lag in steps.  Power 2 is the variogram (twice
// the semivariance), 1 the madogram; for fractional Brownian motion both go as lag^(power * H).
struct GraphVariation {
  int lag = 0;
  double mean = 0.0;
};

// At lags 1, 2, 4 ... longest_lag.  Lags that do not fit into the graph are left out.
std::vector<GraphVariation> graph_variation(std::span<const double> heights, double power,
                                            int longest_lag);

// Mean square of second differences h(t) - 2 h(t + lag) + h(t + 2 lag), at lags 1, 2, 4 ...
// longest_lag: goes as lag^(2 H) too, and is blind to a slope of the whole graph, so it may be
// taken of graphs whose ends were pinned.  Source: Istas and Lang (1997).
std::vector<GraphVariation> second_variation(std::span<const double> heights, int longest_lag);

// D = 2 - slope/2 of the variogram and D = 2 - slope of the madogram, in logarithms, over lags 1 to
// longest_lag.  NaN for graphs that are shorter than 32 times the longest lag or nowhere change.
// The standard error is that of a bootstrap of 32 blocks, but never less than what estimates of
// exact fractional Brownian motion scatter by, which blocks do not see where memory is long:
// (0.017 + 0.05 (1.4 - D)) (64 longest_lag / n)^0.2; the interval is twice that to both sides.
// Bias on fractional Brownian motion of 4096 steps, lags to 64: below 0.005 for D 1.4 and 1.25,
// +0.013 for 1.1.  Source: Gneiting, Sevcikova, Percival (2012); SOURCES.md "Fractals".
// Held by GraphRoughness.FindsTheDimensionOfExactFractionalBrownianMotion.
DimensionEstimate variogram_dimension(std::span<const double> heights, int longest_lag = 64);
DimensionEstimate madogram_dimension(std::span<const double> heights, int longest_lag = 64);

// Mean power in an octave of frequencies, f .. 2 f.
struct SpectrumOctave {
  double cycles_per_step = 0.0;  // its geometric middle
  double power = 0.0;            // of a graph of n steps: |sum h exp|^2 / n, averaged
};

// Power spectrum by octaves from 4 cycles in the whole graph up to the Nyquist frequency; the line
// through the graph's ends is taken off first and a Hann window laid on.  Empty for fewer than 32
// heights.  Takes O(n) per frequency, at most 24 frequencies an octave.
std::vector<SpectrumOctave> power_spectrum(std::span<const double> heights);

// Slope of log power over log frequency, -(2 H + 1) = 2 D - 5 for fractional Brownian motion; the
// highest octave, which aliasing lifts, is left out.  `scatter` says how straight it is.
LineFit spectrum_slope(std::span<const SpectrumOctave> spectrum);

}  // namespace skerry::echo
