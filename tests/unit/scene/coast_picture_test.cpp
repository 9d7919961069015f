#include "echo/scene/coast_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "echo/assembly/scene_maker.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "protocol/video/range_scale.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/unit/scene/coast_helpers.hpp"

namespace skerry::echo {
namespace {

using test::resolution;
using test::VertexSet;

VertexSet vertices_within(const CoastPicture& picture, double within_m) {
  VertexSet set;
  for (const PlanePoint& v : picture.vertices) {
    const PlanePoint d = v - picture.centre;
    if (std::hypot(d.east_m, d.north_m) < within_m) set.insert({v.east_m, v.north_m});
  }
  return set;
}

TEST(CoastPicture, AFinerPictureKeepsEveryVertexOfACoarserOne) {
  CoastPreparer preparer(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 80, 3),
                         scenes::kBergen, echo::CoastRules{.seed = 1});
  VertexSet before;
  for (double nm : {6.0, 3.0, 1.5, 0.75, 0.25}) {
    const auto picture = preparer.prepare(scenes::kBergen, resolution(nm));
    const double within = nm * 1852.0 * 0.5;
    const VertexSet fine = vertices_within(*picture, within);
    for (const auto& v : before) {
      if (std::hypot(v.first, v.second) >= within) continue;
      EXPECT_TRUE(fine.count(v)) << nm;
    }
    before = fine;
  }
}

TEST(CoastPicture, HasTheRaconsOfTheChartForEveryScene) {
  CoastChart chart = scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 80, 3);
  ChartObject racon;
  racon.kind = ObjectClass::racon;
  racon.height_m = 12.0f;
  racon.racon_code = "Q";
  racon.outline = {{scenes::kBergen.latitude_deg + 1.0 / 60.0, scenes::kBergen.longitude_deg}};
  chart.objects.push_back(racon);
  racon.outline = {{scenes::kBergen.latitude_deg + 5.0 / 60.0, scenes::kBergen.longitude_deg}};
  chart.objects.push_back(racon);
  CoastPreparer preparer(chart, scenes::kBergen, echo::CoastRules{.seed = 1});
  const auto scene = scene_of(preparer.prepare(scenes::kBergen, resolution(3)),
                              {.position = scenes::kBergen}, 20.0);
  ASSERT_EQ(scene->racons.size(), 1u) << "the other is out of range";
  EXPECT_EQ(scene->racons[0].code, "Q");
  EXPECT_EQ(scene->racons[0].height_m, 12.0);
  EXPECT_NEAR(length_of(scene->racons[0].place - scene->own_ship), 1857.0, 5.0);
}

TEST(CoastPicture, IsTheSameCoastSeenFromElsewhere) {
  CoastPreparer preparer(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 80, 3),
                         scenes::kBergen, echo::CoastRules{.seed = 1});
  const auto here = preparer.prepare(scenes::kBergen, resolution(3));
  const auto there = preparer.prepare({60.28, 5.16}, resolution(3));
  // Near both, both stop at half a cell; only at the edges of their slack do they differ.
  const VertexSet a = vertices_within(*here, 2000), b = vertices_within(*there, 6000);
  std::size_t common = 0;
  for (const auto& v : a) common += b.count(v);
  EXPECT_GT(a.size(), 1000u);
  EXPECT_EQ(common, a.size());
}

TEST(CoastPicture, AnotherAnchorMovesNoVertexByMoreThanMillimetres) {
  const auto chart = scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 80, 3);
  CoastPreparer one(chart, scenes::kBergen, echo::CoastRules{.seed = 1});
  CoastPreparer two(chart, {60.32, 5.10}, echo::CoastRules{.seed = 1});
  const auto a = one.prepare(scenes::kBergen, resolution(1.5));
  const auto b = two.prepare(scenes::kBergen, resolution(1.5));
  const auto count = static_cast<double>(a->vertices.size());
  ASSERT_NEAR(static_cast<double>(b->vertices.size()), count, 0.002 * count);
  // Each vertex of b, laid into a's plane, has one of a within millimetres.
  std::vector<PlanePoint> sorted = a->vertices;
  const auto by_east = [](PlanePoint p, PlanePoint q) { return p.east_m < q.east_m; };
  std::sort(sorted.begin(), sorted.end(), by_east);
  double worst = 0.0;
  std::size_t matched = 0;
  for (const PlanePoint& v : b->vertices) {
    const PlanePoint p = a->plane.to_plane(b->plane.to_geo(v));
    double nearest = 1e9;
    for (auto it = std::lower_bound(sorted.begin(), sorted.end(), p - PlanePoint{0.05, 0}, by_east);
         it != sorted.end() && it->east_m < p.east_m + 0.05; ++it) {
      nearest = std::min(nearest, std::hypot(p.east_m - it->east_m, p.north_m - it->north_m));
    }
    if (nearest > 0.05) continue;  // refined once more or less: the two differ in a last decision
    ++matched;
    worst = std::max(worst, nearest);
  }
  std::printf("%zu of %zu vertices matched, worst %.2g m\n", matched, b->vertices.size(), worst);
  EXPECT_GT(static_cast<double>(matched), 0.995 * count);
  EXPECT_LE(worst, 0.005);
}

TEST(CoastPicture, DetailStopsAtTheRadarsResolution) {
  CoastPreparer preparer(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 80, 3),
                         scenes::kBergen, echo::CoastRules{.seed = 1});
  std::size_t before = 0;
  for (std::uint32_t cells : {256u, 1024u, 4096u}) {
    const auto picture = preparer.prepare(scenes::kBergen, resolution(3, cells, 8192));
    std::printf("3 NM, %u cells: %u edges\n", cells, picture->edge_count());
    EXPECT_GT(picture->edge_count(), before);
    before = picture->edge_count();
  }
}

TEST(CoastPicture, BergenIsRefinedAtEveryRangeScale) {
  auto chart = scenes::world_chart(scenes::kBergen, nautical_miles(125));
  if (!chart) GTEST_SKIP() << "no chart installed";
  CoastPreparer preparer(std::move(*chart), scenes::kBergen, echo::CoastRules{.seed = 1});
  for (double nm : RangeScale::kNauticalMiles) {
    const auto picture = preparer.prepare(scenes::kBergen, resolution(nm));
    std::printf("Bergen %g NM: %u edges\n", nm, picture->edge_count());
    EXPECT_FALSE(picture->centre_ashore);
    for (const PlanePoint& v : picture->vertices) {
      ASSERT_TRUE(std::isfinite(v.east_m) && std::isfinite(v.north_m));
    }
    EXPECT_LT(picture->edge_count(), 1'000'000u);
  }
}

TEST(CoastPicture, ServesOnlyWhereTheChartReaches) {
  CoastPreparer preparer(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 5, 3),
                         scenes::kBergen, echo::CoastRules{.seed = 1});
  EXPECT_TRUE(preparer.serves(scenes::kBergen, nautical_miles(6).in_metres()));
  EXPECT_FALSE(preparer.serves(scenes::kBergen, nautical_miles(12).in_metres()));
  EXPECT_FALSE(preparer.serves({60.40, 5.05}, nautical_miles(0.25).in_metres()));
}

}  // namespace
}  // namespace skerry::echo
