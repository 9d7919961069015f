// The shape of sea clutter: how spiky a resolution cell is.
#pragma once

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

}  // namespace skerry::echo
