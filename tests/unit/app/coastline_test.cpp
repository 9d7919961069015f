// The shore as instructors draw it.
#include "server/app/coastline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

wire::GetCoastline about(double latitude_deg, double longitude_deg, double radius_nm) {
  wire::GetCoastline place;
  place.set_latitude_deg(latitude_deg);
  place.set_longitude_deg(longitude_deg);
  place.set_radius_nm(radius_nm);
  return place;
}

// A ring of `vertices` places, `radius_deg` of latitude round a centre.
echo::CoastRing ring(std::uint8_t level, GeoPoint centre, double radius_deg, int vertices) {
  echo::CoastRing ring;
  ring.level = level;
  const double parallel = std::cos(centre.latitude_deg * M_PI / 180.0);
  for (int i = 0; i < vertices; ++i) {
    const double turn = 2.0 * M_PI * i / vertices;
    ring.vertices.push_back(
        {centre.latitude_deg + radius_deg * std::cos(turn),
         wrapped_longitude(centre.longitude_deg + radius_deg / parallel * std::sin(turn))});
  }
  return ring;
}

std::vector<GeoPoint> points_of(const wire::Coastline& coast, int line) {
  std::vector<GeoPoint> points;
  std::int64_t east = 0, north = 0;
  const auto& told = coast.lines(line).points();
  for (int i = 0; i + 1 < told.size(); i += 2) {
    east += told[i];
    north += told[i + 1];
    points.push_back({coast.latitude_deg() + 1e-6 * static_cast<double>(north),
                      wrapped_longitude(coast.longitude_deg() + 1e-6 * static_cast<double>(east))});
  }
  return points;
}

TEST(Coastline, HasEveryPlaceToTheirLastDigitLandBeforeTheLakesInIt) {
  echo::CoastChart chart;
  chart.source = "made up";
  chart.rings = {ring(2, {60.0, 179.99}, 0.02, 12), ring(1, {60.0, 179.99}, 0.05, 40)};
  const wire::Coastline coast = coastline_of(chart, about(60.0, 179.99, 10.0));
  EXPECT_EQ(coast.chart(), "made up");
  ASSERT_EQ(coast.lines_size(), 2);
  EXPECT_FALSE(coast.lines(0).water());
  EXPECT_TRUE(coast.lines(1).water());
  const std::vector<GeoPoint> land = points_of(coast, 0);
  ASSERT_EQ(land.size(), 40u);
  for (std::size_t i = 0; i < land.size(); ++i) {
    const GeoPoint& is = chart.rings[1].vertices[i];
    EXPECT_NEAR(land[i].latitude_deg, is.latitude_deg, 1e-6);
    EXPECT_NEAR(wrapped_longitude(land[i].longitude_deg - is.longitude_deg), 0.0, 1e-6)
        << "across the date line too";
  }
}

TEST(Coastline, IsCutAtTheSquareAndLeavesOutWhatIsBeyond) {
  echo::CoastChart chart;
  chart.rings = {ring(1, {50.0, 0.0}, 2.0, 400), ring(1, {53.0, 0.0}, 0.1, 20)};
  const wire::Coastline coast = coastline_of(chart, about(51.9, 0.0, 12.0));
  ASSERT_EQ(coast.lines_size(), 1);
  double northmost = -90.0, southmost = 90.0;
  for (const GeoPoint& point : points_of(coast, 0)) {
    northmost = std::max(northmost, point.latitude_deg);
    southmost = std::min(southmost, point.latitude_deg);
    EXPECT_LE(std::fabs(point.latitude_deg - 51.9), 0.2 + 1e-5);
  }
  EXPECT_NEAR(northmost, 52.0, 1e-3) << "the shore";
  EXPECT_NEAR(southmost, 51.7, 1e-5) << "the square";
}

TEST(Coastline, HasAtMostSoManyPoints) {
  echo::CoastChart chart;
  chart.rings = {ring(1, {60.0, 5.0}, 0.15, 100'000)};
  const auto count = [&](std::size_t most) {
    const wire::Coastline coast = coastline_of(chart, about(60.0, 5.0, 10.0), most);
    return std::pair(coast.lines_size() == 0 ? 0 : coast.lines(0).points_size() / 2,
                     coast.detail_m());
  };
  const auto [all, fine_m] = count(200'000);
  EXPECT_NEAR(fine_m, 2.0 * 10.0 * 1852.0 / 4000.0, 1e-9);
  EXPECT_GT(all, 5000);
  const auto [few, rough_m] = count(1000);
  EXPECT_LE(few, 1000);
  EXPECT_GT(few, 300);
  EXPECT_GT(rough_m, fine_m);
}

}  // namespace
}  // namespace skerry::server
