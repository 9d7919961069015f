// The radar equation, normalised to the receiver's noise.
#pragma once

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

inline constexpr double kBoltzmann = 1.380649e-23;                   // J/K, exact
inline constexpr double kNoiseTemperature = 290.0;                   // K, the usual T0
inline constexpr double kEarthRadius = 6371000.0;                    // m, the sphere taken for it
inline constexpr double kEffectiveEarth = kEarthRadius * 4.0 / 3.0;  // m, standard atmosphere

// Depth of a pulse along the range, c tau / 2.
inline double pulse_depth_m(double length_s) { return 0.5 * kLightSpeed * length_s; }
// Within it the receiver is blind: the transmitter fires and the TR cell recovers (SOURCES.md
// "Receiver").
inline double blind_range_m(double length_s) { return pulse_depth_m(length_s + 0.1e-6); }
// Farthest range whose echo is back before the next pulse, c / (2 PRF).
inline double unambiguous_range_m(double prf_hz) { return 0.5 * kLightSpeed / prf_hz; }
// Pulses that strike a point while the beam passes: beam width * PRF / (6 rpm), deg and Hz.
inline double hits_per_scan(double beam_width_deg, double prf_hz, double rpm) {
  return beam_width_deg * prf_hz / (6.0 * rpm);
}

// Received power of 1 m2 at 1 m, watts, beam centre, free space:
// Pt G^2 lambda^2 / ((4 pi)^3 L).  Source: SOURCES.md "Propagation".
double received_watts_of_unit_target(const RadarSet& set);

// Receiver noise k T0 B F, watts.
double noise_watts(const RadarSet& set, const Pulse& pulse);

// Signal over noise of 1 m2 at 1 m; a point at R metres has this times sigma / R^4, a surface of
// constant sigma0 this times a cell area that grows with R, hence R^-3.
double unit_signal_to_noise(const RadarSet& set, const Pulse& pulse);

// Height the smooth Earth hides at `range_m`, metres, for an antenna that high: 0 within the
// antenna's own horizon sqrt(2 ae h), beyond it (R - horizon)^2 / (2 ae) with ae = 4/3 Earth.
// Source: SOURCES.md "Vectors" and "Propagation": 2.2256 NM per root metre.  Error: standard
// atmosphere only.
double hidden_height(double range_m, double antenna_height_m);

// Farthest range at which antenna and target see each other, metres.
double radar_horizon(double antenna_height_m, double target_height_m);

}  // namespace skerry::echo
