// The type of an edge by the chart, the scenario and the coast's own shape.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "echo/kernel/hash.hpp"
#include "echo/scene/coast_edges.hpp"
#include "echo/scene/shore_guess.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/unit/scene/coast_helpers.hpp"

namespace skerry::echo {
namespace {

using namespace test;

// A square of 1 km about 2 km east of the middle, one side of each type.
CoastChart square_of_types() {
  CoastChart c = chart({ring(kMiddle, {{1500, -500}, {2500, -500}, {2500, 500}, {1500, 500}})});
  c.shores = {{CoastType::artificial, 4.0f},
              {CoastType::rocky, 0.0f},
              {CoastType::sandy, 0.0f},
              {CoastType::unknown, 2.5f}};
  c.rings[0].shores = {0, 1, 2, 3};
  return c;
}

TEST(CoastTypes, OfTheChartChooseStyleAndShore) {
  CoastPreparer preparer(square_of_types(), kMiddle, CoastRules{.seed = 1});
  CoastPreparer straight(square_of_types(), kMiddle, all_by(CoastMethod::straight));
  const auto picture = preparer.prepare(kMiddle, resolution(3));
  const auto chains = chains_of(*picture, *straight.prepare(kMiddle, resolution(3)));
  ASSERT_EQ(chains.size(), 4u);
  const CoastType types[] = {CoastType::artificial, CoastType::rocky, CoastType::sandy,
                             CoastType::unknown};
  const float heights[] = {4.0f, 0.0f, 0.0f, 2.5f};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(chains[k].points.size() == 2, types[k] == CoastType::artificial) << k;
    for (std::size_t i = 0; i + 1 < chains[k].points.size(); ++i) {
      const PictureShore shore =
          picture->shores[picture->shore_of(chains[k].first + static_cast<std::uint32_t>(i))];
      EXPECT_EQ(shore, (PictureShore{types[k], false, heights[k]})) << k;
    }
  }
  // Flat sand (dimension 1.05) is the smoother one.
  EXPECT_LT(chains[2].points.size(), chains[1].points.size());
}

TEST(CoastTypes, APlaceWinsOverTheChartAndALaterOneOverAnEarlier) {
  CoastRules rules{.seed = 1};
  const GeoPoint south = place(kMiddle, 2000, -500), east = place(kMiddle, 2500, 0);
  rules.places = {{south, 300.0, CoastType::sandy, CoastStyle{.method = CoastMethod::midpoint}},
                  {east, 300.0, CoastType::artificial, std::nullopt},
                  {south, 300.0, CoastType::rocky, std::nullopt}};
  const LocalPlane plane(kMiddle);
  const CoastEdges laid = lay_edges(square_of_types(), plane, rules);
  ASSERT_EQ(laid.edges.size(), 4u);
  const auto type = [&](std::size_t e) { return laid.kinds[laid.shores[e]].type; };
  const auto method = [&](std::size_t e) { return laid.all_styles[laid.styles[e]].method; };
  EXPECT_EQ(type(0), CoastType::rocky);
  EXPECT_EQ(method(0), CoastMethod::midpoint);
  EXPECT_EQ(laid.kinds[laid.shores[0]].height_m, 4.0f);
  EXPECT_EQ(type(1), CoastType::artificial);
  EXPECT_EQ(method(1), CoastMethod::straight);
  EXPECT_EQ(type(2), CoastType::sandy);
  // The middle decides: 290 m from the south side's middle is in, 310 m is not.
  rules.places = {{place(kMiddle, 2000, -790), 300.0, CoastType::sandy, std::nullopt},
                  {place(kMiddle, 2810, 0), 300.0, CoastType::sandy, std::nullopt}};
  const CoastEdges other = lay_edges(square_of_types(), plane, rules);
  EXPECT_EQ(other.kinds[other.shores[0]].type, CoastType::sandy);
  EXPECT_EQ(other.kinds[other.shores[1]].type, CoastType::rocky);
}

// A closed curve of dimension well over 1.1: midpoints thrown aside by a quarter.
CoastRing rough_ring(PlanePoint middle) {
  std::vector<PlanePoint> line;
  for (int k = 0; k < 4; ++k)
    line.push_back(middle +
                   PlanePoint{k == 0 || k == 3 ? -4000.0 : 4000.0, k < 2 ? -4000.0 : 4000.0});
  for (int level = 0; level < 6; ++level) {
    std::vector<PlanePoint> finer;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const PlanePoint a = line[i], along = line[(i + 1) % line.size()] - a;
      const double side = (mixed(77, line.size(), i) & 1u) ? 0.25 : -0.25;
      finer.push_back(a);
      finer.push_back(a + along * 0.5 + PlanePoint{-along.north_m, along.east_m} * side);
    }
    line = std::move(finer);
  }
  return ring(kMiddle, line);
}

std::vector<CoastType> types_of(const CoastChart& c, GeoPoint anchor) {
  const CoastEdges laid = lay_edges(c, LocalPlane(anchor), CoastRules{});
  std::vector<CoastType> types;
  for (std::uint8_t s : laid.shores) types.push_back(laid.kinds[s].type);
  return types;
}

TEST(ShoreGuess, RoughCoastIsRockySmoothCoastSandyShortCoastUnknown) {
  EXPECT_THAT(types_of(chart({rough_ring({9000, 0})}), kMiddle), testing::Each(CoastType::rocky));
  // A bay of 12 km radius in edges of 190 m: its bend is a thousandth of a ruler's.
  EXPECT_THAT(types_of(chart({island(kMiddle, {0, 15000}, 12000, 400, 0.0, 1)}), kMiddle),
              testing::Each(CoastType::sandy));
  EXPECT_THAT(types_of(chart({island(kMiddle, {3000, 0}, 1000, 12, 0.5, 1)}), kMiddle),
              testing::Each(CoastType::unknown));
  // Smooth, but 300 m in all.
  EXPECT_THAT(types_of(chart({island(kMiddle, {3000, 0}, 50, 100, 0.0, 1)}), kMiddle),
              testing::Each(testing::Ne(CoastType::sandy)));
}

// A ring half rough, half smooth: where it begins, what else the chart holds and where the plane
// lies change no edge's type.
TEST(ShoreGuess, IsTheSameForEveryRingStartWindowAndAnchor) {
  CoastRing mixed_ring = rough_ring({9000, 0});
  const CoastRing smooth = island(kMiddle, {9000, 30000}, 12000, 300, 0.0, 2);
  mixed_ring.vertices.insert(mixed_ring.vertices.end(), smooth.vertices.begin(),
                             smooth.vertices.end());
  mixed_ring.vertex_ids.insert(mixed_ring.vertex_ids.end(), smooth.vertex_ids.begin(),
                               smooth.vertex_ids.end());
  mixed_ring.edges.resize(mixed_ring.vertices.size(), EdgeKind::shoreline);
  const auto types = types_of(chart({mixed_ring}), kMiddle);
  EXPECT_THAT(types, testing::Contains(CoastType::rocky));
  EXPECT_THAT(types, testing::Contains(CoastType::sandy));
  for (std::size_t by : {1u, 57u, 260u, 400u}) {
    CoastRing turned = mixed_ring;
    std::rotate(turned.vertices.begin(), turned.vertices.begin() + by, turned.vertices.end());
    std::rotate(turned.vertex_ids.begin(), turned.vertex_ids.begin() + by, turned.vertex_ids.end());
    auto expected = types;
    std::rotate(expected.begin(), expected.begin() + by, expected.end());
    EXPECT_EQ(types_of(chart({turned}), place(kMiddle, 30.0 * static_cast<double>(by), -2000)),
              expected)
        << by;
  }
}

// A run cut in two (as bins and windows cut coasts) is judged alike except beside the cut.
TEST(ShoreGuess, StretchesFarFromACutAreTheSame) {
  std::vector<std::uint64_t> ids;
  for (std::uint64_t k = 0; k < 5000; ++k) ids.push_back(mixed(5, k));
  const auto whole = stretch_starts(ids, true);
  const auto part = stretch_starts(std::span(ids).subspan(1000, 2500), false);
  std::vector<std::uint32_t> expected = {0};
  for (std::uint32_t s : whole) {
    if (s >= 1000 + kStretchReach && s + kStretchReach < 3500) expected.push_back(s - 1000);
  }
  EXPECT_EQ(part, expected);
  EXPECT_NEAR(5000.0 / static_cast<double>(whole.size()), 41.0, 5.0);
  for (std::size_t i = 1; i < whole.size(); ++i) EXPECT_GT(whole[i] - whole[i - 1], kStretchReach);
}

// Rocky coast has the style of unknown coast, so guessing must not move a vertex of Bergen's.
TEST(ShoreGuess, ChangesNoVertexOffBergen) {
  const auto window = scenes::world_chart(scenes::kBergen, nautical_miles(15));
  if (!window) GTEST_SKIP() << "no chart installed";
  CoastRules off{.seed = 1};
  off.guess_types = false;
  CoastPreparer guessing(*window, scenes::kBergen, CoastRules{.seed = 1});
  CoastPreparer plain(*window, scenes::kBergen, off);
  std::ptrdiff_t rocky = 0;
  for (double nm : {0.75, 6.0, 12.0}) {
    const auto a = guessing.prepare(scenes::kBergen, resolution(nm));
    const auto b = plain.prepare(scenes::kBergen, resolution(nm));
    EXPECT_TRUE(a->vertices == b->vertices) << nm;
    EXPECT_EQ(a->run_starts, b->run_starts) << nm;
    EXPECT_TRUE(b->edge_shores.empty()) << nm;
    rocky = std::count_if(a->edge_shores.begin(), a->edge_shores.end(), [&](std::uint8_t shore) {
      return a->shores[shore].type == CoastType::rocky;
    });
  }
  EXPECT_GT(rocky, 100'000);
}

// Measured by the dimension of stretches, as the header states.
TEST(ShoreGuess, TellsNorwaysCoastFromTheLandesBeaches) {
  const auto share = [](GeoPoint centre, CoastType type) {
    const auto window = scenes::world_chart(centre, metres(40e3));
    if (!window) return -1.0;
    const CoastEdges laid = lay_edges(*window, LocalPlane(centre), CoastRules{});
    double of_type = 0.0, all = 0.0;
    for (std::size_t e = 0; e < laid.edges.size(); ++e) {
      const PlanePoint along = laid.edges[e].to - laid.edges[e].from;
      const double length = std::hypot(along.east_m, along.north_m);
      all += length;
      if (laid.kinds[laid.shores[e]].type == type) of_type += length;
    }
    return of_type / all;
  };
  const GeoPoint landes{44.5, -1.25};
  if (share(landes, CoastType::sandy) < 0.0) GTEST_SKIP() << "no chart installed";
  std::printf("sandy by length: Bergen %.4f, Landes %.3f; rocky: Bergen %.3f, Landes %.3f\n",
              share(scenes::kBergen, CoastType::sandy), share(landes, CoastType::sandy),
              share(scenes::kBergen, CoastType::rocky), share(landes, CoastType::rocky));
  EXPECT_LT(share(scenes::kBergen, CoastType::sandy), 0.01);
  EXPECT_GT(share(landes, CoastType::sandy), 0.2);
  EXPECT_GT(share(scenes::kBergen, CoastType::rocky), 0.5);
  EXPECT_LT(share(landes, CoastType::rocky), 0.4);
}

TEST(CoastEdges, ManyHeightsBecome256KindsOfShoreAtMost) {
  CoastChart c = chart({island(kMiddle, {5000, 0}, 4000, 2000, 0.3, 3)});
  for (std::uint16_t k = 0; k < 2000; ++k) {
    c.shores.push_back({CoastType::artificial, 0.01f * static_cast<float>(k + 1)});
    c.rings[0].shores.push_back(k);
  }
  c.shores[7].height_m = std::nanf("");
  c.shores[8].height_m = -3.0f;
  c.shores[9].height_m = 1e9f;
  const CoastEdges laid = lay_edges(c, LocalPlane(kMiddle), CoastRules{});
  ASSERT_LE(laid.kinds.size(), 256u);
  EXPECT_EQ(laid.kinds[0], PictureShore{});
  for (std::size_t e = 0; e < laid.shores.size(); ++e) {
    const float height = laid.kinds[laid.shores[e]].height_m;
    const bool known = e < 7 || e > 9;
    EXPECT_NEAR(height, known ? c.shores[e].height_m : 0.0f, 0.126) << e;
  }
}

TEST(CoastPicture, HoldsSeamsAsStraightObstaclesAndNoBinBorders) {
  // Two islands 12 m apart; the facing side of one is a seam, the far side of the other a bin
  // border.
  CoastChart c = chart({ring(kMiddle, {{1912, -400}, {2700, -400}, {2700, 400}, {1912, 400}})});
  c.rings[0].edges[1] = EdgeKind::bin_border;
  CoastPreparer without(c, kMiddle, CoastRules{.seed = 1});
  c.rings.push_back(ring(kMiddle, {{1000, -400}, {1900, -400}, {1900, 400}, {1000, 400}}));
  c.rings[1].edges[1] = EdgeKind::seam;
  CoastPreparer with(c, kMiddle, CoastRules{.seed = 1});
  const auto seamed = with.prepare(kMiddle, resolution(1.5));
  const auto open = without.prepare(kMiddle, resolution(1.5));
  std::vector<PlanePoint> seam, opposite, opposite_alone;
  const auto collect = [](const CoastPicture& p, std::vector<PlanePoint>* seam_ends,
                          std::vector<PlanePoint>& facing) {
    for (std::size_t run = 0; run + 1 < p.run_starts.size(); ++run) {
      for (std::uint32_t v = p.run_starts[run]; v + 1 < p.run_starts[run + 1]; ++v) {
        if (seam_ends && p.shores[p.shore_of(v)].seam)
          seam_ends->insert(seam_ends->end(), {p.vertices[v], p.vertices[v + 1]});
        if (std::fabs(p.vertices[v].east_m - 1912) < 250 && p.vertices[v].east_m > 1905 &&
            std::fabs(p.vertices[v].north_m) < 390)
          facing.push_back(p.vertices[v]);
      }
    }
  };
  collect(*seamed, &seam, opposite);
  collect(*open, nullptr, opposite_alone);
  ASSERT_EQ(seam.size(), 2u);
  EXPECT_NEAR(seam[0].east_m, 1900, 10);
  EXPECT_NEAR(seam[1].north_m - seam[0].north_m, 800, 10);
  // The refined side opposite keeps off the seam: within 0.47 of 12 m.
  const auto farthest = [](const std::vector<PlanePoint>& points) {
    double most = 0.0;
    for (const PlanePoint& p : points)
      most = std::max(most, std::fabs(p.east_m - points.front().east_m));
    return most;
  };
  EXPECT_GT(opposite.size(), 10u);
  EXPECT_LT(farthest(opposite), 2.0 * 0.47 * 12.1);
  EXPECT_GT(farthest(opposite_alone), 30.0);
  // Three runs: the border leaves two of one ring.
  EXPECT_EQ(seamed->run_starts.size(), 4u);
}

TEST(CoastPicture, HasTheStructuresInRange) {
  CoastChart c = chart({});
  const auto object = [](ObjectClass kind, float height_m) {
    ChartObject o;
    o.kind = kind;
    o.height_m = height_m;
    return o;
  };
  ChartObject bridge = object(ObjectClass::bridge, 20.0f);
  bridge.clearance_m = 15.0f;
  bridge.outline = {place(kMiddle, 1000, 0), place(kMiddle, 1000, 500), place(kMiddle, 1500, 500)};
  ChartObject block = object(ObjectClass::building, 12.0f);
  block.outline = {place(kMiddle, 0, 2000), place(kMiddle, 50, 2000), place(kMiddle, 50, 2050)};
  block.closed = true;
  ChartObject buoy = object(ObjectClass::buoy, 3.0f);
  buoy.cross_section_m2 = 10.0f;
  buoy.outline = {place(kMiddle, -800, 0)};
  buoy.identity = 42;
  ChartObject far = buoy;
  far.outline = {place(kMiddle, -9000, 0)};
  c.objects = {bridge, block, buoy, far, ChartObject{}};
  CoastPreparer preparer(c, kMiddle, CoastRules{});
  const auto wide = preparer.prepare(kMiddle, resolution(6));
  ASSERT_TRUE(wide->structures);
  EXPECT_EQ(wide->structures->walls.size(), 5u);
  EXPECT_EQ(wide->structures->points.size(), 2u);
  const Wall& wall = wide->structures->walls[0];
  EXPECT_EQ(wall.kind, ObjectClass::bridge);
  EXPECT_EQ(wall.base_m, 15.0f);
  EXPECT_EQ(wall.top_m, 20.0f);
  EXPECT_NEAR(wall.from.east_m, 1000, 5);
  EXPECT_EQ(wide->structures->points[0].identity, 42u);
  EXPECT_EQ(wide->structures->points[0].cross_section_m2, 10.0f);
  const auto near = preparer.prepare(kMiddle, resolution(0.5));
  ASSERT_TRUE(near->structures);
  EXPECT_TRUE(near->structures->walls.empty());
  EXPECT_EQ(near->structures->points.size(), 1u);
  EXPECT_FALSE(preparer.prepare(kMiddle, resolution(0.125))->structures);
  EXPECT_EQ(wide->elevation, nullptr);
  c.elevation = std::make_shared<const ElevationGrid>();
  EXPECT_EQ(CoastPreparer(c, kMiddle, CoastRules{}).prepare(kMiddle, resolution(6))->elevation,
            c.elevation);
}

std::string refusal_of(const CoastChart& c) {
  try {
    CoastPreparer(c, kMiddle, CoastRules{});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(CoastPicture, RefusesAChartThatContradictsItself) {
  CoastChart c = square_of_types();
  c.rings.insert(c.rings.begin(), island(kMiddle, {9000, 0}, 500, 9, 0.2, 1));
  EXPECT_EQ(refusal_of(c), "");
  CoastChart bad = c;
  bad.rings[1].edges.pop_back();
  EXPECT_EQ(refusal_of(bad), "coast chart: ring 1: 3 edge kinds for 4 vertices");
  bad = c;
  bad.rings[1].vertex_ids.push_back(1);
  EXPECT_EQ(refusal_of(bad), "coast chart: ring 1: 5 vertex identities for 4 vertices");
  bad = c;
  bad.rings[1].shores[2] = 4;
  EXPECT_EQ(refusal_of(bad), "coast chart: ring 1: edge 2 has shore 4 of 4");
  for (const GeoPoint p :
       {GeoPoint{95.0, 5.0}, GeoPoint{std::nan(""), 5.0}, GeoPoint{60.0, 1e300}}) {
    bad = c;
    bad.rings[0].vertices[3] = p;
    EXPECT_THAT(refusal_of(bad), testing::HasSubstr("ring 0: vertex 3 is at latitude"));
  }
  bad = c;
  bad.objects.resize(1);
  bad.objects[0].name = "Stone";
  bad.objects[0].height_m = std::nanf("");
  EXPECT_THAT(refusal_of(bad), testing::HasSubstr("\"Stone\" of class 7: height is"));
  CoastRules rules;
  rules.styles[3].dimension = 1.9;
  EXPECT_THROW(CoastPreparer(c, kMiddle, rules), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::echo
