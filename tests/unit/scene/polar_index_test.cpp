#include "echo/scene/polar_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "echo/returns/coast_crossings.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

// The crossings of a ray with every edge of the picture, one after the other.
std::vector<Crossing> crossings_of_all(const CoastPicture& coast, const Ray& ray) {
  const double bearing = ray.bearing_units * (2.0 * 3.141592653589793 / 4294967296.0);
  const double s = std::sin(bearing), c = std::cos(bearing);
  std::vector<Crossing> out;
  for (std::size_t run = 0; run + 1 < coast.run_starts.size(); ++run) {
    for (std::uint32_t v = coast.run_starts[run]; v + 1 < coast.run_starts[run + 1]; ++v) {
      const PlanePoint a = coast.vertices[v] - ray.own_ship,
                       b = coast.vertices[v + 1] - ray.own_ship;
      const double ra = a.east_m * c - a.north_m * s, rb = b.east_m * c - b.north_m * s;
      if ((ra < 0) == (rb < 0)) continue;
      const double t = ra / (ra - rb);
      const double range =
          (a.east_m * s + a.north_m * c) * (1 - t) + (b.east_m * s + b.north_m * c) * t;
      if (range >= 0) out.push_back({range, ra < 0});
    }
  }
  std::sort(out.begin(), out.end(), [](auto& p, auto& q) { return p.range_m < q.range_m; });
  return out;
}

TEST(PolarIndex, FindsEveryCrossingFromAnywhereWithinItsSlack) {
  const ScanGeometry geometry;
  const auto scene =
      scenes::scene_at(scenes::made_up_chart(scenes::kBergen, nautical_miles(4), 90, 5),
                       scenes::kBergen, *RangeScale::find(3.0), geometry);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Crossing> found;
  std::size_t total = 0;
  for (double slack : {1.0, 50.0, 400.0}) {
    const PolarIndex index(*scene->coast, scene->own_ship, slack);
    for (int i = 0; i < 1500; ++i) {
      const double off = slack * std::sqrt(unit(random)), at = 6.283185 * unit(random);
      const Ray ray{scene->own_ship + PlanePoint{off * std::sin(at), off * std::cos(at)},
                    static_cast<std::uint32_t>(random())};
      ASSERT_TRUE(index.serves(ray.own_ship));
      find_crossings(*scene->coast, index, ray, found);
      const auto all = crossings_of_all(*scene->coast, ray);
      ASSERT_EQ(found.size(), all.size()) << "slack " << slack << ", ray " << i;
      for (std::size_t k = 0; k < all.size(); ++k) {
        EXPECT_NEAR(found[k].range_m, all[k].range_m, 1e-6);
        EXPECT_EQ(found[k].into_land, all[k].into_land);
      }
      total += all.size();
    }
    EXPECT_FALSE(index.serves(scene->own_ship + PlanePoint{slack * 1.01, 0.0}));
  }
  EXPECT_GT(total, 1000u);
}

}  // namespace
}  // namespace skerry::echo
