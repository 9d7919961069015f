// Where ships are a little after they were told of.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// A straight line on a sphere of one minute a mile: for some seconds.  `course_deg` true, metres.
GeoPoint moved(GeoPoint from, double course_deg, double distance_m);

}  // namespace skerry::server
