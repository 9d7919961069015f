#include "echo/chart/gdal/s57/s57_objects.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "echo/chart/gdal/polygons/land_polygon.hpp"
#include "echo/chart/gdal/s57/object_defaults.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr float kDefaultClearance = 5.0f;
constexpr char kUnknownRacon = 'K';

constexpr std::array kClasses = {
    "BOYCAR", "BOYINB", "BOYISD", "BOYLAT", "BOYSAW", "BOYSPP", "LITFLT", "LITVES",
    "BCNCAR", "BCNISD", "BCNLAT", "BCNSAW", "BCNSPP", "LNDMRK", "PYLONS", "CRANES",
    "SILTNK", "BUISGL", "FORSTC", "OFSPLF", "SLCONS", "BRIDGE", "CONVYR", "PONTON",
    "HULKES", "FLODOC", "PILPNT", "MORFAC", "UWTROC", "OBSTRN", "WRECKS", "RTPBCN"};

bool is_conspicuous(const S57Feature& feature) {
  const auto conrad = feature.integer("CONRAD");
  return conrad == 1 || conrad == 3;
}

// Out of the water when it is high.
bool stands_out(std::string_view object_class, const S57Feature& feature) {
  const auto level = feature.integer("WATLEV");
  if (object_class == "UWTROC" || object_class == "OBSTRN")
    return level == 1 || level == 2 || level == 7;
  if (object_class == "WRECKS") {
    const auto kind = feature.integer("CATWRK");
    return level == 1 || level == 2 || kind == 4 || kind == 5;
  }
  return level != 3 && level != 4 && level != 5;
}

class ObjectReader {
 public:
  ObjectReader(const S57Cell& cell, double unit, ChartSheet& sheet)
      : cell_(cell), unit_(unit), sheet_(sheet) {
    land_.rings = sheet.rings;
    for (const CoastRing& ring : sheet.rings) {
      for (std::size_t i = 0; i < ring.vertices.size(); ++i)
        land_edges_.insert(EdgeName(ring.vertex_ids[i],
                                    ring.vertex_ids[i + 1 == ring.vertices.size() ? 0 : i + 1]));
    }
  }

  void run() {
    for (const char* object_class : kClasses) {
      const std::string attribute(category_attribute(object_class));
      cell_.for_each(object_class, [&](const S57Feature& feature) {
        const int category = attribute.empty() ? 0 : feature.integer(attribute.c_str()).value_or(0);
        const auto usual = default_of(object_class, category);
        if (usual && stands_out(object_class, feature)) add(object_class, feature, *usual);
      });
    }
    cell_.for_each("LNDARE", [&](const S57Feature& feature) {
      if (polygons_in(*feature.geometry()).empty())
        add("LNDARE", feature, *default_of("LNDARE", 0));
    });
    add_reflectors();
    raise_racons();
  }

 private:
  void add(std::string_view object_class, const S57Feature& feature, const ObjectDefault& usual) {
    ChartObject object;
    object.kind = usual.kind;
    object.name = feature.text("OBJNAM");
    object.cross_section_m2 = usual.cross_section_m2;
    set_heights(feature, usual, object);
    if (object.kind == ObjectClass::racon && !set_racon(feature, object)) return;

    const OGRGeometry& geometry = *feature.geometry();
    const bool built = object_class == "SLCONS" || object_class == "MORFAC";
    for (const OGRPolygon* polygon : polygons_in(geometry)) {
      if (polygon->getExteriorRing() == nullptr || (built && is_land_area(*polygon))) continue;
      add_line(feature, *polygon->getExteriorRing(), object, false);
    }
    for (const OGRLineString* line : lines_in(geometry)) add_line(feature, *line, object, built);
    add_points(feature, geometry, object);
  }

  double charted(const S57Feature& feature, const char* attribute) const {
    const double value = feature.real(attribute).value_or(0.0) * unit_;
    return value > 0.0 && value <= kGreatestHeight ? value : 0.0;
  }

  void set_heights(const S57Feature& feature, const ObjectDefault& usual,
                   ChartObject& object) const {
    const double top = charted(feature, "HEIGHT"), length = charted(feature, "VERLEN");
    const double own = length > 0.0 ? length : static_cast<double>(usual.height_m);
    object.height_m = static_cast<float>(top > 0.0 ? top : own + charted(feature, "ELEVAT"));
    if (object.kind == ObjectClass::bridge) {
      double clearance = charted(feature, "VERCCL");
      if (clearance == 0.0) clearance = charted(feature, "VERCLR");
      constexpr int kPontoonBridge = 6;
      if (clearance == 0.0 && feature.integer("CATBRG") != kPontoonBridge)
        clearance = static_cast<double>(kDefaultClearance);
      object.clearance_m = static_cast<float>(clearance);
      if (top <= clearance) object.height_m = object.clearance_m + usual.height_m;
    }
    if (is_conspicuous(feature) && object.cross_section_m2 > 0.0f) make_reflector(object);
  }

  static void make_reflector(ChartObject& object) {
    if (object.kind == ObjectClass::buoy || object.kind == ObjectClass::beacon ||
        object.kind == ObjectClass::pile)
      object.kind = ObjectClass::reflector;
    object.cross_section_m2 = std::max(object.cross_section_m2, kReflectorCrossSection);
  }

  // False for a ramark, which sends without being asked.
  bool set_racon(const S57Feature& feature, ChartObject& object) const {
    if (is_ramark(feature)) {
      cell_.warnings().add(fmt::format("{}: a ramark is not modelled; left out", feature.name()));
      return false;
    }
    for (const char c : feature.text("SIGGRP")) {
      if (c >= 'A' && c <= 'Z' && object.racon_code.size() < 4) object.racon_code += c;
    }
    if (object.racon_code.empty()) {
      object.racon_code.push_back(kUnknownRacon);
      cell_.warnings().add(fmt::format("{}: no letters charted (SIGGRP); answers \"{}\"",
                                       feature.name(), kUnknownRacon));
    }
    return true;
  }

  bool is_land_area(const OGRPolygon& polygon) const {
    GdalErrors errors;
    OGRPoint inside;
    if (polygon.PointOnSurface(&inside) != OGRERR_NONE) return false;
    return is_land(land_, {inside.getY(), inside.getX()});
  }

  // `built`: without what the land's own edges stand for, and what lies on land.
  void add_line(const S57Feature& feature, const OGRSimpleCurve& line, const ChartObject& object,
                bool built) {
    std::string fault;
    std::vector<GeoPoint> places = places_on(line, fault);
    if (!fault.empty())
      cell_.warnings().add(fmt::format("{}: {}; left out", feature.name(), fault));
    if (places.size() < 2) return;
    if (!built) {
      const bool closed = places.size() > 3 && places.back() == places.front();
      if (closed) places.pop_back();
      put(object, std::move(places), closed);
      return;
    }
    std::vector<GeoPoint> run;
    const auto finish = [&] {
      if (run.size() > 1) {
        const GeoPoint a = run[0], b = run[1];
        const GeoPoint middle{
            0.5 * (a.latitude_deg + b.latitude_deg),
            a.longitude_deg + 0.5 * wrapped_longitude(b.longitude_deg - a.longitude_deg)};
        if (!is_land(land_, middle)) put(object, run, false);
      }
      run.clear();
    };
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      if (land_edges_.contains(EdgeName(identity_of(places[i]), identity_of(places[i + 1])))) {
        finish();
        continue;
      }
      if (run.empty()) run.push_back(places[i]);
      run.push_back(places[i + 1]);
    }
    finish();
  }

  void add_points(const S57Feature& feature, const OGRGeometry& geometry,
                  const ChartObject& object) {
    const auto type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry.toMultiPoint()) add_points(feature, *point, object);
      return;
    }
    if (type != wkbPoint) return;
    const OGRPoint& point = *geometry.toPoint();
    OGRLineString one;
    one.addPoint(point.getX(), point.getY());
    std::string fault;
    std::vector<GeoPoint> places = places_on(one, fault);
    if (!fault.empty())
      cell_.warnings().add(fmt::format("{}: {}; left out", feature.name(), fault));
    if (!places.empty()) put(object, std::move(places), false);
  }

  void put(ChartObject object, std::vector<GeoPoint> outline, bool closed) {
    if (outline.size() > kMostOutlineVertices - vertices_) {
      cell_.warnings().add(
          fmt::format("{}: a {} more than the {} vertices of objects a chart may have; left out",
                      cell_.file(), outline.size() > 1 ? "line" : "point", kMostOutlineVertices));
      return;
    }
    vertices_ += outline.size();
    object.identity = mixed(static_cast<std::uint64_t>(object.kind), identity_of(outline.front()),
                            outline.size());
    if (outline.size() == 1) at_.try_emplace(identity_of(outline.front()), sheet_.objects.size());
    object.outline = std::move(outline);
    object.closed = closed;
    sheet_.objects.push_back(std::move(object));
  }

  // A reflector stands on what is charted at its place, or else by itself.
  void add_reflectors() {
    cell_.for_each("RADRFL", [&](const S57Feature& feature) {
      const auto type = wkbFlatten(feature.geometry()->getGeometryType());
      if (type == wkbPoint) {
        const OGRPoint& point = *feature.geometry()->toPoint();
        const auto bearer = at_.find(identity_of({point.getY(), point.getX()}));
        if (bearer != at_.end() && sheet_.objects[bearer->second].cross_section_m2 > 0.0f) {
          make_reflector(sheet_.objects[bearer->second]);
          return;
        }
      }
      add("RADRFL", feature, *default_of("RADRFL", 0));
    });
  }

  // A racon stands on what is charted at its place.
  void raise_racons() {
    for (ChartObject& object : sheet_.objects) {
      if (object.kind != ObjectClass::racon) continue;
      const auto bearer = at_.find(identity_of(object.outline.front()));
      if (bearer == at_.end()) continue;
      const ChartObject& on = sheet_.objects[bearer->second];
      if (on.kind != ObjectClass::racon) object.height_m = on.height_m;
      if (object.name.empty()) object.name = on.name;
    }
  }

  const S57Cell& cell_;
  double unit_;
  ChartSheet& sheet_;
  CoastChart land_;
  std::unordered_set<EdgeName, EdgeNameHash> land_edges_;
  std::unordered_map<std::uint64_t, std::size_t> at_;  // the first object at a place
  std::size_t vertices_ = 0;
};

}  // namespace

void read_objects(const S57Cell& cell, double metres_per_height_unit, ChartSheet& sheet) {
  ObjectReader(cell, metres_per_height_unit, sheet).run();
}

}  // namespace skerry::echo
