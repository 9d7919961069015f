#include "echo/chart/gdal/vector_chart.hpp"

#include <fmt/core.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "echo/chart/gdal/cover_areas.hpp"
#include "echo/chart/gdal/cover_tags.hpp"
#include "echo/chart/gdal/gdal_session.hpp"
#include "echo/chart/gdal/polygons/cut_lines.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"
#include "echo/chart/gdal/polygons/shared_edges.hpp"
#include "echo/chart/gdal/s57/object_defaults.hpp"
#include "echo/chart/gdal/vector_kinds.hpp"
#include "echo/chart/moored_craft.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr std::uintmax_t kMostVectorBytes = 512ull << 20;
constexpr int kMostLayers = 200;
constexpr double kMargin = 0.0005;  // degrees
constexpr double kGreatestCrossSection = 1e6;

// A complaint for which append_polygon() has a better text.
constexpr const char* kToldByFeature = "Non closed ring";

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* t) const {
    OGRCoordinateTransformation::DestroyCT(t);
  }
};
using TransformationPtr = std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation>;

class VectorReader {
 public:
  VectorReader(GDALDataset& dataset, const std::filesystem::path& file, ChartSheet& sheet,
               ChartWarnings& warnings)
      : dataset_(dataset),
        file_(file.filename().string()),
        sheet_(sheet),
        table_(sheet.shores),
        warnings_(warnings),
        covers_(sheet, warnings, budget_) {
    wgs84_.SetWellKnownGeogCS("WGS84");
    wgs84_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }

  void run() {
    const int layers = dataset_.GetLayerCount();
    if (layers > kMostLayers)
      throw std::runtime_error(fmt::format("chart file {}: {} layers, more than the {} allowed",
                                           file_, layers, kMostLayers));
    for (int i = 0; i < layers; ++i) {
      if (OGRLayer* layer = dataset_.GetLayer(i)) read_layer(*layer);
    }
    moor_craft();
    if (sheet_.rings.empty() && sheet_.objects.empty() && sheet_.covers.empty())
      throw std::runtime_error(fmt::format(
          "chart file {}: no land and no objects or land cover that can be used{}", file_,
          warnings_.texts().empty() ? std::string() : "; first fault: " + warnings_.texts()[0]));
    finish();
  }

 private:
  void read_layer(OGRLayer& layer) {
    TransformationPtr to_wgs84;
    if (const OGRSpatialReference* stated = layer.GetSpatialRef()) {
      OGRSpatialReference from(*stated);
      from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      if (!from.IsSame(&wgs84_)) {
        to_wgs84.reset(OGRCreateCoordinateTransformation(&from, &wgs84_));
        if (!to_wgs84)
          throw std::runtime_error(
              fmt::format("chart file {}: layer {}: cannot be brought to WGS-84: {}", file_,
                          layer.GetName(), errors_.text()));
      }
    } else {
      warnings_.add(fmt::format("{}: layer {} states no reference system; taken to be WGS-84",
                                file_, layer.GetName()));
    }
    layer.ResetReading();
    while (true) {
      errors_.forget();
      const OGRFeatureUniquePtr feature(layer.GetNextFeature());
      if (!feature) break;
      const std::string name =
          fmt::format("{}: {} feature {}", file_, layer.GetName(), feature->GetFID());
      OGRGeometry* geometry = feature->GetGeometryRef();
      if (errors_.count() > 0 || geometry == nullptr || geometry->IsEmpty()) {
        warnings_.add(fmt::format("{}: {}; left out", name,
                                  errors_.count() > 0 ? errors_.text() : "has no geometry"));
        continue;
      }
      if (to_wgs84 && geometry->transform(to_wgs84.get()) != OGRERR_NONE) {
        warnings_.add(
            fmt::format("{}: cannot be brought to WGS-84: {}; left out", name, errors_.text()));
        continue;
      }
      read_feature(*feature, *geometry, name);
    }
    if (errors_.count() > 0)
      throw std::runtime_error(fmt::format("chart file {}: layer {}: {}; the file is damaged",
                                           file_, layer.GetName(), errors_.text()));
  }

  static std::string text(const OGRFeature& feature, const char* field) {
    const int index = feature.GetFieldIndex(field);
    return index < 0 || !feature.IsFieldSetAndNotNull(index) ? "" : feature.GetFieldAsString(index);
  }

  // A number above 0 and up to `most`, or `otherwise`.
  float number(const OGRFeature& feature, const char* field, double most, float otherwise,
               const std::string& name) {
    const int index = feature.GetFieldIndex(field);
    if (index < 0 || !feature.IsFieldSetAndNotNull(index)) return otherwise;
    const double value = feature.GetFieldAsDouble(index);
    if (value >= 0.0 && value <= most) return static_cast<float>(value);
    warnings_.add(fmt::format("{}: {} is {}, expected 0 to {}; taken as not given", name, field,
                              value, most));
    return otherwise;
  }

  void read_feature(const OGRFeature& feature, const OGRGeometry& geometry,
                    const std::string& name) {
    const std::string kind = lower(text(feature, "kind"));
    if (kind == "coverage") {
      read_coverage(geometry, name);
    } else if (kind == "cover") {
      const std::string stated = lower(text(feature, "cover"));
      if (const auto cover = cover_named(stated)) {
        read_cover(geometry, *cover, name);
      } else {
        warnings_.add(fmt::format("{}: unknown cover \"{}\"; left out", name, stated));
      }
    } else if (kind == "marina" || (kind.empty() && lower(text(feature, "leisure")) == "marina")) {
      read_marina(geometry, name);
    } else if (kind.empty()) {
      read_untold(feature, geometry, name);
    } else {
      const auto found = std::find_if(kVectorKinds.begin(), kVectorKinds.end(),
                                      [&](const VectorKind& k) { return k.name == kind; });
      if (found == kVectorKinds.end()) {
        warnings_.add(fmt::format("{}: unknown kind \"{}\"; left out", name, kind));
      } else {
        read_object(feature, geometry, *found, name);
      }
    }
  }

  // Without `kind`: a cover where OpenStreetMap's keys say so, else land.
  void read_untold(const OGRFeature& feature, const OGRGeometry& geometry,
                   const std::string& name) {
    const TaggedCover tagged =
        cover_tagged([&](const char* key) { return lower(text(feature, key)); });
    if (tagged.tag.empty() || tagged.land) {
      read_land(feature, geometry, name);
    } else if (tagged.known) {
      read_cover(geometry, tagged.cover, name);
    } else {
      warnings_.add(fmt::format("{}: {} is no known land cover; left out", name, tagged.tag));
    }
  }

  void read_cover(const OGRGeometry& geometry, LandCover cover, const std::string& name) {
    if (polygons_in(geometry).empty()) {
      warnings_.add(fmt::format("{}: a {} has no area to cover; left out", name,
                                lower(geometry.getGeometryName())));
      return;
    }
    covers_.add(geometry, cover, name);
  }

  void read_marina(const OGRGeometry& geometry, const std::string& name) {
    for (auto& rings : areas_in(geometry, name, warnings_, budget_))
      moorings_.areas.push_back({std::move(rings), false, name});
    if (wkbFlatten(geometry.getGeometryType()) != wkbPoint) return;
    OGRLineString one;
    one.addPoint(geometry.toPoint()->getX(), geometry.toPoint()->getY());
    std::string fault;
    const std::vector<GeoPoint> places = places_on(one, fault);
    if (!fault.empty()) warnings_.add(fmt::format("{}: {}; left out", name, fault));
    if (!places.empty()) moorings_.places.push_back({places.front(), false});
  }

  void moor_craft() {
    std::vector<std::string> reports;
    for (ChartObject& craft : moored_craft(moorings_, sheet_.objects, sheet_.rings, file_, reports))
      sheet_.objects.push_back(std::move(craft));
    warnings_.add(reports);
  }

  void read_land(const OGRFeature& feature, const OGRGeometry& geometry, const std::string& name) {
    const auto polygons = polygons_in(geometry);
    if (polygons.empty()) {
      warnings_.add(
          fmt::format("{}: a {} without attribute `kind` is neither land nor object; left "
                      "out",
                      name, lower(geometry.getGeometryName())));
      return;
    }
    const std::string type_name = lower(text(feature, "type"));
    auto type = type_named(type_name);
    if (!type) {
      warnings_.add(
          fmt::format("{}: unknown type \"{}\", expected artificial, rocky, sandy or "
                      "unknown; taken as unknown",
                      name, type_name));
      type = CoastType::unknown;
    }
    const Shore shore{*type, number(feature, "height_m", kGreatestHeight, 0.0f, name)};
    const std::uint16_t index = table_.index_of(shore);
    for (const OGRPolygon* polygon : polygons) {
      const std::size_t before = sheet_.rings.size();
      append_polygon(*polygon, 1, name, sheet_.rings, warnings_, budget_);
      for (std::size_t i = before; i < sheet_.rings.size(); ++i) {
        sheet_.rings[i].shores.assign(sheet_.rings[i].vertices.size(), index);
        count(sheet_.rings[i].vertices.size());
      }
    }
  }

  void read_coverage(const OGRGeometry& geometry, const std::string& name) {
    std::vector<CoastRing> rings;
    for (const OGRPolygon* polygon : polygons_in(geometry)) {
      rings.clear();
      append_polygon(*polygon, 1, name, rings, warnings_, budget_);
      for (CoastRing& ring : rings) {
        count(ring.vertices.size());
        auto& polygons = sheet_.coverage.polygons;
        if (ring.level == 1) polygons.emplace_back();
        if (!polygons.empty()) polygons.back().push_back(std::move(ring.vertices));
      }
    }
  }

  void read_object(const OGRFeature& feature, const OGRGeometry& geometry, const VectorKind& kind,
                   const std::string& name) {
    const ObjectDefault usual = default_of(kind.as, kind.category).value_or(ObjectDefault{});
    ChartObject object;
    object.kind = kind.is;
    object.name = text(feature, "name");
    object.height_m = number(feature, "height_m", kGreatestHeight, usual.height_m, name);
    object.clearance_m = number(feature, "clearance_m", kGreatestHeight, 0.0f, name);
    object.cross_section_m2 =
        number(feature, "cross_section_m2", kGreatestCrossSection, usual.cross_section_m2, name);
    if (kind.is == ObjectClass::bridge && object.height_m <= object.clearance_m)
      object.height_m = object.clearance_m + usual.height_m;
    if (kind.is == ObjectClass::racon && !read_racon(feature, name, object)) return;

    for (const OGRPolygon* polygon : polygons_in(geometry)) {
      if (polygon->getExteriorRing()) put(object, *polygon->getExteriorRing(), name);
    }
    for (const OGRLineString* line : lines_in(geometry)) put(object, *line, name);
    const auto type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPoint) put_point(object, *geometry.toPoint(), name);
    if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry.toMultiPoint()) put_point(object, *point, name);
    }
  }

  bool read_racon(const OGRFeature& feature, const std::string& name, ChartObject& object) {
    const std::string letters = text(feature, "racon");
    const bool good =
        !letters.empty() && letters.size() <= 4 &&
        std::all_of(letters.begin(), letters.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
    if (good) object.racon_code = letters;
    if (!good)
      warnings_.add(fmt::format("{}: racon \"{}\", expected 1 to 4 capital letters; left out", name,
                                letters));
    return good;
  }

  void put_point(const ChartObject& object, const OGRPoint& point, const std::string& name) {
    OGRLineString one;
    one.addPoint(point.getX(), point.getY());
    put(object, one, name);
  }

  void put(ChartObject object, const OGRSimpleCurve& line, const std::string& name) {
    std::string fault;
    object.outline = places_on(line, fault);
    if (object.outline.empty()) {
      warnings_.add(fmt::format("{}: {}; left out", name, fault.empty() ? "is empty" : fault));
      return;
    }
    object.closed = object.outline.size() > 3 && object.outline.front() == object.outline.back();
    if (object.closed) object.outline.pop_back();
    for (GeoPoint& p : object.outline) p.longitude_deg = wrapped_longitude(p.longitude_deg);
    object.identity = mixed(static_cast<std::uint64_t>(object.kind),
                            identity_of(object.outline.front()), object.outline.size());
    if (object.outline.size() > kMostOutlineVertices - outline_vertices_) {
      warnings_.add(
          fmt::format("{}: more than the {} vertices of objects a chart may have; left out", name,
                      kMostOutlineVertices));
      return;
    }
    outline_vertices_ += object.outline.size();
    sheet_.objects.push_back(std::move(object));
  }

  void count(std::size_t vertices) {
    vertices_ += vertices;
    if (vertices_ > kMostVertices)
      throw std::runtime_error(fmt::format(
          "chart file {}: more than {} vertices; cut it into smaller files", file_, kMostVertices));
  }

  void finish() {
    if (sheet_.coverage.everywhere()) {
      GeoBox box;
      for (const CoastRing& ring : sheet_.rings) box = joined(box, box_around(ring.vertices));
      sheet_.coverage.nowhere = sheet_.rings.empty();
      if (!sheet_.rings.empty()) add_box(box);
    } else {
      const CutLines limit(sheet_.coverage);
      for (CoastRing& ring : sheet_.rings) {
        for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
          if (ring.edges[i] == EdgeKind::shoreline &&
              limit.carries(ring.vertices[i], ring.vertices[i + 1 == n ? 0 : i + 1]))
            ring.edges[i] = EdgeKind::seam;
        }
      }
    }
    settle_shared_edges(edges_of(sheet_.rings), sheet_.rings);
    sheet_.source = "chart " + file_;
    sheet_.index();
  }

  // In pieces of at most 90 degrees, so that the shortest way along its sides is the side.
  void add_box(const GeoBox& box) {
    if (box.width_deg >= 359.0 && box.north_deg - box.south_deg >= 179.0) return;  // everywhere
    const double south = std::max(-90.0, box.south_deg - kMargin);
    const double north = std::min(90.0, box.north_deg + kMargin);
    const double width = std::min(360.0, box.width_deg + 2.0 * kMargin);
    const int pieces = static_cast<int>(std::ceil(width / 90.0));
    const auto meridian = [&](int i) {
      const double x = box.west_deg - kMargin + width * i / pieces;
      return wrapped_longitude(std::round(x * kStepsPerDegree) / kStepsPerDegree);
    };
    for (int i = 0; i < pieces; ++i) {
      const double west = meridian(i), east = meridian(i + 1);
      sheet_.coverage.polygons.push_back(
          {{{south, west}, {south, east}, {north, east}, {north, west}}});
    }
  }

  GDALDataset& dataset_;
  std::string file_;
  ChartSheet& sheet_;
  ShoreTable table_;
  ChartWarnings& warnings_;
  GdalErrors errors_{kToldByFeature};
  OGRSpatialReference wgs84_;
  TangleBudget budget_;
  CoverAreas covers_;
  Moorings moorings_;
  std::size_t vertices_ = 0, outline_vertices_ = 0;
};

}  // namespace

VectorChart VectorChart::open(const std::filesystem::path& file,
                              std::vector<std::string>& warnings) {
  require_file(file, kMostVectorBytes);
  VectorChart chart;
  ChartWarnings told;
  DatasetPtr dataset;
  {
    GdalErrors errors{kToldByFeature};
    dataset = open_dataset(file.string(), GDAL_OF_VECTOR, {"GeoJSON", "ESRI Shapefile"}, {});
    if (!dataset)
      throw std::runtime_error(fmt::format("chart file {}: {}; expected GeoJSON or a Shapefile",
                                           file.string(), errors.text()));
    if (errors.count() > 0)
      told.add(fmt::format("{}: {}", file.filename().string(), errors.text()));
  }
  VectorReader(*dataset, file, chart.sheet_, told).run();
  for (std::string& text : told.texts()) warnings.push_back(std::move(text));
  return chart;
}

}  // namespace skerry::echo
