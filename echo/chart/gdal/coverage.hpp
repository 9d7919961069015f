// Coverage: the area a chart answers for.
#pragma once

#include <vector>

#include "echo/chart/chart_source.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Metres per degree of latitude at the equator, where it is least.
inline constexpr double kLeastMetresPerDegree = 110570.0;

// A box in latitude and longitude that may lie across the antimeridian.
struct GeoBox {
  double south_deg = 90.0, north_deg = -90.0;
  double west_deg = 0.0, width_deg = -1.0;  // negative: empty; 360: all the way round
};

// The box around a closed line; around the whole globe if it encloses a pole.
GeoBox box_around(const std::vector<GeoPoint>& line);
GeoBox box_around(GeoPoint centre, double radius_m);
GeoBox joined(const GeoBox& a, const GeoBox& b);
bool overlap(const GeoBox& a, const GeoBox& b);

// The first ring of a polygon is its outer limit, the others are holes; edges straight in latitude
// and longitude.
using CoveragePolygon = std::vector<std::vector<GeoPoint>>;
struct Coverage {
  std::vector<CoveragePolygon> polygons;  // none: the whole Earth, unless nowhere
  bool nowhere = false;                   // of a chart of objects alone: no place at all
  bool everywhere() const { return polygons.empty() && !nowhere; }
  bool contains(GeoPoint place) const;
  GeoBox box() const;  // empty for nowhere
};

// A chart of a part of the Earth.
class CoveredChart : public ChartSource {
 public:
  virtual const Coverage& coverage() const = 0;
};

}  // namespace skerry::echo
