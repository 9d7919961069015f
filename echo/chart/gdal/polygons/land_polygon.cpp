#include "echo/chart/gdal/polygons/land_polygon.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/gdal_session.hpp"
#include "echo/chart/gdal/polygons/laid_ring.hpp"
#include "echo/chart/gdal/polygons/wide_polygon.hpp"

namespace skerry::echo {
namespace {

// A margin where a polygon that reaches across has been cut is no coast.
bool on_map_margin(GeoPoint a, GeoPoint b) {
  const auto antimeridian = [](GeoPoint p) { return p.longitude_deg == -180.0; };
  const auto pole = [](GeoPoint p) { return std::abs(p.latitude_deg) == 90.0; };
  return (antimeridian(a) && antimeridian(b)) || (pole(a) && pole(b));
}

// Checked, laid out, closed by repeating the first vertex as GEOS wants it; null with the fault
// told.
std::unique_ptr<OGRLinearRing> sound_ring(const OGRLinearRing& ring, const std::string& name,
                                          ChartWarnings& warnings) {
  std::string fault;
  std::vector<GeoPoint> places = places_on(ring, fault);
  if (fault.empty() && places.size() > 1 && places.back() == places.front()) {
    places.pop_back();
  } else if (fault.empty() && places.size() >= 3) {
    warnings.add(fmt::format(
        "{}: a ring is not closed; closed from latitude {:.6f}, longitude {:.6f} straight to "
        "latitude {:.6f}, longitude {:.6f}",
        name, places.back().latitude_deg, places.back().longitude_deg, places.front().latitude_deg,
        places.front().longitude_deg));
  }
  if (fault.empty() && places.size() < 3)
    fault = fmt::format("a ring of {} places bounds nothing", places.size());
  std::vector<OGRRawPoint> laid;
  if (fault.empty()) {
    std::string doubt;
    laid = laid_ring(places, fault, doubt);
    if (!doubt.empty()) warnings.add(fmt::format("{}: {}", name, doubt));
  }
  if (!fault.empty()) {
    warnings.add(fmt::format("{}: {}; left out", name, fault));
    return nullptr;
  }
  auto sound = std::make_unique<OGRLinearRing>();
  sound->setPoints(static_cast<int>(laid.size()), laid.data());
  sound->addPoint(laid.front().x, laid.front().y);
  return sound;
}

// False where nothing is left of it.
bool append_ring(const OGRLinearRing& ring, std::uint8_t level, bool counter_clockwise,
                 std::vector<CoastRing>& rings) {
  const double area = twice_area(ring);
  if (area == 0.0) return false;
  CoastRing out;
  out.level = level;
  const int n = ring.getNumPoints();
  for (int i = 0; i < n; ++i) {
    const int k = (area > 0.0) == counter_clockwise ? i : n - 1 - i;
    const GeoPoint p{ring.getY(k), longitude_of(ring.getX(k))};
    if (out.vertices.empty() || p != out.vertices.back()) out.vertices.push_back(p);
  }
  while (out.vertices.size() > 1 && out.vertices.back() == out.vertices.front())
    out.vertices.pop_back();
  if (out.vertices.size() < 3) return false;
  for (std::size_t i = 0; i < out.vertices.size(); ++i) {
    const GeoPoint a = out.vertices[i], b = out.vertices[(i + 1) % out.vertices.size()];
    out.vertex_ids.push_back(identity_of(a));
    const bool border = on_map_margin(a, b) || on_column_border(a, b);
    out.edges.push_back(border ? EdgeKind::bin_border : EdgeKind::shoreline);
  }
  rings.push_back(std::move(out));
  return true;
}

void append_sound_polygon(const OGRPolygon& polygon, std::uint8_t level, const std::string& name,
                          std::vector<CoastRing>& rings, ChartWarnings& warnings) {
  const bool land = level % 2 == 1;
  const OGRLinearRing* outer = polygon.getExteriorRing();
  if (outer == nullptr || outer->getNumPoints() < 4 || !append_ring(*outer, level, land, rings)) {
    warnings.add(fmt::format("{}: an outer ring bounds nothing; left out, with its holes", name));
    return;
  }
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
    append_ring(*polygon.getInteriorRing(i), static_cast<std::uint8_t>(level + 1), !land, rings);
}

}  // namespace

std::vector<const OGRPolygon*> polygons_in(const OGRGeometry& geometry) {
  std::vector<const OGRPolygon*> found;
  const auto type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    found.push_back(geometry.toPolygon());
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
      const auto inner = polygons_in(*part);
      found.insert(found.end(), inner.begin(), inner.end());
    }
  }
  return found;
}

std::vector<const OGRLineString*> lines_in(const OGRGeometry& geometry) {
  std::vector<const OGRLineString*> found;
  const auto type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbLineString) {
    found.push_back(geometry.toLineString());
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
      const auto inner = lines_in(*part);
      found.insert(found.end(), inner.begin(), inner.end());
    }
  }
  return found;
}

std::vector<GeoPoint> places_on(const OGRSimpleCurve& line, std::string& fault) {
  std::vector<GeoPoint> places;
  places.reserve(static_cast<std::size_t>(line.getNumPoints()));
  for (int i = 0; i < line.getNumPoints(); ++i) {
    const GeoPoint p{line.getY(i), line.getX(i)};
    if (!(std::abs(p.latitude_deg) <= 90.0) || !(std::abs(p.longitude_deg) <= 180.0)) {
      fault = fmt::format(
          "vertex {} lies at latitude {}, longitude {}; expected at most 90 and 180 degrees", i,
          p.latitude_deg, p.longitude_deg);
      return {};
    }
    if (places.empty() || p != places.back()) places.push_back(p);
  }
  return places;
}

bool append_polygon(const OGRPolygon& polygon, std::uint8_t level, const std::string& name,
                    std::vector<CoastRing>& rings, ChartWarnings& warnings, TangleBudget& budget) {
  if (polygon.getExteriorRing() == nullptr) {
    warnings.add(fmt::format("{}: a polygon without an outer ring; left out", name));
    return false;
  }
  OGRPolygon sound;
  auto outer = sound_ring(*polygon.getExteriorRing(), name, warnings);
  if (!outer) return false;
  OGREnvelope around;
  outer->getEnvelope(&around);
  sound.addRingDirectly(outer.release());
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
    if (auto hole = sound_ring(*polygon.getInteriorRing(i), name, warnings)) {
      bring_near(around, *hole);
      sound.addRingDirectly(hole.release());
    }
  }
  if (const std::string fault = fault_of_tangle(sound, budget); !fault.empty()) {
    warnings.add(fmt::format("{}: {}; left out", name, fault));
    return false;
  }
  GdalErrors errors;
  const bool valid = sound.IsValid() != 0;
  const bool wide = around.MaxX - around.MinX > kGreatestWidth;
  const std::size_t before = rings.size();
  if (valid && !wide) {
    append_sound_polygon(sound, level, name, rings, warnings);
    return rings.size() > before;
  }
  const std::string reason = errors.text();
  const std::unique_ptr<OGRGeometry> parts(wide ? in_columns(sound).release() : sound.MakeValid());
  if (parts) {
    for (const OGRPolygon* part : polygons_in(*parts))
      append_sound_polygon(*part, level, name, rings, warnings);
  }
  const bool any = rings.size() > before;
  if (!valid || !any)
    warnings.add(fmt::format("{}: {}; {}", name, valid ? errors.text() : reason,
                             any ? "mended, its outline differs from the file's" : "left out"));
  return any;
}

double twice_area(const OGRLinearRing& ring) {
  double sum = 0.0;
  const double x0 = ring.getX(0), y0 = ring.getY(0);
  for (int i = 0, n = ring.getNumPoints(); i < n; ++i) {
    const int j = i + 1 == n ? 0 : i + 1;
    sum += (ring.getX(i) - x0) * (ring.getY(j) - y0) - (ring.getX(j) - x0) * (ring.getY(i) - y0);
  }
  return sum;
}

}  // namespace skerry::echo
