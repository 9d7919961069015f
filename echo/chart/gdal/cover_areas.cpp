#include "echo/chart/gdal/cover_areas.hpp"

#include <fmt/core.h>

#include "echo/chart/cover_grid.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"

namespace skerry::echo {

std::vector<std::vector<std::vector<GeoPoint>>> areas_in(const OGRGeometry& geometry,
                                                         const std::string& name,
                                                         ChartWarnings& warnings,
                                                         TangleBudget& budget) {
  std::vector<std::vector<std::vector<GeoPoint>>> areas;
  for (const OGRPolygon* polygon : polygons_in(geometry)) {
    std::vector<CoastRing> rings;
    append_polygon(*polygon, 1, name, rings, warnings, budget);
    for (CoastRing& ring : rings) {
      if (ring.level == 1) areas.emplace_back();
      if (!areas.empty()) areas.back().push_back(std::move(ring.vertices));
    }
  }
  return areas;
}

void CoverAreas::add(const OGRGeometry& geometry, LandCover cover, const std::string& name) {
  for (auto& rings : areas_in(geometry, name, warnings_, budget_)) {
    std::size_t vertices = 0;
    double crossings = 0.0;
    for (const std::vector<GeoPoint>& ring : rings) {
      vertices += ring.size();
      crossings += crossings_of(ring);
    }
    if (vertices > kMostCoverVertices - vertices_) {
      warnings_.add(
          fmt::format("{}: more than the {} vertices of land cover a chart may have; left "
                      "out",
                      name, kMostCoverVertices));
      continue;
    }
    if (crossings > static_cast<double>(CoverGrid::kMostCrossings) ||
        crossings > kMostCoverCrossings - crossings_) {
      warnings_.add(
          fmt::format("{}: its outline goes north and south more often than a land cover "
                      "may; left out",
                      name));
      continue;
    }
    vertices_ += vertices;
    crossings_ += crossings;
    sheet_.covers.push_back({cover, std::move(rings)});
  }
}

}  // namespace skerry::echo
