// Areas of land cover out of polygons of GDAL.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <ogr_geometry.h>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/chart_warnings.hpp"
#include "echo/chart/gdal/polygons/tangle.hpp"

namespace skerry::echo {

// Bounds on the covers of one chart; crossings as CoverGrid counts them, at its finest.
inline constexpr std::size_t kMostCoverVertices = 2'000'000;
inline constexpr double kMostCoverCrossings = 50e6;

// The polygons of a geometry, each by its rings: outer, then holes.  Unsound rings are mended or
// left out as by append_polygon() (land_polygon.hpp).
std::vector<std::vector<std::vector<GeoPoint>>> areas_in(const OGRGeometry& geometry,
                                                         const std::string& name,
                                                         ChartWarnings& warnings,
                                                         TangleBudget& budget);

// Fills `sheet.covers`.  What a bound leaves out is told to `warnings`, by `name`.
class CoverAreas {
 public:
  CoverAreas(ChartSheet& sheet, ChartWarnings& warnings, TangleBudget& budget)
      : sheet_(sheet), warnings_(warnings), budget_(budget) {}
  void add(const OGRGeometry& geometry, LandCover cover, const std::string& name);

 private:
  ChartSheet& sheet_;
  ChartWarnings& warnings_;
  TangleBudget& budget_;
  std::size_t vertices_ = 0;
  double crossings_ = 0.0;
};

}  // namespace skerry::echo
