// Terms of a path over the sea: reflection, interference, diffraction.
#pragma once

#include "echo/radar/radar_set.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// The two rays between an antenna and a point over a smooth round Earth, in line of sight.
struct ReflectionPath {
  double to_mirror_m = 0.0;      // from the antenna to where the sea reflects, along the sea
  double antenna_m = 0.0;        // heights over the plane that touches the Earth there
  double target_m = 0.0;         //
  double difference_m = 0.0;     // by which the reflected ray is longer
  double sine_of_grazing = 0.0;  // of the angle at which it strikes
  double divergence = 1.0;       // factor on its voltage by the Earth's roundness, (0, 1]
};

// Requires range_m > 0, heights > 0 and the target within the horizon of both,
// sqrt(2 ae) (sqrt h1 + sqrt h2).  Source: SOURCES.md "Propagation"; the mirror is the root of
// Fermat's cubic 2 x^3 - 3 d x^2 + (d^2 - 2 ae (h1 + h2)) x + 2 ae h1 d = 0, the divergence (1 + 2
// d1 d2 / (ae d sin psi))^-1/2 (Kerr 1951, unverified). Error: the Earth as a parabola: heights of
// 1e-6 of themselves within 400 km.
ReflectionPath reflection_path(double range_m, double antenna_height_m, double target_height_m,
                               double effective_earth_m);

// The share of the reflected voltage that a rough sea leaves.  g = 2 pi sigma_h sin(psi) / lambda,
// sigma_h the standard deviation of the surface (a quarter of the significant wave height). Ament:
// exp(-2 g^2).  Miller, Brown, Vegh: exp(-2 g^2) I0(2 g^2), nearer to what is measured where the
// sea is rough; it is the one in use.  Source: SOURCES.md "Propagation".  Error of I0: 5e-7
// relative.
double ament_roughness(double g);
double miller_brown_roughness(double g);

// Power one way of direct and reflected ray against the direct one alone: |1 - rho exp(-i
// phase)|^2. The sea turns the phase by half a turn: Gamma = -1, good for HH at all grazing angles
// of a ship's radar and for VV below half a degree (15 % low in voltage there).
double two_ray_power(double rho, double difference_m, double wavelength_m);

// Loss of a knife edge, dB one way, for the edge's height v in units of the Fresnel parameter.
// 0 below v = -0.78.  Source: ITU-R P.526, single knife edge; SOURCES.md "Vectors": J(0) = 6.03,
// J(1) = 13.93, J(2.4) = 20.54 dB.
double knife_edge_loss_db(double v);

// v of an edge `height_m` over the straight line between two points `to_edge_m` and `beyond_m` from
// it (both > 0): h sqrt(2 (d1 + d2) / (lambda d1 d2)).
double fresnel_parameter(double height_m, double to_edge_m, double beyond_m, double wavelength_m);

// Loss of the smooth Earth against free space, dB one way, beyond the horizon.  Source: ITU-R P.526
// section 3 with beta = 1 (over sea at 3 and 9 GHz).  Requires range and heights > 0.
// Error: the first term of a series, good beyond the horizon; within it, it means nothing (it
// may be negative) and is used only as P.526 section 3.2 does, see path_terms.hpp.
double smooth_earth_loss_db(double range_m, double antenna_height_m, double target_height_m,
                            double wavelength_m, double effective_earth_m);

// Conditions of a path: the radar and its weather.
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
