// ChartSource: where coast comes from.
#pragma once

#include <string>

#include "echo/chart/chart_detail.hpp"
#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

// GSHHG, ENC cells, GeoJSON and Shapefiles, and several of them over each other.
// Thread: load() and detail() may be called from one thread at a time.
class ChartSource {
 public:
  virtual ~ChartSource() = default;
  // The coast within `radius` of `centre`, metres; more may be present.
  // Error: std::runtime_error that names file and object.
  virtual CoastChart load(GeoPoint centre, Length radius) const = 0;
  // Depths and marks, whole, of which any part is within the window.  None of charts that have only
  // coast.  Error: as load().
  virtual ChartDetail detail(GeoPoint /*centre*/, Length /*radius*/) const { return {}; }
  // For the log: "GSHHG 2.3.7 full", "ENC US5WA22M edition 22 update 2".
  virtual std::string describe() const = 0;
};

}  // namespace skerry::echo
