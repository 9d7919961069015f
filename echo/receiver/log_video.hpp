// Log video: decibels over noise as video, and the controls that are offsets on it.
#pragma once

namespace skerry::echo {

inline constexpr double kDecibelsPerOctave = 3.0102999566398120;  // 10 log10(2)

// Threshold over mean noise, dB: 22.9 at gain 0, 10 at 50 (a cell in 33 000 sparkles, a step above
// it), -1.6 at 95 (half of all cells; SOURCES.md "Pictures (h)"), -2.9 at 100.
double threshold_db(double gain);

// Attenuation of the sea control (STC) at a range, dB: 30 log10(Rmax / R), the R^-3 law of surface
// echoes, within Rmax = 8 NM * sea / 100 and 0 beyond; at most kMaxStcDb.  A set attenuates before
// its log amplifier; that is this offset behind it, on echo and noise alike.
// Source: SOURCES.md "Receiver"; "Sets" for the 8 NM.
inline constexpr double kMaxStcDb = 70.0;
double stc_db(double sea, double range_m);

// How far the rain control looks back, metres: a few rain pulses.
inline constexpr double kDifferentiatorLength = 400.0;

}  // namespace skerry::echo
