// CutLines: the limits of charts, as lines that edges may lie on.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/chart/gdal/coverage.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Straight lines in latitude and longitude; places within kTolerance of one lie on it.
class CutLines {
 public:
  // Degrees: what a place off the grid of 1e-7 degrees is moved by, and a bit.  1.7 cm.
  static constexpr double kTolerance = 1.5e-7;

  explicit CutLines(const Coverage& coverage);

  // Whether the edge lies along the lines: both ends on one and the same.
  bool carries(GeoPoint a, GeoPoint b) const;

 private:
  struct Line {
    GeoPoint from;
    double run_deg, rise_deg;  // to its end, shortest way
  };
  static bool touches(const Line& line, GeoPoint place);

  // By latitude: lines_[k] belongs to the bands it passes through.
  std::vector<Line> lines_;
  double south_ = 0.0, band_deg_ = 1.0;
  std::vector<std::vector<std::uint32_t>> bands_;
};

}  // namespace skerry::echo
