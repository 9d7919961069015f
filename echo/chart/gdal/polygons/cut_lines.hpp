// CutLines: the limits of charts, as lines that edges may lie on.
#pragma once

#include <vector>

#include "echo/chart/gdal/coverage.hpp"
#include "echo/chart/gdal/polygons/box_tree.hpp"
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
  static std::vector<Line> lines_of(const Coverage& coverage);
  static std::vector<PlaneBox> boxes_of(const std::vector<Line>& lines);
  static bool touches(const Line& line, GeoPoint place);

  std::vector<Line> lines_;
  BoxTree tree_;  // of the boxes of lines_ and a bit, each running on from its line's first place
};

}  // namespace skerry::echo
