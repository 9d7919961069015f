#include "echo/chart/land_mask.hpp"

namespace skerry::echo {
namespace {

// Degrees east of the meridian `of`, in [-180, 180); the sign near 0 is exact.
double east_of(double of, double longitude) {
  const double d = longitude - of;
  return d >= 180.0 ? d - 360.0 : d < -180.0 ? d + 360.0 : d;
}

}  // namespace

int winding_number(const CoastChart& chart, GeoPoint place) {
  const double meridian = wrapped_longitude(place.longitude_deg);
  int winding = 0;
  for (const CoastRing& ring : chart.rings) {
    if (ring.vertices.empty()) continue;
    GeoPoint a = ring.vertices.back();
    double a_east = east_of(meridian, a.longitude_deg);
    int westward = 0;  // crossings of the whole meridian of `place`: not 0 for a ring around a pole
    for (const GeoPoint b : ring.vertices) {
      const double b_east = east_of(meridian, b.longitude_deg);
      const double run = b_east - a_east;
      // An edge that seems to span half the globe crosses the opposite meridian, not this one.
      if ((a_east < 0.0) != (b_east < 0.0) && run > -180.0 && run < 180.0) {
        const int turn = run < 0.0 ? 1 : -1;
        westward += turn;
        const double crossing = a.latitude_deg - (b.latitude_deg - a.latitude_deg) * (a_east / run);
        if (crossing > place.latitude_deg) winding += turn;
      }
      a = b;
      a_east = b_east;
    }
    // Around the north pole, where the ray ends: the crossing that the pole makes good.
    const bool bounds_land = ring.level % 2 == 1 || ring.level > 4;
    if (bounds_land ? westward < 0 : westward > 0) winding -= westward;
  }
  return winding;
}

}  // namespace skerry::echo
