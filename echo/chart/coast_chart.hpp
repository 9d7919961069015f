// CoastChart: the shoreline of a window of the Earth, as vertices and edges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// What an edge of a ring is.  Only a shoreline is ever refined or echoed.
enum class EdgeKind : std::uint8_t {
  shoreline,
  bin_border,  // made by closing a polygon along the border of a storage bin; not a coast
};

// What lies on the left of a shoreline edge is what the ring bounds: land for levels 1 and 3, 5, 6,
// water for 2 and 4 (read with reversed direction, so that LAND IS ALWAYS ON THE LEFT).
struct CoastRing {
  std::uint8_t level =
      1;  // 1 land, 2 lake, 3 island in a lake, 4 pond, 5 ice front, 6 grounding line
  std::vector<GeoPoint> vertices;  // closed: the last vertex joins the first; not repeated
  std::vector<EdgeKind> edges;     // edges[i] joins vertices[i] and vertices[i+1 mod n]
  // Identity of each vertex from its integer chart coordinates: the same in neighbouring bins and
  // in every window of the same file.
  std::vector<std::uint64_t> vertex_ids;
};

struct CoastChart {
  GeoPoint centre;
  double radius_m = 0.0;  // everything within it is present; more may be
  std::string source;     // e.g. "GSHHG 2.3.7 full"
  std::vector<CoastRing> rings;
};

}  // namespace skerry::echo
