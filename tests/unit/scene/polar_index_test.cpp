#include "echo/scene/polar_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
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

// Edges of 1 cm to 200 km at 1 cm to 200 km, anyhow turned; rays at random and through their ends.
TEST(PolarIndex, FindsEdgesOfAnyLengthAtAnyDistance) {
  std::mt19937_64 random(23);
  const auto unit = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const auto direction = [&] {
    const double at = random() % 8 == 0 ? std::numbers::pi / 4.0 * static_cast<double>(random() % 8)
                                        : 2.0 * std::numbers::pi * unit();
    return PlanePoint{std::sin(at), std::cos(at)};
  };
  const auto size = [&] { return 0.01 * std::exp2(24.0 * unit()); };
  std::size_t met = 0, listed = 0, rays = 0;
  for (int round = 0; round < 40; ++round) {
    CoastPicture coast{.plane = LocalPlane({0, 0}), .centre = {}, .vertices = {}, .run_starts = {}};
    const PlanePoint own_ship{1000.0 * unit(), -3000.0 * unit()};
    for (int k = 0; k < 300; ++k) {
      coast.run_starts.push_back(static_cast<std::uint32_t>(coast.vertices.size()));
      coast.vertices.push_back(own_ship + direction() * size());
      for (std::uint64_t j = random() % 4; j < 5; ++j)
        coast.vertices.push_back(coast.vertices.back() + direction() * size());
    }
    coast.run_starts.push_back(static_cast<std::uint32_t>(coast.vertices.size()));
    const double slack = round % 4 == 0 ? 0.0 : size();
    const PolarIndex index(coast, own_ship, slack);
    for (int i = 0; i < 150; ++i) {
      const PlanePoint from = own_ship + direction() * (0.999 * slack * unit());
      ASSERT_TRUE(index.serves(from));
      auto bearing = static_cast<std::uint32_t>(random());
      if (i % 2 == 0) {
        const PlanePoint to = coast.vertices[random() % coast.vertices.size()] - from;
        bearing = static_cast<std::uint32_t>(static_cast<std::int64_t>(
                      std::atan2(to.east_m, to.north_m) / std::numbers::pi * 2147483648.0)) +
                  static_cast<std::uint32_t>(random() % 3) - 1u;
      }
      std::vector<bool> known(coast.vertices.size());
      for (std::uint32_t v : index.near_edges()) known[v] = true;
      std::uint32_t last = 0;
      for (std::uint32_t v : index.candidates(bearing)) {
        ASSERT_TRUE(last == 0 || v > last);  // ascending, none twice
        last = v;
        known[v] = true;
        ++listed;
      }
      ++rays;
      const double at = bearing * (std::numbers::pi / 2147483648.0);
      const double s = std::sin(at), c = std::cos(at);
      for (std::size_t run = 0; run + 1 < coast.run_starts.size(); ++run) {
        for (std::uint32_t v = coast.run_starts[run]; v + 1 < coast.run_starts[run + 1]; ++v) {
          const PlanePoint a = coast.vertices[v] - from, b = coast.vertices[v + 1] - from;
          const double ra = a.east_m * c - a.north_m * s, rb = b.east_m * c - b.north_m * s;
          if ((ra < 0) == (rb < 0)) continue;
          const double t = ra / (ra - rb);
          const double range =
              (a.east_m * s + a.north_m * c) * (1 - t) + (b.east_m * s + b.north_m * c) * t;
          if (range < 1e-6) continue;
          ++met;
          ASSERT_TRUE(known[v]) << "round " << round << ", ray " << i << ", slack " << slack;
        }
      }
    }
  }
  std::printf("%zu rays met %zu edges, %zu were listed\n", rays, met, listed);
  EXPECT_GT(met, 100'000u);
  EXPECT_LT(listed, rays * 1000);  // of 1200 edges in runs of random length: some are spared
}

}  // namespace
}  // namespace skerry::echo
