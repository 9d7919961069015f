#include "echo/chart/gdal/cut_lines.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::echo {

CutLines::CutLines(const Coverage& coverage) {
  double north = -90.0;
  south_ = 90.0;
  for (const CoveragePolygon& polygon : coverage.polygons) {
    for (const std::vector<GeoPoint>& ring : polygon) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const GeoPoint a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
        lines_.push_back({a, wrapped_longitude(b.longitude_deg - a.longitude_deg),
                          b.latitude_deg - a.latitude_deg});
        south_ = std::min(south_, a.latitude_deg);
        north = std::max(north, a.latitude_deg);
      }
    }
  }
  const auto count = static_cast<double>(std::clamp<std::size_t>(lines_.size() / 4, 1, 4096));
  south_ -= 2.0 * kTolerance;
  band_deg_ = std::max(1e-6, (north - south_ + 2.0 * kTolerance) / count);
  bands_.resize(static_cast<std::size_t>(count) + 1);
  for (std::uint32_t k = 0; k < lines_.size(); ++k) {
    const double a = lines_[k].from.latitude_deg, b = a + lines_[k].rise_deg;
    const auto first =
        static_cast<std::size_t>(std::max(0.0, (std::min(a, b) - kTolerance - south_) / band_deg_));
    const auto last = static_cast<std::size_t>((std::max(a, b) + kTolerance - south_) / band_deg_);
    for (std::size_t band = first; band <= last && band < bands_.size(); ++band)
      bands_[band].push_back(k);
  }
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
  const double place = (a.latitude_deg - south_) / band_deg_;
  if (!(place >= 0.0) || place >= static_cast<double>(bands_.size())) return false;
  for (const std::uint32_t k : bands_[static_cast<std::size_t>(place)]) {
    if (touches(lines_[k], a) && touches(lines_[k], b)) return true;
  }
  return false;
}

}  // namespace skerry::echo
