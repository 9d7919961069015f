#include "echo/chart/gdal/land_polygon.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/gdal_session.hpp"

namespace skerry::echo {
namespace {

// Where a polygon that reaches across it has been cut: no coast there.
bool on_map_margin(GeoPoint a, GeoPoint b) {
  const auto antimeridian = [](GeoPoint p) { return p.longitude_deg == -180.0; };
  const auto pole = [](GeoPoint p) { return std::abs(p.latitude_deg) == 90.0; };
  return (antimeridian(a) && antimeridian(b)) || (pole(a) && pole(b));
}

// Twice the area in square degrees, positive if counter-clockwise; steps never pass the
// antimeridian, which polygons are cut at.
double twice_area(const OGRLinearRing& ring) {
  double sum = 0.0;
  const double x0 = ring.getX(0), y0 = ring.getY(0);
  for (int i = 0, n = ring.getNumPoints(); i < n; ++i) {
    const int j = i + 1 == n ? 0 : i + 1;
    sum += (ring.getX(i) - x0) * (ring.getY(j) - y0) - (ring.getX(j) - x0) * (ring.getY(i) - y0);
  }
  return sum;
}

// Checked, closed by repeating the first vertex as GEOS wants it; empty with the fault told.
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
  if (!fault.empty()) {
    warnings.add(fmt::format("{}: {}; left out", name, fault));
    return nullptr;
  }
  auto sound = std::make_unique<OGRLinearRing>();
  sound->setNumPoints(static_cast<int>(places.size()) + 1);
  for (std::size_t i = 0; i <= places.size(); ++i) {
    const GeoPoint p = places[i % places.size()];
    sound->setPoint(static_cast<int>(i), p.longitude_deg, p.latitude_deg);
  }
  return sound;
}

void append_ring(const OGRLinearRing& ring, std::uint8_t level, bool counter_clockwise,
                 std::vector<CoastRing>& rings) {
  const double area = twice_area(ring);
  if (area == 0.0) return;
  CoastRing out;
  out.level = level;
  const int n = ring.getNumPoints();
  for (int i = 0; i < n; ++i) {
    const int k = (area > 0.0) == counter_clockwise ? i : n - 1 - i;
    const double longitude = ring.getX(k);
    const GeoPoint p{ring.getY(k), longitude >= 180.0 ? longitude - 360.0 : longitude};
    if (out.vertices.empty() || p != out.vertices.back()) out.vertices.push_back(p);
  }
  while (out.vertices.size() > 1 && out.vertices.back() == out.vertices.front())
    out.vertices.pop_back();
  if (out.vertices.size() < 3) return;
  for (std::size_t i = 0; i < out.vertices.size(); ++i) {
    const GeoPoint a = out.vertices[i], b = out.vertices[(i + 1) % out.vertices.size()];
    out.vertex_ids.push_back(identity_of(a));
    out.edges.push_back(on_map_margin(a, b) ? EdgeKind::bin_border : EdgeKind::shoreline);
  }
  rings.push_back(std::move(out));
}

void append_sound_polygon(const OGRPolygon& polygon, std::uint8_t level,
                          std::vector<CoastRing>& rings) {
  const bool land = level % 2 == 1;
  if (polygon.getExteriorRing() == nullptr || polygon.getExteriorRing()->getNumPoints() < 4) return;
  append_ring(*polygon.getExteriorRing(), level, land, rings);
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

void append_polygon(const OGRPolygon& polygon, std::uint8_t level, const std::string& name,
                    std::vector<CoastRing>& rings, ChartWarnings& warnings) {
  if (polygon.getExteriorRing() == nullptr) {
    warnings.add(fmt::format("{}: a polygon without an outer ring; left out", name));
    return;
  }
  OGRPolygon sound;
  auto outer = sound_ring(*polygon.getExteriorRing(), name, warnings);
  if (!outer) return;
  sound.addRingDirectly(outer.release());
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
    if (auto hole = sound_ring(*polygon.getInteriorRing(i), name, warnings))
      sound.addRingDirectly(hole.release());
  }
  GdalErrors errors;
  if (sound.IsValid()) {
    append_sound_polygon(sound, level, rings);
    return;
  }
  const std::string reason = errors.text();
  const std::unique_ptr<OGRGeometry> mended(sound.MakeValid());
  const std::size_t before = rings.size();
  if (mended) {
    for (const OGRPolygon* part : polygons_in(*mended)) append_sound_polygon(*part, level, rings);
  }
  warnings.add(fmt::format(
      "{}: {}; {}", name, reason,
      rings.size() > before ? "mended, its outline differs from the file's" : "left out"));
}

}  // namespace skerry::echo
