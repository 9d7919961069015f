#include "server/world/rhumb_step.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Rhumb.hpp>
#include <cstdio>
#include <random>

#include "protocol/quantity/angle.hpp"
#include "tests/unit/world/geodesy.hpp"

namespace skerry::server {
namespace {

// The rhumb line made of geodesics of 5 cm, each begun on the course: two methods that share
// nothing.  A geodesic leaves the rhumb line by s^2 tan(latitude) / 2R, 3e-9 m per step here at
// most, which adds up over the way to way * s tan(latitude) / 2R.
TEST(RhumbStep, MatchesManyShortGeodesics) {
  double worst = 0.0;
  for (const double latitude : {0.0, 60.4, -75.0, 85.0}) {
    for (const double course : {0.0, 33.0, 90.0, 162.6, 251.0, 359.9}) {
      GeoPoint fine{latitude, 5.0};
      constexpr double kStep = 0.05, kWay = 200.0;
      for (int i = 0; i < static_cast<int>(kWay / kStep); ++i) {
        fine = geodesic_step(fine, course, kStep);
      }
      const double apart = metres_between(advanced({latitude, 5.0}, course, kWay).position, fine);
      worst = std::max(worst, apart);
      const double bound =
          kWay * kStep * std::tan(std::fabs(latitude) * 3.14159 / 180) / (2 * 6.35e6);
      EXPECT_LT(apart, bound + 1e-5 /* 4000 roundings of degrees */) << latitude << ' ' << course;
    }
  }
  std::printf("rhumb line against geodesics of 5 cm, 200 m: worst %.2e m\n", worst);
}

TEST(RhumbStep, AnHourOfTicksIsOneRhumbLine) {
  double worst = 0.0;
  for (const double latitude : {-80.0, 0.0, 60.4, 85.0}) {
    for (const double course : {0.0, 47.0, 90.0, 162.6, 270.0, 301.0}) {
      const GeoPoint start{latitude, 179.9};
      GeoPoint ticked = start;
      for (int i = 0; i < 36'000; ++i) ticked = advanced(ticked, course, 3.1).position;
      GeoPoint once;
      GeographicLib::Rhumb::WGS84().Direct(latitude, 179.9, course, 36'000 * 3.1, once.latitude_deg,
                                           once.longitude_deg);
      worst = std::max(worst, metres_between(ticked, once));
    }
  }
  std::printf("36000 ticks against one rhumb line of an hour at 31 m/s: worst %.2e m\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(RhumbStep, CrossesTheAntimeridianBothWays) {
  const RhumbEnd east = advanced({10.0, 179.9999}, 90.0, 100.0);
  EXPECT_LT(east.position.longitude_deg, -179.99);
  EXPECT_DOUBLE_EQ(east.position.latitude_deg, 10.0);
  const RhumbEnd west = advanced(east.position, 270.0, 100.0);
  EXPECT_LT(metres_between(west.position, {10.0, 179.9999}), 1e-7);
  EXPECT_TRUE(is_sane(advanced({0.0, 180.0}, 0.0, 0.0).position));
  EXPECT_EQ(advanced({0.0, 180.0}, 0.0, 0.0).position.longitude_deg, -180.0);
}

TEST(RhumbStep, GoesStraightOnOverAPole) {
  const GeoPoint start{89.999, 20.0};  // 111.7 m from the pole
  const RhumbEnd end = advanced(start, 0.0, 300.0);
  EXPECT_TRUE(end.over_pole);
  EXPECT_NEAR(end.position.longitude_deg, -160.0, 1e-9);
  EXPECT_NEAR(metres_between(start, end.position), 300.0, 1e-6);
  EXPECT_FALSE(advanced(start, 0.0, 100.0).over_pole);
  const RhumbEnd astern = advanced({-89.999, 20.0}, 0.0, -300.0);
  EXPECT_TRUE(astern.over_pole);
  EXPECT_NEAR(metres_between({-89.999, 20.0}, astern.position), 300.0, 1e-6);
}

TEST(RhumbStep, IsAlwaysAPlaceOnEarth) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200'000; ++i) {
    const double polar = std::pow(10.0, -14.0 * unit(random));  // log-uniform to the pole
    const double latitude = (unit(random) < 0.5 ? -1.0 : 1.0) * (90.0 - 90.0 * polar);
    const GeoPoint from{i % 100 == 0 ? std::copysign(90.0, latitude) : latitude,
                        unit(random) * 360.0 - 180.0};
    const double course = i % 7 == 0 ? 90.0 * (i % 4) : 360.0 * unit(random);
    const double way = std::pow(10.0, 16.0 * unit(random) - 9.0) * (i % 2 == 0 ? 1.0 : -1.0);
    const GeoPoint to = advanced(from, course, way).position;
    ASSERT_TRUE(is_sane(to)) << from.latitude_deg << ' ' << from.longitude_deg << ' ' << course
                             << ' ' << way;
    // However a rhumb line winds, it is no longer than its length.
    ASSERT_LE(metres_between(from, to), std::fabs(way) * (1 + 1e-9) + 1e-6);
  }
}

TEST(RhumbStep, CoursesWrap) {
  EXPECT_EQ(wrapped_degrees(0.0), 0.0);
  EXPECT_EQ(wrapped_degrees(360.0), 0.0);
  EXPECT_EQ(wrapped_degrees(-90.0), 270.0);
  EXPECT_EQ(wrapped_degrees(725.0), 5.0);
  EXPECT_EQ(wrapped_degrees(-1e-300), 0.0);
  EXPECT_FALSE(std::signbit(wrapped_degrees(-360.0)));
  EXPECT_LT(wrapped_degrees(1e18), 360.0);
}

}  // namespace
}  // namespace skerry::server
