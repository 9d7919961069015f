#include "echo/chart/gdal/s57/s57_moorings.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "echo/chart/gdal/cover_areas.hpp"
#include "echo/chart/gdal/polygons/land_polygon.hpp"
#include "echo/chart/moored_craft.hpp"

namespace skerry::echo {
namespace {

constexpr int kFishingHarbour = 4, kMarina = 5;
constexpr std::array kBerthing = {1, 2, 5, 29};

void add_harbour(const S57Cell& cell, const S57Feature& feature, bool fishing, Moorings& moorings,
                 TangleBudget& budget) {
  const OGRGeometry& geometry = *feature.geometry();
  for (auto& rings : areas_in(geometry, feature.name(), cell.warnings(), budget))
    moorings.areas.push_back({std::move(rings), fishing, feature.name()});
  if (wkbFlatten(geometry.getGeometryType()) != wkbPoint) return;
  OGRLineString one;
  one.addPoint(geometry.toPoint()->getX(), geometry.toPoint()->getY());
  std::string fault;
  const std::vector<GeoPoint> places = places_on(one, fault);
  if (!fault.empty()) cell.warnings().add(feature.name() + ": " + fault + "; left out");
  if (!places.empty()) moorings.places.push_back({places.front(), fishing});
}

}  // namespace

void read_moorings(const S57Cell& cell, ChartSheet& sheet) {
  Moorings moorings;
  TangleBudget budget;
  cell.for_each("HRBFAC", [&](const S57Feature& feature) {
    const int category = feature.integer("CATHAF").value_or(0);
    if (category == kMarina || category == kFishingHarbour)
      add_harbour(cell, feature, category == kFishingHarbour, moorings, budget);
  });
  cell.for_each("SMCFAC", [&](const S57Feature& feature) {
    const int category = feature.integer("CATSCF").value_or(0);
    if (std::find(kBerthing.begin(), kBerthing.end(), category) != kBerthing.end())
      add_harbour(cell, feature, false, moorings, budget);
  });
  if (!moorings.areas.empty() || !moorings.places.empty()) {
    std::size_t vertices = 0;
    cell.for_each("BERTHS", [&](const S57Feature& feature) {
      for (const OGRLineString* line : lines_in(*feature.geometry())) {
        std::string fault;
        std::vector<GeoPoint> places = places_on(*line, fault);
        if (!fault.empty()) cell.warnings().add(feature.name() + ": " + fault + "; left out");
        if (places.size() < 2 || places.size() > kMostOutlineVertices - vertices) continue;
        vertices += places.size();
        moorings.berths.push_back(std::move(places));
      }
    });
  }
  std::vector<std::string> reports;
  auto craft = moored_craft(moorings, sheet.objects, sheet.rings, cell.file(), reports);
  std::move(craft.begin(), craft.end(), std::back_inserter(sheet.objects));
  cell.warnings().add(reports);
}

}  // namespace skerry::echo
