// Attenuation by rain.
#pragma once

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// gamma = k R^alpha, dB/km one way, R in mm/h.  Source: ITU-R P.838-3, equations 1 to 3 and tables
// 1 to 4, for a level path; SOURCES.md "Vectors".  Frequency 1 to 1000 GHz.
struct RainLaw {
  double k = 0.0;
  double alpha = 1.0;
};
RainLaw rain_law(double frequency_hz, Polarisation polarisation);

// dB/km one way; 0 without rain.
double rain_db_per_km(const RainLaw& law, double rate_mm_h);

}  // namespace skerry::echo
