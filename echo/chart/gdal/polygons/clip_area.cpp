#include "echo/chart/gdal/polygons/clip_area.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <unordered_map>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/gdal_session.hpp"
#include "echo/chart/gdal/polygons/laid_ring.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"
#include "echo/chart/gdal/polygons/tangle.hpp"

namespace skerry::echo {
namespace {

constexpr double kOnEdge = 1e-9;  // degrees; GEOS places crossings to some 1e-14

// Laid side by side without a jump; a ring around a pole is closed by way of the pole, with three
// points more, and has the meridian in its middle.
std::vector<OGRRawPoint> laid_out(const std::vector<GeoPoint>& ring, double meridian) {
  std::vector<OGRRawPoint> laid;
  laid.reserve(ring.size() + 3);
  double x = meridian, south = 90.0;
  for (const GeoPoint p : ring) {
    x = near_to(x, p.longitude_deg);
    laid.emplace_back(x, p.latitude_deg);
    south = std::min(south, p.latitude_deg);
  }
  const double closing = near_to(x, ring.front().longitude_deg);
  if (closing != laid.front().x) {
    const double pole = laid.front().y < 0.0 && south < 0.0 ? -90.0 : 90.0;
    const double first = laid.front().x;
    laid.emplace_back(closing, laid.front().y);
    laid.emplace_back(closing, pole);
    laid.emplace_back(first, pole);
    const double middle = 0.5 * (first + closing), off = near_to(meridian, middle) - middle;
    for (OGRRawPoint& p : laid) p.x += off;
  }
  return laid;
}

// The same ring, begun as far from the meridian as may be.
CoastRing begun_far_from(double meridian, const CoastRing& ring) {
  const auto distance = [&](const GeoPoint& p) {
    return std::abs(wrapped_longitude(std::fmod(p.longitude_deg - meridian, 360.0)));
  };
  const auto first = std::max_element(
      ring.vertices.begin(), ring.vertices.end(),
      [&](const GeoPoint& a, const GeoPoint& b) { return distance(a) < distance(b); });
  const std::ptrdiff_t by = first - ring.vertices.begin();
  CoastRing turned = ring;
  std::rotate(turned.vertices.begin(), turned.vertices.begin() + by, turned.vertices.end());
  std::rotate(turned.vertex_ids.begin(), turned.vertex_ids.begin() + by, turned.vertex_ids.end());
  std::rotate(turned.edges.begin(), turned.edges.begin() + by, turned.edges.end());
  if (!turned.shores.empty())
    std::rotate(turned.shores.begin(), turned.shores.begin() + by, turned.shores.end());
  return turned;
}

std::unique_ptr<OGRPolygon> polygon_of(const std::vector<OGRRawPoint>& laid) {
  auto ring = std::make_unique<OGRLinearRing>();
  ring->setPoints(static_cast<int>(laid.size()), laid.data());
  ring->closeRings();
  auto polygon = std::make_unique<OGRPolygon>();
  polygon->addRingDirectly(ring.release());
  return polygon;
}

std::unique_ptr<OGRGeometry> united(std::unique_ptr<OGRGeometry> a,
                                    std::unique_ptr<OGRGeometry> b) {
  if (!a) return b;
  return std::unique_ptr<OGRGeometry>(a->Union(b.get()));
}

void shift(OGRGeometry& geometry, double degrees) {
  for (OGRLinearRing* ring : *geometry.toPolygon()) {
    for (int i = 0; i < ring->getNumPoints(); ++i)
      ring->setPoint(i, ring->getX(i) + degrees, ring->getY(i));
  }
}

std::unique_ptr<OGRGeometry> geometry_of(const Coverage& coverage, double meridian) {
  std::unique_ptr<OGRGeometry> all;
  for (const CoveragePolygon& rings : coverage.polygons) {
    auto polygon = polygon_of(laid_out(rings.front(), meridian));
    const double x = polygon->getExteriorRing()->getX(0);
    OGREnvelope around;
    polygon->getEnvelope(&around);
    for (std::size_t i = 1; i < rings.size(); ++i) {
      const auto hole = polygon_of(laid_out(rings[i], x));
      bring_near(around, *hole->getExteriorRing());
      polygon->addRing(hole->getExteriorRing());
    }
    std::unique_ptr<OGRGeometry> sound = polygon->IsValid()
                                             ? std::unique_ptr<OGRGeometry>(std::move(polygon))
                                             : std::unique_ptr<OGRGeometry>(polygon->MakeValid());
    if (!sound) return nullptr;
    // Rings that begin near the far side of the meridian may be laid a turn away.
    OGREnvelope box;
    sound->getEnvelope(&box);
    for (const double turn : {-360.0, 360.0}) {
      if (box.MaxX - meridian < 90.0 && meridian - box.MinX < 90.0) continue;
      for (const OGRPolygon* part : polygons_in(*sound)) {
        std::unique_ptr<OGRGeometry> copy(part->clone());
        shift(*copy, turn);
        all = united(std::move(all), std::move(copy));
        if (!all) return nullptr;
      }
    }
    all = united(std::move(all), std::move(sound));
    if (!all) return nullptr;
  }
  return all;
}

bool lies_on(OGRRawPoint p, OGRRawPoint a, OGRRawPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double t =
      length2 > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy) <= kOnEdge;
}

struct SamePoint {
  bool operator()(const OGRRawPoint& a, const OGRRawPoint& b) const {
    return a.x == b.x && a.y == b.y;
  }
  std::size_t operator()(const OGRRawPoint& p) const {
    std::uint64_t x = 0, y = 0;
    std::memcpy(&x, &p.x, sizeof x);
    std::memcpy(&y, &p.y, sizeof y);
    return static_cast<std::size_t>((x * 0x9E3779B97F4A7C15ull) ^ (y >> 7) * 0xBF58476D1CE4E5B9ull);
  }
};
using PointIndex = std::unordered_multimap<OGRRawPoint, std::size_t, SamePoint, SamePoint>;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// The edge of `laid` that p - q is a part of.
std::size_t parent_of(OGRRawPoint p, OGRRawPoint q, const std::vector<OGRRawPoint>& laid,
                      const PointIndex& at) {
  const std::size_t n = laid.size();
  const auto holds = [&](std::size_t i) {
    const OGRRawPoint a = laid[i], b = laid[i + 1 == n ? 0 : i + 1];
    return lies_on(p, a, b) && lies_on(q, a, b);
  };
  for (auto [it, end] = at.equal_range(p); it != end; ++it)
    if (holds(it->second)) return it->second;
  for (auto [it, end] = at.equal_range(q); it != end; ++it) {
    const std::size_t before = it->second == 0 ? n - 1 : it->second - 1;
    if (holds(before)) return before;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (holds(i)) return i;
  return kNone;
}

}  // namespace

std::vector<ClipArea> ClipArea::of(const std::vector<const Coverage*>& coverages,
                                   double meridian_deg) {
  GdalErrors errors;
  std::vector<ClipArea> areas;
  std::unique_ptr<OGRGeometry> before;
  bool nothing_left = false;
  const auto require = [&](const std::unique_ptr<OGRGeometry>& geometry) {
    if (!geometry)
      throw std::runtime_error(
          fmt::format("the coverages of the charts cannot be told apart: {}", errors.text()));
  };
  for (const Coverage* coverage : coverages) {
    ClipArea& area = areas.emplace_back();
    area.meridian_deg_ = meridian_deg;
    if (nothing_left) continue;
    area.everywhere_ = coverage->everywhere();
    if (area.everywhere_) {
      nothing_left = true;
      // Wide enough for any ring, higher than the poles.
      area.area_ = polygon_of({{meridian_deg - 1080.0, -91.0},
                               {meridian_deg + 1080.0, -91.0},
                               {meridian_deg + 1080.0, 91.0},
                               {meridian_deg - 1080.0, 91.0}});
      if (before) {
        area.cut_.reset(before->clone());
        area.area_.reset(area.area_->Difference(before.get()));
        require(area.area_);
        area.cut_->getEnvelope(&area.box_);
      }
    } else {
      std::unique_ptr<OGRGeometry> own = geometry_of(*coverage, meridian_deg);
      require(own);
      area.area_.reset(before ? own->Difference(before.get()) : own->clone());
      require(area.area_);
      before = united(std::move(before), std::move(own));
      require(before);
      area.area_->getEnvelope(&area.box_);
    }
    area.prepared_.reset(OGRCreatePreparedGeometry(OGRGeometry::ToHandle(area.area_.get())));
  }
  return areas;
}

Coverage ClipArea::limit() const {
  Coverage limit;
  if (!area_ || everywhere_) return limit;
  for (const OGRPolygon* polygon : polygons_in(*area_)) {
    CoveragePolygon& rings = limit.polygons.emplace_back();
    for (const OGRLinearRing* ring : *polygon) {
      std::vector<GeoPoint>& places = rings.emplace_back();
      for (int i = 0; i + 1 < ring->getNumPoints(); ++i)
        places.push_back({ring->getY(i), wrapped_longitude(ring->getX(i))});
    }
  }
  return limit;
}

void ClipArea::clip(const CoastRing& given, std::vector<CoastRing>& out) const {
  if (!area_ || given.vertices.size() < 3) return;
  if (everywhere_ && !cut_) {
    out.push_back(given);
    return;
  }
  std::vector<OGRRawPoint> laid = laid_out(given.vertices, meridian_deg_);
  const bool around_pole = laid.size() > given.vertices.size();
  const CoastRing turned = around_pole ? begun_far_from(meridian_deg_, given) : CoastRing{};
  const CoastRing& ring = around_pole ? turned : given;
  if (around_pole) laid = laid_out(ring.vertices, meridian_deg_);
  OGREnvelope box;
  for (const OGRRawPoint& p : laid) box.Merge(p.x, p.y);
  if (!box.Intersects(box_)) {
    if (everywhere_) out.push_back(ring);
    return;
  }
  GdalErrors errors;
  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error(fmt::format(
        "the coast at latitude {:.6f}, longitude {:.6f} cannot be cut at the limit of a "
        "chart: {}",
        ring.vertices[0].latitude_deg, ring.vertices[0].longitude_deg, reason));
  };
  std::unique_ptr<OGRGeometry> polygon = polygon_of(laid);
  TangleBudget budget;
  const std::string fault = fault_of_tangle(*polygon->toPolygon(), budget);
  if (!fault.empty()) refuse(fault);
  if (prepared_ &&
      OGRPreparedGeometryContains(prepared_.get(), OGRGeometry::ToHandle(polygon.get()))) {
    out.push_back(ring);
    return;
  }
  if (prepared_ &&
      !OGRPreparedGeometryIntersects(prepared_.get(), OGRGeometry::ToHandle(polygon.get())))
    return;
  if (!polygon->IsValid()) polygon.reset(polygon->MakeValid());
  if (!polygon) refuse(errors.text());
  const std::unique_ptr<OGRGeometry> parts(polygon->Intersection(area_.get()));
  if (!parts) refuse(errors.text());
  OGRLinearRing whole;
  whole.setPoints(static_cast<int>(laid.size()), laid.data());
  const bool counter_clockwise = twice_area(whole) > 0.0;
  for (const OGRPolygon* part : polygons_in(*parts)) {
    if (part->getExteriorRing() == nullptr) continue;
    append_part(*part->getExteriorRing(), counter_clockwise, ring, laid, out);
    for (int i = 0; i < part->getNumInteriorRings(); ++i)
      append_part(*part->getInteriorRing(i), !counter_clockwise, ring, laid, out);
  }
}

void ClipArea::append_part(const OGRLinearRing& part, bool counter_clockwise, const CoastRing& ring,
                           const std::vector<OGRRawPoint>& laid,
                           std::vector<CoastRing>& out) const {
  const int n = part.getNumPoints() - 1;  // the last repeats the first
  if (n < 3) return;
  PointIndex at;
  for (std::size_t i = 0; i < laid.size(); ++i) at.emplace(laid[i], i);
  const bool forward = (twice_area(part) > 0.0) == counter_clockwise;
  const auto corner = [&](int i) {
    const int k = forward ? i % n : (n - i % n) % n;
    return OGRRawPoint(part.getX(k), part.getY(k));
  };
  CoastRing piece;
  piece.level = ring.level;
  for (int i = 0; i < n; ++i) {
    const OGRRawPoint p = corner(i), q = corner(i + 1);
    const auto original = at.find(p);
    if (original != at.end() && original->second <= ring.vertices.size()) {
      const std::size_t k = original->second % ring.vertices.size();
      piece.vertices.push_back(ring.vertices[k]);
      piece.vertex_ids.push_back(ring.vertex_ids[k]);
    } else {
      const GeoPoint place{std::round(p.y * kStepsPerDegree) / kStepsPerDegree,
                           std::round(wrapped_longitude(p.x) * kStepsPerDegree) / kStepsPerDegree};
      piece.vertices.push_back({place.latitude_deg, wrapped_longitude(place.longitude_deg)});
      piece.vertex_ids.push_back(identity_of(place));
    }
    const std::size_t parent = parent_of(p, q, laid, at);
    piece.edges.push_back(parent == kNone              ? EdgeKind::seam
                          : parent < ring.edges.size() ? ring.edges[parent]
                                                       : EdgeKind::bin_border);
    if (!ring.shores.empty())
      piece.shores.push_back(parent < ring.shores.size() ? ring.shores[parent] : ring.shores[0]);
  }
  out.push_back(std::move(piece));
}

}  // namespace skerry::echo
