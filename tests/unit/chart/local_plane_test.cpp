#include "echo/chart/local_plane.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>
#include <random>

namespace skerry::echo {
namespace {

using GeographicLib::Geodesic;

struct Polar {
  double range, bearing;
};
Polar polar_of(PlanePoint p) {
  return {std::hypot(p.east_m, p.north_m), std::atan2(p.east_m, p.north_m) * 57.29577951308232};
}
GeoPoint sailed(GeoPoint from, double bearing, double metres) {
  GeoPoint p;
  Geodesic::WGS84().Direct(from.latitude_deg, from.longitude_deg, bearing, metres, p.latitude_deg,
                           p.longitude_deg);
  return p;
}

TEST(LocalPlane, RangeAndBearingMatchTheGeodesic) {
  for (const auto& [nm, range_bound] : {std::pair{24.0, 0.02}, std::pair{96.0, 0.1}}) {
    double worst_range = 0.0, worst_bearing = 0.0;
    for (double lat : {-89.0, -60.0, 0.0, 33.0, 60.3, 80.0, 89.9}) {
      const GeoPoint anchor{lat, 179.95};
      const LocalPlane plane(anchor);
      for (double bearing = -180.0; bearing < 180.0; bearing += 7.0) {
        const Polar p = polar_of(plane.to_plane(sailed(anchor, bearing, nm * 1852.0)));
        worst_range = std::max(worst_range, std::fabs(p.range - nm * 1852.0));
        worst_bearing =
            std::max(worst_bearing, std::fabs(std::remainder(p.bearing - bearing, 360.0)));
      }
    }
    std::printf("%g NM: range off by %.4f m, bearing by %.2g deg\n", nm, worst_range,
                worst_bearing);
    EXPECT_LE(worst_range, range_bound);
    EXPECT_LE(worst_bearing, 1e-4);
  }
}

TEST(LocalPlane, FromAnOwnShipOffTheAnchorToo) {
  double worst_range = 0.0, worst_bearing = 0.0;
  for (double lat : {-60.0, 0.0, 60.3, 80.0}) {
    const GeoPoint anchor{lat, -179.98};
    const LocalPlane plane(anchor);
    for (double off = 0.0; off < 360.0; off += 45.0) {
      const GeoPoint ship = sailed(anchor, off, 5000.0);
      const PlanePoint at = plane.to_plane(ship);
      const double north = plane.true_north_degrees(ship);
      for (double bearing = 0.0; bearing < 360.0; bearing += 11.0) {
        const Polar p = polar_of(plane.to_plane(sailed(ship, bearing, 96 * 1852.0)) - at);
        worst_range = std::max(worst_range, std::fabs(p.range - 96 * 1852.0));
        worst_bearing =
            std::max(worst_bearing, std::fabs(std::remainder(p.bearing - north - bearing, 360.0)));
      }
    }
  }
  std::printf("5 km off the anchor, 96 NM: range off by %.3f m, bearing by %.2g deg\n", worst_range,
              worst_bearing);
  EXPECT_LE(worst_range, 0.3);
  EXPECT_LE(worst_bearing, 6e-4);
}

TEST(LocalPlane, GoesThereAndBack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> metres(-150000.0, 150000.0);
  const LocalPlane plane({-16.75, 179.9});
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const PlanePoint p{metres(random), metres(random)};
    const PlanePoint d = plane.to_plane(plane.to_geo(p)) - p;
    worst = std::max(worst, std::hypot(d.east_m, d.north_m));
  }
  std::printf("there and back: %.3g m\n", worst);
  EXPECT_LE(worst, 0.4);
  EXPECT_EQ(plane.to_plane({-16.75, 179.9}), (PlanePoint{0.0, 0.0}));
}

TEST(LocalPlane, NorthAtTheAnchorIsUpAndConvergesBesideIt) {
  const LocalPlane plane({60.0, 5.0});
  EXPECT_NEAR(plane.true_north_degrees({60.0, 5.0}), 0.0, 1e-9);
  const GeoPoint east = sailed({60.0, 5.0}, 90.0, 5000.0);
  EXPECT_NEAR(plane.true_north_degrees(east), -0.078, 0.001);
}

}  // namespace
}  // namespace skerry::echo
