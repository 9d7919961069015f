// Polygons of GDAL turned into rings of a coast, and what is wrong with them.
#pragma once

#include <string>
#include <vector>

#include <ogr_geometry.h>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gdal/chart_warnings.hpp"
#include "echo/chart/gdal/polygons/tangle.hpp"

namespace skerry::echo {

// The polygons of a geometry, multi-polygons and collections taken apart.
std::vector<const OGRPolygon*> polygons_in(const OGRGeometry& geometry);
// The lines of a geometry likewise.
std::vector<const OGRLineString*> lines_in(const OGRGeometry& geometry);

// The vertices of a line, degrees, x = longitude, without repeated ones.  A closed line keeps its
// last vertex.  A text in `fault` says which vertex is not on the globe; nothing is returned then.
std::vector<GeoPoint> places_on(const OGRSimpleCurve& line, std::string& fault);

// Appends the rings of a polygon: land on the left, holes as level 2 (`level` 1), or, for water
// (`level` 2), holes as level 3.  Edges are shorelines; those along the antimeridian or a pole are
// bin_borders.  A polygon wider than 180 degrees comes in columns (wide_polygon.hpp).  `name` says
// file and object.
// A ring outside the globe, with a vertex that is no number, or with fewer than three places is
// left out, and an outer ring with its holes; one that is not closed is closed by a straight edge;
// one that crosses itself is mended (OGRGeometry::MakeValid), but left out where that could take
// without end (tangle.hpp).  Each is told to `warnings`.  Returns whether any ring was appended.
bool append_polygon(const OGRPolygon& polygon, std::uint8_t level, const std::string& name,
                    std::vector<CoastRing>& rings, ChartWarnings& warnings, TangleBudget& budget);

// Twice the area of a closed ring in square degrees, positive if counter-clockwise.
double twice_area(const OGRLinearRing& ring);

}  // namespace skerry::echo
