#include "echo/chart/gdal/s57/s57_land.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <unordered_map>

#include "echo/chart/gdal/polygons/cut_lines.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"
#include "echo/chart/gdal/polygons/shared_edges.hpp"
#include "echo/chart/gdal/s57/object_defaults.hpp"

namespace skerry::echo {
namespace {

constexpr double kOvershoot = 0.01;  // degrees

using OwnedPolygons = std::vector<std::unique_ptr<OGRPolygon>>;

void read_coverage(const S57Cell& cell, ChartSheet& sheet) {
  TangleBudget budget;
  cell.for_each("M_COVR", [&](const S57Feature& feature) {
    if (feature.integer("CATCOV").value_or(1) != 1) return;
    for (const OGRPolygon* polygon : polygons_in(*feature.geometry())) {
      if (const std::string fault = fault_of_tangle(*polygon, budget); !fault.empty()) {
        cell.warnings().add(fmt::format("{}: {}; left out", feature.name(), fault));
        continue;
      }
      CoveragePolygon rings;
      for (const OGRLinearRing* ring : *polygon) {
        std::string fault;
        std::vector<GeoPoint> places = places_on(*ring, fault);
        if (places.size() > 1 && places.back() == places.front()) places.pop_back();
        if (places.size() < 3) {
          cell.warnings().add(
              fmt::format("{}: {}; left out", feature.name(),
                          fault.empty() ? std::string("a ring of less than three places") : fault));
          if (rings.empty()) break;
          continue;
        }
        rings.push_back(std::move(places));
      }
      if (!rings.empty()) sheet.coverage.polygons.push_back(std::move(rings));
    }
  });
}

// Land without a coverage: the box around it, and a warning.
void assume_coverage(const S57Cell& cell, ChartSheet& sheet) {
  GeoBox box;
  for (const CoastRing& ring : sheet.rings) box = joined(box, box_around(ring.vertices));
  if (box.width_deg < 0.0)
    throw std::runtime_error(
        fmt::format("chart file {}: neither a coverage (M_COVR with CATCOV 1) nor land (LNDARE); "
                    "nothing to show",
                    cell.file()));
  const double east = wrapped_longitude(box.west_deg + box.width_deg);
  sheet.coverage.polygons = {{{{box.south_deg, box.west_deg},
                               {box.south_deg, east},
                               {box.north_deg, east},
                               {box.north_deg, box.west_deg}}}};
  cell.warnings().add(fmt::format(
      "{}: no coverage (M_COVR with CATCOV 1); taken to be the box around its land", cell.file()));
}

bool reaches_out(const std::vector<GeoPoint>& ring, const GeoBox& limit) {
  const GeoBox box = box_around(ring);
  const double west = wrapped_longitude(box.west_deg - limit.west_deg);
  return box.south_deg < limit.south_deg - kOvershoot ||
         box.north_deg > limit.north_deg + kOvershoot || west < -kOvershoot ||
         west + box.width_deg > limit.width_deg + kOvershoot;
}

// The cost that all polygons of a cell may have together.
struct LandBudget {
  TangleBudget tangle;
  std::size_t vertices = 0;
};

// Appends the polygon's rings, unless any reaches out of the coverage.  False for one that could
// not be read.
bool append_within(const S57Cell& cell, const OGRPolygon& polygon, std::uint8_t level,
                   const std::string& name, ChartSheet& sheet, LandBudget& budget) {
  std::vector<CoastRing> rings;
  if (!append_polygon(polygon, level, name, rings, cell.warnings(), budget.tangle)) return false;
  if (!sheet.coverage.everywhere()) {
    const GeoBox limit = sheet.coverage.box();
    for (const CoastRing& ring : rings) {
      if (!reaches_out(ring.vertices, limit)) continue;
      cell.warnings().add(fmt::format("{}: reaches out of the cell's coverage; left out", name));
      return true;
    }
  }
  for (CoastRing& ring : rings) {
    budget.vertices += ring.vertices.size();
    if (budget.vertices > kMostVertices)
      throw std::runtime_error(
          fmt::format("chart file {}: more than {} vertices of land", cell.file(), kMostVertices));
    sheet.rings.push_back(std::move(ring));
  }
  return true;
}

// Whether GEOS may be given it as it is; if not, that is told.
bool may_be_compared(const S57Cell& cell, const OGRPolygon& polygon, const std::string& name,
                     LandBudget& budget) {
  const std::string fault = fault_of_tangle(polygon, budget.tangle);
  if (!fault.empty()) cell.warnings().add(fmt::format("{}: {}; left out", name, fault));
  return fault.empty();
}

void read_waters(const S57Cell& cell, const OwnedPolygons& land, ChartSheet& sheet,
                 LandBudget& budget) {
  OwnedPolygons waters;
  for (const char* water : {"LAKARE", "RIVERS", "CANALS"}) {
    cell.for_each(water, [&](const S57Feature& feature) {
      for (const OGRPolygon* polygon : polygons_in(*feature.geometry())) {
        if (!may_be_compared(cell, *polygon, feature.name(), budget)) continue;
        GdalErrors errors;  // of GEOS, about polygons that have been warned of
        const auto around = [&](const auto& area) { return area->Contains(polygon); };
        const auto meets = [&](const auto& other) {
          return other->Overlaps(polygon) || other->Contains(polygon) ||
                 polygon->Contains(other.get());
        };
        if (std::none_of(land.begin(), land.end(), around) ||
            std::any_of(waters.begin(), waters.end(), meets))
          continue;
        if (append_within(cell, *polygon, 2, feature.name(), sheet, budget))
          waters.emplace_back(polygon->clone());
      }
    });
  }
}

// Shores along edges; the first value given for an edge holds.
class ShoreMap {
 public:
  void add_along(const OGRGeometry& geometry, const Shore& shore) {
    for (const OGRLineString* line : lines_in(geometry)) add_line(*line, shore);
    for (const OGRPolygon* polygon : polygons_in(geometry)) {
      for (const OGRLinearRing* ring : *polygon) add_line(*ring, shore);
    }
  }
  const Shore* find(const EdgeName& edge) const {
    const auto found = shores_.find(edge);
    return found == shores_.end() ? nullptr : &found->second;
  }

 private:
  void add_line(const OGRSimpleCurve& line, const Shore& shore) {
    std::string fault;
    const std::vector<GeoPoint> places = places_on(line, fault);
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
      shores_.try_emplace(EdgeName(identity_of(places[i]), identity_of(places[i + 1])), shore);
  }
  std::unordered_map<EdgeName, Shore, EdgeNameHash> shores_;
};

float charted_height(const S57Feature& feature, const char* attribute) {
  const double height = feature.real(attribute).value_or(0.0);
  return height > 0.0 && height < 1000.0 ? static_cast<float>(height) : 0.0f;
}

ShoreMap read_shores(const S57Cell& cell) {
  constexpr int kAlwaysUnderWater = 3;
  ShoreMap map;
  for (const char* built : {"SLCONS", "DAMCON", "CAUSWY", "DYKCON", "GATCON", "DRYDOC"}) {
    cell.for_each(built, [&](const S57Feature& feature) {
      if (feature.integer("WATLEV") == kAlwaysUnderWater) return;
      map.add_along(*feature.geometry(),
                    {CoastType::artificial, charted_height(feature, "HEIGHT")});
    });
  }
  cell.for_each("COALNE", [&](const S57Feature& feature) {
    const Shore shore{type_of_coastline(feature.integer("CATCOA").value_or(0)),
                      charted_height(feature, "ELEVAT")};
    if (shore != Shore{}) map.add_along(*feature.geometry(), shore);
  });
  for (const char* ground : {"LNDRGN", "SBDARE"}) {
    cell.for_each(ground, [&](const S57Feature& feature) {
      CoastType type = type_of_surface(feature.integer("NATSUR").value_or(0));
      if (type == CoastType::unknown) type = type_of_region(feature.integer("CATLND").value_or(0));
      if (type != CoastType::unknown) map.add_along(*feature.geometry(), {type, 0.0f});
    });
  }
  return map;
}

}  // namespace

void read_land(const S57Cell& cell, ChartSheet& sheet) {
  read_coverage(cell, sheet);
  OwnedPolygons land;
  LandBudget budget;
  cell.for_each("LNDARE", [&](const S57Feature& feature) {
    for (const OGRPolygon* polygon : polygons_in(*feature.geometry())) {
      if (append_within(cell, *polygon, 1, feature.name(), sheet, budget))
        land.emplace_back(polygon->clone());
    }
  });
  if (sheet.coverage.everywhere()) assume_coverage(cell, sheet);
  read_waters(cell, land, sheet, budget);

  const ShoreMap shores = read_shores(cell);
  const CutLines limit(sheet.coverage);
  ShoreTable table(sheet.shores);
  for (CoastRing& ring : sheet.rings) {
    const std::size_t n = ring.vertices.size();
    ring.shores.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (limit.carries(ring.vertices[i], ring.vertices[j])) ring.edges[i] = EdgeKind::seam;
      if (const Shore* shore = shores.find(EdgeName(ring.vertex_ids[i], ring.vertex_ids[j])))
        ring.shores[i] = table.index_of(*shore);
    }
  }
  settle_shared_edges(edges_of(sheet.rings), sheet.rings);
}

}  // namespace skerry::echo
