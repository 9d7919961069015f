// The sea's texture: the shape of its K-distribution and the gamma law of that shape.
#pragma once

#include "echo/kernel/clutter_row.hpp"
#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

inline constexpr double kLeastShape = 0.1, kGreatestShape = 30.0;

// Shape nu of the compound K law (gamma texture times exponential speckle), in [0.1, 30]:
// log10 nu = 2/3 log10 psi + 5/8 log10 A - k - 1/3 cos(2 swell), psi cut to 0.1 .. 10 deg, A the
// area of a cell in m2, k 1.39 VV and 2.09 HH; the last term only where there is swell, `swell_deg`
// from its direction.
// Source: Ward; Watts and Wicks 1990 (SOURCES.md "Sea", there marked unverified).  Measured at X
// band; at S it is an extrapolation.  Held by KShape.HasTheVectorsOfTheLaw.
double k_shape(double grazing_deg, double cell_area_m2, Polarisation polarisation);
double k_shape_in_swell(double grazing_deg, double cell_area_m2, Polarisation polarisation,
                        double swell_deg);

// log2 of the unit-mean gamma value of shape nu (cut to 0.1 .. 30) that has the rank of a Gaussian
// one: log2(Q_nu(Phi(x)) / nu), the memoryless transform of Tough and Ward 1999 (SOURCES.md "Sea").
// Error: 0.14 dB; cut at -42 dB below and at rank 1 - 3.4e-6 above; mean 1 within 0.4 %, variance
// 1 / nu within 1.2 %.  Held by GammaLaw.IsTheQuantileWithinItsBound and
// GammaLaw.HasTheMomentsOfTheGamma.
RankLaw gamma_law(double nu);

}  // namespace skerry::echo
