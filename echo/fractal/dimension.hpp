// Fractal dimension of the refined coast.
#pragma once

namespace skerry::echo {

// The similarity dimension the random Koch edges of a given apex factor tend to: the D that solves
// E[sum of (piece length / edge length)^D] = 1 (Mauldin and Williams 1986), the expectation taken
// over 1024 fixed seeds at half-angle 30 deg.  1 for 0; 1.175 for kMaxApexFactor.
// Error of the expectation: 0.002 in D.
double koch_dimension(double apex_factor);

// The apex factor of dimension `dimension`; outside what the envelope allows the nearest end.
double apex_factor_for_dimension(double dimension);

// The same of regular Koch edges, whose pieces are all alike: 2 (1/3)^D + 2 l^D = 1 with
// l^2 = 1/36 + height^2.  Exact; 1.2533 for kMaxRegularApexFactor.
double regular_koch_dimension(double apex_factor);
double regular_apex_factor_for_dimension(double dimension);

// How far, as part of its length, the middle of an edge stands off it rms, for a curve of dimension
// 1 <= D <= 1.5 that does the same at every scale: the spread s of a Gaussian r that solves
// E[2 (1/4 + r^2)^(D/2)] = 1 (Mauldin and Williams 1986).  0 for D = 1, 0.2295 for 1.15, 0.3975 for
// 1.5.  Error: 1e-6.  Source: SOURCES.md "Fractals".
double self_similar_spread(double dimension);

}  // namespace skerry::echo
