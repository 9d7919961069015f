#include "echo/chart/gdal/polygons/cut_lines.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::echo {

CutLines::CutLines(const Coverage& coverage)
    : lines_(lines_of(coverage)), tree_(boxes_of(lines_)) {}

std::vector<CutLines::Line> CutLines::lines_of(const Coverage& coverage) {
  std::vector<Line> lines;
  for (const CoveragePolygon& polygon : coverage.polygons) {
    for (const std::vector<GeoPoint>& ring : polygon) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const GeoPoint a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
        lines.push_back({a, wrapped_longitude(b.longitude_deg - a.longitude_deg),
                         b.latitude_deg - a.latitude_deg});
      }
    }
  }
  return lines;
}

std::vector<PlaneBox> CutLines::boxes_of(const std::vector<Line>& lines) {
  constexpr double kAround = 2.0 * kTolerance;
  std::vector<PlaneBox> boxes;
  boxes.reserve(lines.size());
  for (const Line& line : lines) {
    const double x = line.from.longitude_deg, y = line.from.latitude_deg;
    boxes.push_back(
        {x + std::min(0.0, line.run_deg) - kAround, y + std::min(0.0, line.rise_deg) - kAround,
         x + std::max(0.0, line.run_deg) + kAround, y + std::max(0.0, line.rise_deg) + kAround});
  }
  return boxes;
}

bool CutLines::touches(const Line& line, GeoPoint place) {
  const double x = wrapped_longitude(place.longitude_deg - line.from.longitude_deg);
  const double y = place.latitude_deg - line.from.latitude_deg;
  const double length2 = line.run_deg * line.run_deg + line.rise_deg * line.rise_deg;
  const double along =
      length2 > 0.0 ? std::clamp((x * line.run_deg + y * line.rise_deg) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - along * line.run_deg, y - along * line.rise_deg) <= kTolerance;
}

bool CutLines::carries(GeoPoint a, GeoPoint b) const {
  const auto both = [&](std::uint32_t k) { return touches(lines_[k], a) && touches(lines_[k], b); };
  for (const double turn : {-360.0, 0.0, 360.0}) {
    const double x = a.longitude_deg + turn;
    if (tree_.find({x, a.latitude_deg, x, a.latitude_deg}, both)) return true;
  }
  return false;
}

}  // namespace skerry::echo
