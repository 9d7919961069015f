// Mean reflectivity of the sea, the wind that raises it and how it looks from up- and downwind.
#pragma once

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// sigma0, a power ratio, averaged over the wind's direction; holds the propagation factor F^4, so
// that lobing is never applied to it again.
// NRL's five-coefficient model (Gregers-Hansen and Mital 2012, NRL/MR/5310-12-9346, DTIC ADA559494;
// SOURCES.md "Sea").  Domain: 0.5 to 35 GHz, grazing 0.1 to 60 deg, sea state 0 to 6.  Below 0.1
// deg its slope is extrapolated down to 1e-4 deg, above 60 deg the value at 60 is kept, states
// beyond 0 to 6 are cut to it. Error: against Nathanson's measurements at 3 and 9.3 GHz, 0.1 to 10
// deg, 2.0 dB in the mean; held by NrlSea.IsWithinThreeDecibelsOfNathansonInTheMean.
double sea_reflectivity(double frequency_hz, Polarisation polarisation, double grazing_deg,
                        double sea_state);

// Directional spread a of the wind: the reflectivity at an angle phi from upwind is the mean times
// exp(a cos phi) / I0(a), the factor Au of GIT (Horst, Dyer, Tuley 1978; SOURCES.md "Sea") over its
// own mean over all directions, so that NRL's mean stays what it is.  a = 0.2 (1 - 2.8 psi) (lambda
// + 0.015)^-0.4, 0 from psi = 0.357 rad on.  X band at 1 deg: 5.62 dB from down- to upwind.
double wind_spread(double wavelength_m, double grazing_rad);

// Modified Bessel function I0 by its series; relative error 1e-15 for |x| <= 20.
double bessel_i0(double x);

inline constexpr double kGravity = 9.80665;  // m/s2

// Wind that raises a sea, m/s: 3.16 SS^0.8 (GIT; SOURCES.md "Sea").
double wind_of_sea_state(double sea_state);

// Sine of the grazing angle at the water `range_m` off an antenna that high over an Earth of radius
// `effective_earth_m`; 0 or less beyond the horizon, at most 1.  SOURCES.md "Propagation".
double sine_of_grazing(double range_m, double antenna_height_m, double effective_earth_m);

}  // namespace skerry::echo
