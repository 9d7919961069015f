// LayeredChart: several charts over each other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "echo/chart/gdal/coverage.hpp"

namespace skerry::echo {

// The highest chart that covers a place is asked there, and no other: an ENC over GSHHG, a cell of
// a larger scale over one of a smaller.
//  - Rings of lower charts are cut at the limits of higher ones (GEOS).  What is cut off a
//    shoreline edge is one; all other edges keep kind, shore and identity.
//  - Along a limit, where the charts agree that both sides are land, edges are bin_borders; where
//    they do not, land ends at an EdgeKind::seam.  So a place is land exactly if the chart asked
//    there says so (but within 1.2 cm of a limit), and the shorelines and seams that a ray meets
//    add up to the same.  Held by LayeredReal.IsLandWhereTheChartAskedThereIs and
//    LayeredReal.RaysOverShoresAndSeamsCountTheSame.
//  - An object counts unless a higher chart covers its place: also one outside its own chart's
//    coverage, so a chart of objects alone, which covers nothing, adds to the lower ones. Elevation
//    is that of the highest chart with any.
// An edge that the window touches is cut the same in every window.
// Thread: load() from one thread at a time.
class LayeredChart final : public CoveredChart {
 public:
  // Highest first; a chart that is no CoveredChart covers the Earth.
  // Error: std::invalid_argument if there is none.
  explicit LayeredChart(std::vector<std::unique_ptr<ChartSource>> charts);

  // Error: as the charts'; std::runtime_error if GEOS cannot cut a ring.
  CoastChart load(GeoPoint centre, Length radius) const override;
  // Marks as objects; of a contour of a lower chart the parts whose ends no higher one covers.
  ChartDetail detail(GeoPoint centre, Length radius) const override;
  std::string describe() const override;  // all charts, highest first; of more than 4 the number
  const Coverage& coverage() const override { return coverage_; }

 private:
  std::vector<std::unique_ptr<ChartSource>> charts_;
  std::vector<Coverage> coverages_;  // by chart
  std::vector<GeoBox> boxes_;
  Coverage coverage_;  // of all
};

}  // namespace skerry::echo
