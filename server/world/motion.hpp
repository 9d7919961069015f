// Sailing a constant course on the ellipsoid.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

inline constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600.0;  // 1 NM = 1852 m exactly

// `course_deg` in [0, 360); 0 if it is not finite.
double wrapped_course(double course_deg);

// Chord by arc of a circle that turns by twice that angle: sin(x) / x.
double chord_over_arc(double half_turn_deg);

// What can be sailed from `start` along the rhumb line of that true course until a metre is left to
// the pole it leads to; infinite on a parallel.
double rhumb_length_m(GeoPoint start, double course_deg);

// `distance_m` along the rhumb line of that course on WGS-84; negative: astern.  Stops a metre
// short of a pole, beyond which courses mean nothing; a start nearer than that counts as a metre
// off. Error: a few nanometres (GeographicLib::Rhumb).  Cost: 0.5 us.
GeoPoint rhumb_destination(GeoPoint start, double course_deg, double distance_m);

}  // namespace skerry::server
