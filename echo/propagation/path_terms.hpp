// PathTerms: all that decides a point's echo between antenna and target, in double, term by term.
#pragma once

#include "echo/radar/radar_set.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// What a radar and its weather make of a path.
struct PathConditions {
  double wavelength_m = 0.0319;
  double antenna_height_m = 20.0;
  double effective_earth_m = 8494.7e3;  // k times the Earth's radius
  double wave_height_m = 0.0;           // significant; 4 standard deviations of the surface
  double ducting = 0.0;                 // share of the diffraction loss taken away
  double gas_db_km = 0.0136;            // one way
  friend bool operator==(const PathConditions&, const PathConditions&) = default;
};
PathConditions path_conditions(const RadarSet& set, const Atmosphere& atmosphere,
                               double wave_height_m);

// Gas (oxygen and 7.5 g/m3 of water), dB/km one way: 0.0136 in the X band, 0.0075 in the S band.
// Source: SOURCES.md "Propagation" (P.676 at 9.41 and 3.05 GHz).  Error: 3e-4 dB/km within the
// bands.
double gas_db_per_km(Band band);

// Lower and higher heights count as these.
inline constexpr double kLowestPoint = 0.01, kHighestPoint = 10000.0;  // m
inline constexpr double kNearestPath = 1.0;                            // m

// Nulls are filled to this, one way: the sea is never a perfect mirror.
inline constexpr double kNullFloor = 1e-6;
// Loss beyond which diffraction is not followed, dB one way (scatter by the air takes over; it is
// not modelled).
inline constexpr double kGreatestLossDb = 100.0;

// Clearance of the direct ray over the sea, in radii of the first Fresnel zone, at which the smooth
// Earth begins to cost anything.  Source: ITU-R P.526 section 3.2.
inline constexpr double kFullClearance = 0.552;
// The same as a difference of the two rays in wavelengths: clearance^2 = 2 difference / lambda.
inline constexpr double kFullDifference = 0.5 * kFullClearance * kFullClearance;

// A target has either full clearance, then direct and reflected ray interfere; or less, then the
// interference stays as it was at full clearance while the mirror fades, and the loss of P.526
// grows from 0 to that of the horizon and on beyond it.  The two meet without a step; over a smooth
// sea full clearance is where the lowest lobe is down to 0.9 in voltage.
// For X band, 15 m and 3.5 m, that is at 0.52 of the horizon's range; for 15 m and 60 m at 0.83.
struct PathTerms {
  double difference_m = 0.0;  // of the two rays, 0 beyond the horizon
  double rho = 0.0;           // of the reflected voltage: roughness times divergence, unfaded
  // (1 - clearance / full) times the loss of an Earth so small that the target stands on its
  // horizon, dB one way.  Negative with more than full clearance, where there is no loss: so that
  // tables are smooth across.  Ducting has taken its share.
  double loss_db = 0.0;
};
PathTerms path_terms(const PathConditions& conditions, double range_m, double height_m);

// Two-way power factor of a point by the terms, gas included.  What the tables are held against.
double point_reference(const PathConditions& conditions, double range_m, double height_m);
// Mean of point_reference() from the water up to `height_m`, in steps of a fiftieth of a lobe;
// slow.
double body_reference(const PathConditions& conditions, double range_m, double height_m);

}  // namespace skerry::echo
