#include "echo/returns/ground_track.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>

namespace skerry::echo {
namespace {

double metres_between(GeoPoint a, GeoPoint b) {
  double s = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(a.latitude_deg, a.longitude_deg, b.latitude_deg,
                                           b.longitude_deg, s);
  return s;
}

std::uint32_t units(double degrees) {
  return static_cast<std::uint32_t>(std::floor(degrees / 360.0 * 4294967296.0));
}

TEST(GroundTrack, FollowsTheGeodesicWithinItsBound) {
  double worst = 0.0, worst_share = 0.0;
  for (const double latitude : {-89.4, -80.0, -33.0, 0.0, 45.0, 60.27, 80.0, 89.4}) {
    for (const double longitude : {5.15, 179.9, -179.9}) {
      for (double bearing = 0.0; bearing < 360.0; bearing += 7.5) {
        const GroundTrack track({latitude, longitude}, {}, units(bearing));
        for (const double nm : {0.0, 0.01, 0.25, 3.0, 12.0, 24.0, 48.0, 96.0}) {
          const double range = nm * 1852.0;
          GeoPoint exact;
          GeographicLib::Geodesic::WGS84().Direct(latitude, longitude,
                                                  units(bearing) / 4294967296.0 * 360.0, range,
                                                  exact.latitude_deg, exact.longitude_deg);
          const double off = metres_between(exact, track.at(range));
          worst = std::max(worst, off);
          worst_share = std::max(worst_share, off / GroundTrack::bound_m(range));
          ASSERT_LE(off, GroundTrack::bound_m(range))
              << latitude << " deg, bearing " << bearing << ", " << nm << " NM";
        }
      }
    }
  }
  std::printf("ground track off by %.4f m at most, %.0f %% of its bound\n", worst,
              100.0 * worst_share);
}

// Sailed 30 m north and 40 m east, the ray begins there and goes on as it would.
TEST(GroundTrack, BeginsWhereTheOwnShipHasSailed) {
  const GeoPoint start{60.0, 5.0};
  const GroundTrack track(start, {40.0, 30.0}, units(90.0));
  EXPECT_NEAR(metres_between(start, track.at(0.0)), 50.0, 0.01);
  const GroundTrack still(start, {0.0, 0.0}, units(90.0));
  EXPECT_NEAR(metres_between(still.at(5000.0), track.at(5000.0)), 50.0, 0.2);
}

TEST(GroundTrack, RunsOnAcrossTheAntimeridian) {
  const GroundTrack track({-16.75, 179.99}, {}, units(90.0));
  EXPECT_GT(track.at(20000.0).longitude_deg, 180.0);
}

}  // namespace
}  // namespace skerry::echo
