// Rings on the globe laid out in a plane of longitude and latitude.
#pragma once

#include <string>
#include <vector>

#include <ogr_geometry.h>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// The ring without a jump at the antimeridian, degrees, x = longitude and whole turns.
//  - Each edge goes the shortest way; `doubt` says so of one that could be meant the other way.
//  - A ring with edges from -180 to 180 degrees that means nothing so, as a belt or a cap of the
//    whole Earth, is taken as it is written.
//  - A ring around a pole on its hemisphere is closed by way of the pole along the antimeridian.
// Empty, with the reason in `fault`, for one around the Earth that crosses the equator.
// `places`: at least 3, not closed.
std::vector<OGRRawPoint> laid_ring(const std::vector<GeoPoint>& places, std::string& fault,
                                   std::string& doubt);

// `longitude` in the turn nearest to `x`; the same double where that is the turn it is in.
double near_to(double x, double longitude);

// Shifts the ring by whole turns to where its middle is nearest to that of the box.
void bring_near(const OGREnvelope& box, OGRLinearRing& ring);

// Back on the globe, -180 .. 180 without 180; the same double where x has been given as it is, or
// with at most 12 decimals.
double longitude_of(double x);

}  // namespace skerry::echo
