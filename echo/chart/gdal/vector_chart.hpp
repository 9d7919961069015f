// VectorChart: land drawn by anyone, as GeoJSON or a Shapefile.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/coverage.hpp"

namespace skerry::echo {

// All layers of the file, read once into memory, any reference system brought to WGS-84 (none
// stated: taken to be WGS-84, with a warning).
//  - A polygon is land, its holes water.  An edge goes the shortest way, also across the
//    antimeridian; a belt or a cap of the whole Earth goes from -180 to 180 (laid_ring.hpp).  Edges
//    along the antimeridian, where polygons across it are cut (RFC 7946, 3.1.9), and at the poles
//    are no shore.
//  - Attribute `type`: artificial, rocky, sandy or unknown; `height_m`: of the face.
//  - A feature with attribute `kind` is an object, a point, line or polygon: pier, breakwater,
//    bridge, pontoon, pile, building, landmark, buoy, beacon, rock, reflector or racon.  Its
//    height_m, clearance_m, cross_section_m2, racon (letters) and name count; what is not given is
//    as for an object of an ENC without attributes (object_defaults.hpp).
//  - A polygon of kind `coverage` is the area the chart answers for; land ends at its limit without
//    a coast.  Without one it is the box around all land and a margin of 0.0005 degrees (55 m), or
//    nothing where there are only objects: those are laid over the land of lower charts.
// Names of attributes and their values are told apart by letters only, not by case.
// Bounds: 512 MB, kMostVertices of land and coverage, 200 layers, all refused beyond;
// kMostOutlineVertices and TangleBudget, beyond which objects and polygons are left out with a
// warning.
//
// Thread: load() from any thread.
class VectorChart final : public CoveredChart {
 public:
  // Told in `warnings`: what of land_polygon.hpp, and points and lines without a kind, kinds and
  // types that do not exist, places that cannot be brought to WGS-84; by file, layer and feature
  // number.
  // Error: std::runtime_error naming the file and the reason, also if nothing in it can be used.
  static VectorChart open(const std::filesystem::path& file, std::vector<std::string>& warnings);

  CoastChart load(GeoPoint centre, Length radius) const override {
    return sheet_.window(centre, radius);
  }
  std::string describe() const override { return sheet_.source; }  // "chart harbour.geojson"
  const Coverage& coverage() const override { return sheet_.coverage; }

 private:
  VectorChart() = default;
  ChartSheet sheet_;
};

}  // namespace skerry::echo
