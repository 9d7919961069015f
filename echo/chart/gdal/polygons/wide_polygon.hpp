// Polygons that are too wide for the shortest way between two vertices to be meant.
#pragma once

#include <memory>

#include <ogr_geometry.h>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

inline constexpr double kGreatestWidth = 180.0;  // degrees

// The polygon, as laid_ring() lays it, in columns of about 90 degrees of longitude between -180 and
// 180 and their like a turn away; holes are taken out wherever they lie on the globe.  Rings that
// are not sound are mended.  Null if GEOS cannot.
std::unique_ptr<OGRGeometry> in_columns(const OGRPolygon& polygon);

// Whether an edge lies on a border between columns other than the antimeridian: on one and the same
// meridian of -91.234567, 0.765433 and 90.765433 degrees, where nobody draws a coast.
bool on_column_border(GeoPoint a, GeoPoint b);

}  // namespace skerry::echo
