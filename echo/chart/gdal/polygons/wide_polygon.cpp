#include "echo/chart/gdal/polygons/wide_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"

namespace skerry::echo {
namespace {

constexpr std::array kInner = {-91.234567, 0.765433, 90.765433};
constexpr double kOnBorder = 1e-9;  // degrees; GEOS places crossings to some 1e-14

std::unique_ptr<OGRPolygon> column(double west, double east) {
  OGRLinearRing ring;
  ring.addPoint(west, -91.0);
  ring.addPoint(east, -91.0);
  ring.addPoint(east, 91.0);
  ring.addPoint(west, 91.0);
  ring.closeRings();
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRing(&ring);
  return polygon;
}

// The outer ring mended, without what any hole holds in any turn.
std::unique_ptr<OGRGeometry> taken_apart(const OGRPolygon& polygon) {
  OGRPolygon outer;
  outer.addRingDirectly(polygon.getExteriorRing()->clone());
  std::unique_ptr<OGRGeometry> left(outer.MakeValid());
  for (const double turn : {-360.0, 0.0, 360.0}) {
    OGRMultiPolygon holes;
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
      OGRLinearRing ring(*polygon.getInteriorRing(i));
      for (int k = 0; k < ring.getNumPoints(); ++k)
        ring.setPoint(k, ring.getX(k) + turn, ring.getY(k));
      OGRPolygon hole;
      hole.addRing(&ring);
      holes.addGeometry(&hole);
    }
    const std::unique_ptr<OGRGeometry> water(holes.MakeValid());
    if (!left || !water) return nullptr;
    left.reset(left->Difference(water.get()));
  }
  return left;
}

// Puts vertices that GEOS made on the border, on the grid of the chart.
void settle(OGRPolygon& polygon, double west, double east) {
  for (OGRLinearRing* ring : polygon) {
    for (int i = 0; i < ring->getNumPoints(); ++i) {
      for (const double border : {west, east}) {
        if (std::abs(ring->getX(i) - border) > kOnBorder) continue;
        const double y = std::round(ring->getY(i) * kStepsPerDegree) / kStepsPerDegree;
        ring->setPoint(i, border, y);
      }
    }
  }
}

}  // namespace

std::unique_ptr<OGRGeometry> in_columns(const OGRPolygon& polygon) {
  std::unique_ptr<OGRGeometry> whole(polygon.IsValid() ? polygon.clone()
                                                       : taken_apart(polygon).release());
  if (!whole) return nullptr;
  OGREnvelope box;
  whole->getEnvelope(&box);
  auto parts = std::make_unique<OGRMultiPolygon>();
  double west = -540.0;
  for (const double turn : {-360.0, 0.0, 360.0}) {
    for (const double border : {kInner[0], kInner[1], kInner[2], 180.0}) {
      const double east = border + turn;
      if (box.MinX < east && box.MaxX > west) {
        const std::unique_ptr<OGRGeometry> cut(whole->Intersection(column(west, east).get()));
        if (!cut) return nullptr;
        for (const OGRPolygon* part : polygons_in(*cut)) {
          OGRPolygon settled(*part);
          settle(settled, west, east);
          parts->addGeometry(&settled);
        }
      }
      west = east;
    }
  }
  return parts;
}

bool on_column_border(GeoPoint a, GeoPoint b) {
  return a.longitude_deg == b.longitude_deg &&
         std::find(kInner.begin(), kInner.end(), a.longitude_deg) != kInner.end();
}

}  // namespace skerry::echo
