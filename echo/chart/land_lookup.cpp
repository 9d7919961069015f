#include "echo/chart/land_lookup.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::echo {
namespace {

// Degrees east of the meridian `of`, in [-180, 180); the sign near 0 is exact.
double degrees_east(double of, double longitude) {
  const double d = longitude - of;
  return d >= 180.0 ? d - 360.0 : d < -180.0 ? d + 360.0 : d;
}

}  // namespace

LandLookup::LandLookup(const std::vector<CoastRing>& rings, double west_deg, double width_deg,
                       double south_deg)
    : rings_(rings), west_deg_(west_deg), width_deg_(std::max(1e-9, width_deg)) {
  constexpr double kSlack = 1e-6;  // of a column, against rounding
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    const std::vector<GeoPoint>& ring = rings[r].vertices;
    double way = 0.0;
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
      const GeoPoint a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
      const double run = wrapped_longitude(b.longitude_deg - a.longitude_deg);
      way += run;
      if (std::max(a.latitude_deg, b.latitude_deg) < south_deg) continue;
      const double per_column = width_deg_ / static_cast<double>(kColumns);
      const double from = column_of(std::min(a.longitude_deg, a.longitude_deg + run));
      const double wide = std::abs(run) / per_column;
      if (!(wide < static_cast<double>(kWide))) {
        wide_.push_back({r, i});
        continue;
      }
      // Once as it lies, once a turn west of it, where it reaches round into the first columns.
      for (const double turn : {0.0, 360.0 / per_column}) {
        const double first = std::max(0.0, std::floor(from - turn - kSlack));
        const double last =
            std::min(static_cast<double>(kColumns) - 1.0, std::floor(from - turn + wide + kSlack));
        for (double c = first; c <= last; c += 1.0)
          columns_[static_cast<std::size_t>(c)].push_back({r, i});
      }
    }
    const auto westward = static_cast<int>(-std::lround(way / 360.0));
    const bool bounds_land = rings[r].level % 2 == 1 || rings[r].level > 4;
    if (bounds_land ? westward < 0 : westward > 0) around_pole_ -= westward;
  }
}

double LandLookup::column_of(double longitude_deg) const {
  const double east = wrapped_longitude(longitude_deg - west_deg_ - 180.0) + 180.0;
  return east / width_deg_ * static_cast<double>(kColumns);
}

const std::vector<LandLookup::Edge>& LandLookup::column(GeoPoint place) const {
  return columns_[std::min(kColumns - 1, static_cast<std::size_t>(column_of(place.longitude_deg)))];
}

int LandLookup::turn_of(const Edge& edge, GeoPoint place) const {
  const std::vector<GeoPoint>& ring = rings_[edge.first].vertices;
  const double meridian = wrapped_longitude(place.longitude_deg);
  const GeoPoint a = ring[edge.second],
                 b = ring[edge.second + 1 == ring.size() ? 0 : edge.second + 1];
  const double a_east = degrees_east(meridian, a.longitude_deg);
  const double b_east = degrees_east(meridian, b.longitude_deg);
  const double run = b_east - a_east;
  if ((a_east < 0.0) == (b_east < 0.0) || !(run > -180.0 && run < 180.0)) return 0;
  const double crossing = a.latitude_deg - (b.latitude_deg - a.latitude_deg) * (a_east / run);
  return crossing > place.latitude_deg ? (run < 0.0 ? 1 : -1) : 0;
}

int LandLookup::winding_number(GeoPoint place) const {
  int winding = around_pole_;
  for (const Edge& edge : column(place)) winding += turn_of(edge, place);
  for (const Edge& edge : wide_) winding += turn_of(edge, place);
  return winding;
}

}  // namespace skerry::echo
