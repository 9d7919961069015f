// The Weierstrass-Mandelbrot function as a plain sum of its terms, in double.
#pragma once

#include <cstdint>

#include "echo/fractal/coast_style.hpp"

namespace skerry::echo {

// W(t) = sum over n = first .. last of gamma^(-(2-D) n) [cos phi_n - cos(gamma^n t + phi_n)],
// t in radians of term 0, with phi_n = 0 (cosine) or from `seed` (random); for `alternating` the
// sine series of phi_n = n pi: sum of (-1)^n gamma^(-(2-D) n) sin(gamma^n t).
// Both ends infinite, W(gamma t) = gamma^(2-D) W(t) (the sine series: minus that).
// gamma > 1, 1 <= dimension < 2, first <= last.
// Source: Ji et al. 2016 section 2; Berry and Lewis 1980; SOURCES.md "Fractals", "Corrections 9".
struct WeierstrassSeries {
  double gamma = 1.5;
  double dimension = 1.5;
  SeriesPhases phases = SeriesPhases::cosine;
  std::uint64_t seed = 0;
  int first = -40;
  int last = 60;
};

// Terms whose phase is 2^53 radians or more are left out: a double no longer has that phase.
// Error: high_tail_bound() of the last term kept, plus 2^-50 gamma^n |t| radians of phase.
double weierstrass(const WeierstrassSeries& series, double t);

// Bounds of what the terms above `last` and those below `first` add up to at most.
double high_tail_bound(double gamma, double dimension, int last);
double low_tail_bound(double gamma, double dimension, int first, double t);

// Phase of term n of a random series, one of 256 round the circle, as a binary angle (2^32 = one
// turn).
std::uint32_t random_phase(std::uint64_t seed, int n);

}  // namespace skerry::echo
