// How tangled the rings of a polygon are, before they are given to GEOS.
#pragma once

#include <cstddef>
#include <string>

#include <ogr_geometry.h>

namespace skerry::echo {

// The cost that the polygons of one chart may have together.  GEOS takes time by the pairs of edges
// whose boxes touch, and time and memory by the places where edges cross: both grow with the square
// of the vertices of a ring that is drawn so, and GEOS cannot be stopped.
struct TangleBudget {
  std::size_t crossings = 5'000;
  std::size_t comparisons = 50'000'000;  // and kComparisonsPerEdge for each edge
};
inline constexpr std::size_t kMostCrossings = 1'000;  // of one polygon
inline constexpr std::size_t kComparisonsPerEdge = 256;

// Empty if GEOS may be given the polygon; what it costs is taken from `budget`.  Otherwise why not.
// Edges of all rings together, straight in x and y.
std::string fault_of_tangle(const OGRPolygon& polygon, TangleBudget& budget);

}  // namespace skerry::echo
