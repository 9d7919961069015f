// Against winding_number() over the whole chart.
#include "echo/chart/land_lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "echo/chart/land_mask.hpp"

namespace skerry::echo {
namespace {

CoastRing ring_around(GeoPoint centre, double radius, int n, std::mt19937& random, int level) {
  CoastRing ring;
  ring.level = static_cast<std::uint8_t>(level);
  for (int i = 0; i < n; ++i) {
    const double r = radius * std::uniform_real_distribution<>(0.98, 1.0)(random);
    const double turn = (level == 1 ? 1 : -1) * 2.0 * M_PI * i / n;
    ring.vertices.push_back({centre.latitude_deg + r * std::sin(turn),
                             wrapped_longitude(centre.longitude_deg + r * std::cos(turn))});
  }
  return ring;
}

TEST(LandLookup, SaysWhatTheWindingNumberSays) {
  std::mt19937 random(5);
  for (const double longitude : {-1.0, 179.98, -179.99}) {
    CoastChart chart;
    const GeoPoint centre{50.0, longitude};
    chart.rings.push_back(ring_around(centre, 0.2, 3000, random, 1));
    chart.rings.push_back(ring_around(centre, 0.05, 500, random, 2));
    chart.rings.push_back(ring_around({50.3, longitude}, 0.1, 7, random, 1));
    CoastRing wide;  // edges far wider than the lookup
    for (const double lon : {-30.0, 30.0, 90.0, 150.0, -150.0, -90.0})
      wide.vertices.push_back({70.0, lon});
    chart.rings.push_back(wide);
    const LandLookup lookup(chart.rings, wrapped_longitude(longitude - 0.1), 0.2, 49.9);
    int land = 0;
    std::size_t cost = 0;
    for (int i = 0; i < 20'000; ++i) {
      const GeoPoint p{std::uniform_real_distribution<>(49.9, 50.2)(random),
                       wrapped_longitude(std::uniform_real_distribution<>(
                           longitude - 0.1, longitude + 0.1)(random))};
      EXPECT_EQ(lookup.winding_number(p), winding_number(chart, p));
      land += lookup.is_land(p);
      cost += lookup.cost(p);
    }
    EXPECT_GT(land, 1000);
    EXPECT_LT(cost / 20'000, 100u) << "edges looked at for a place, of 3513";
  }
}

}  // namespace
}  // namespace skerry::echo
