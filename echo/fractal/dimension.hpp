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

}  // namespace skerry::echo
