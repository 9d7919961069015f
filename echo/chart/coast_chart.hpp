// CoastChart: the coast of a window of the Earth, as vertices, edges and things that stand on it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "echo/chart/chart_object.hpp"
#include "echo/chart/elevation_grid.hpp"
#include "echo/chart/land_cover.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// The kind of a ring's edge.  Only a shoreline is ever refined or echoed.
enum class EdgeKind : std::uint8_t {
  shoreline,
  bin_border,  // made by closing a polygon along the border of a storage bin; land on both sides
  seam,        // where one chart ends and another begins and they disagree: land ends here without
               // a coast; never refined, echoes no bank
};

// How a coast echoes, by the types of Ji et al. 2016.
enum class CoastType : std::uint8_t {
  unknown,     // the chart does not say: guessed from its shape, else as rocky
  artificial,  // I: quay, mole, wall: straight, sharp, strong
  rocky,       // II: fractal
  sandy,       // III: flat sand or mud: weak, deep, its edge moves with tide and waves
};
inline constexpr int kCoastTypes = 4;

// The chart's facts about a stretch of shoreline.
struct Shore {
  CoastType type = CoastType::unknown;
  float height_m = 0.0f;  // of the face over high water; 0: not charted, as the type has it
  friend bool operator==(const Shore&, const Shore&) = default;
};

// The ring's inside lies on the left of a shoreline edge: land for levels 1 and 3, 5, 6,
// water for 2 and 4 (read with reversed direction, so that LAND IS ALWAYS ON THE LEFT).
struct CoastRing {
  std::uint8_t level =
      1;  // 1 land, 2 lake, 3 island in a lake, 4 pond, 5 ice front, 6 grounding line
  std::vector<GeoPoint> vertices;  // closed: the last vertex joins the first; not repeated
  std::vector<EdgeKind> edges;     // edges[i] joins vertices[i] and vertices[i+1 mod n]
  // Identity of each vertex from its integer chart coordinates: the same in neighbouring bins and
  // in every window of the same file.
  std::vector<std::uint64_t> vertex_ids;
  // Index into CoastChart::shores by edge; empty: Shore{} for all.
  std::vector<std::uint16_t> shores;
};

struct CoastChart {
  GeoPoint centre;
  double radius_m = 0.0;  // everything within it is present; more may be
  std::string source;     // e.g. "GSHHG 2.3.7 full"
  std::vector<CoastRing> rings;
  std::vector<Shore> shores;         // at most 65535; what CoastRing::shores points into
  std::vector<ChartObject> objects;  // what stands on land or in the water
  std::shared_ptr<const ElevationGrid> elevation;  // null: relief is synthesised
  std::vector<CoverArea> covers = {};  // a later one lies over earlier ones; empty: no chart says
};

// The chart's facts about edge `i` of `ring`.
inline Shore shore_of(const CoastChart& chart, const CoastRing& ring, std::size_t i) {
  return ring.shores.empty() ? Shore{} : chart.shores[ring.shores[i]];
}

}  // namespace skerry::echo
