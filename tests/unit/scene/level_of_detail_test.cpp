// Which detail an edge gets, and that a picture does not depend on those made before it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "echo/fractal/clearance.hpp"
#include "echo/fractal/edge_refiner.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/coast_edges.hpp"
#include "echo/scene/edge_detail.hpp"
#include "echo/scene/picture_memory.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "protocol/video/range_scale.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/scene/coast_helpers.hpp"

namespace skerry::echo {
namespace {

using namespace test;

TEST(EdgeDetail, QuarterOctavesAreExact) {
  EXPECT_EQ(quarter_octave_floor(0.0), 0.0);
  EXPECT_EQ(quarter_octave_floor(-1.0), 0.0);
  EXPECT_EQ(quarter_octave_floor(std::nan("")), 0.0);
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::exp2(std::uniform_real_distribution<double>(-40.0, 40.0)(random));
    const double f = quarter_octave_floor(x);
    ASSERT_LE(f, x);
    ASSERT_GT(f * std::exp2(0.25) * (1.0 + 1e-15), x);
    ASSERT_EQ(quarter_octave_floor(f), f);
    const double quarters = 4.0 * std::log2(f);
    ASSERT_NEAR(quarters, std::round(quarters), 1e-9);
  }
}

// Islands near and far, in edges of 1 m to 3 km.
CoastChart varied_chart() {
  std::vector<CoastRing> rings;
  for (int k = 0; k < 24; ++k) {
    const double at = 0.9 * k, far = 150.0 * std::exp2(0.3 * k);
    const double size = std::min(0.6 * far, 30.0 + 80.0 * k);
    rings.push_back(island(kMiddle, {far * std::sin(at), far * std::cos(at)}, size,
                           5 + (k * 7) % 23, 0.4, static_cast<std::uint64_t>(k)));
  }
  rings.push_back(island(kMiddle, {300, -500}, 20, 60, 0.2, 99));  // edges of 2 m
  return chart(std::move(rings), 40e3);
}

// Every vertex the limit asks for piece by piece is there, whatever rule the edge fell under.
TEST(EdgeDetail, MakesNoLessThanTheLimitAsksOfEachPiece) {
  const CoastChart c = varied_chart();
  const LocalPlane plane(kMiddle);
  const CoastRules rules = all_by(CoastMethod::random_koch);
  const CoastEdges laid = lay_edges(c, plane, rules);
  Clearance clearance(laid.edges);
  const EdgeRefiner refiner(rules.styles[0]);
  CoastPreparer preparer(c, kMiddle, rules);
  std::size_t asked = 0, made = 0;
  for (const RadarResolution& r : {resolution(0.25), resolution(0.75, 4096, 8192), resolution(3),
                                   resolution(12), resolution(12, 512, 256)}) {
    const auto picture = preparer.prepare(kMiddle, r);
    const VertexSet present = vertices_of(*picture);
    const DetailLimit limit{picture->centre, picture->slack_m, r.range_m, r.cell_m,
                            r.spoke_degrees * 3.14159265358979323846 / 180.0};
    std::vector<PlanePoint> wanted;
    for (std::uint32_t e = 0; e < laid.edges.size(); ++e) {
      const ShoreEdge& edge = laid.edges[e];
      if (distance_to_segment(picture->centre, edge.from, edge.to) > r.range_m) continue;
      wanted.clear();
      refiner.refine({edge.from, edge.to, mixed(edge.seed(), 1), clearance.half_angle_tan(e)},
                     limit, wanted);
      if (wanted.size() == 1) continue;
      for (const PlanePoint& p : wanted) ASSERT_TRUE(present.count({p.east_m, p.north_m})) << e;
      asked += wanted.size();
    }
    made += picture->vertices.size();
  }
  std::printf("%zu vertices asked for, %zu made\n", asked, made);
  EXPECT_GT(asked, 20'000u);
  EXPECT_LT(static_cast<double>(made), 1.35 * static_cast<double>(asked));
}

GeoPoint wandered(std::mt19937_64& random, GeoPoint from, double most_m) {
  const double step = most_m * std::exp2(std::uniform_real_distribution<double>(-8, 0)(random));
  const double course = std::uniform_real_distribution<double>(0, 6.2831853)(random);
  const GeoPoint to = place(from, step * std::sin(course), step * std::cos(course));
  // Back to the middle from 4.5 km out.
  const double off = std::hypot((to.latitude_deg - kMiddle.latitude_deg) * 111195.0,
                                (to.longitude_deg - kMiddle.longitude_deg) * 55000.0);
  return off < 4500.0 ? to : kMiddle;
}

class WanderingPicture : public testing::TestWithParam<CoastMethod> {};

TEST_P(WanderingPicture, IsTheOneMadeFreshAfterAnyHistory) {
  const CoastRules rules = all_by(GetParam(), 1.3);
  const CoastChart c = varied_chart();
  CoastPreparer travelled(c, kMiddle, rules);
  std::mt19937_64 random(11);
  GeoPoint at = kMiddle;
  RadarResolution r = resolution(3);
  std::uint64_t reused = 0, refined = 0;
  for (int step = 0; step < 500; ++step) {
    at = wandered(random, at, 800.0);
    if (random() % 4 == 0) {
      const double nm = RangeScale::kNauticalMiles[random() % 8];
      r = random() % 3 == 0 ? resolution(nm, 512, 2048) : resolution(nm);
    }
    const auto picture = travelled.prepare(at, r);
    reused += travelled.last_effort().reused;
    refined += travelled.last_effort().refined;
    CoastPreparer fresh(c, kMiddle, rules);
    ASSERT_TRUE(identical(*picture, *fresh.prepare(at, r))) << "step " << step;
    ASSERT_EQ(fresh.last_effort().reused, 0u);
  }
  std::printf("%llu edges refined, %llu reused\n", static_cast<unsigned long long>(refined),
              static_cast<unsigned long long>(reused));
  EXPECT_GT(reused, refined);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, WanderingPicture,
                         testing::ValuesIn(scenes::every_refining_method()), scenes::kMethodName);

TEST(LevelOfDetail, MostOfTheCoastIsKeptWhenTheShipHasMovedByItsSlack) {
  const auto window = scenes::world_chart(scenes::kBergen, nautical_miles(20));
  if (!window) GTEST_SKIP() << "no chart installed";
  CoastPreparer preparer(*window, scenes::kBergen, CoastRules{.seed = 1});
  for (double nm : {1.5, 3.0, 6.0, 12.0}) {
    preparer.prepare(scenes::kBergen, resolution(nm));
    const GeoPoint on = place(scenes::kBergen, 0, 0.02 * nm * 1852.0);
    const auto moved = preparer.prepare(on, resolution(nm));
    const auto effort = preparer.last_effort();
    std::printf("%g NM: %u straight, %u reused, %u refined\n", nm, effort.straight, effort.reused,
                effort.refined);
    EXPECT_GT(effort.reused, 9 * effort.refined) << nm;
    CoastPreparer fresh(*window, scenes::kBergen, CoastRules{.seed = 1});
    EXPECT_TRUE(identical(*moved, *fresh.prepare(on, resolution(nm))));
    // The same place again: nothing is left to do but edges refined by the piece.
    preparer.prepare(on, resolution(nm));
    EXPECT_LE(preparer.last_effort().refined, effort.refined);
  }
}

CoastPicturePtr picture_of(std::size_t vertices) {
  CoastPicture p{.plane = LocalPlane(kMiddle), .centre = {}, .vertices = {}, .run_starts = {}};
  p.vertices.resize(vertices);
  return std::make_shared<const CoastPicture>(std::move(p));
}

TEST(PictureMemory, KeepsThreePicturesAndFourMillionVertices) {
  PictureMemory memory;
  std::vector<std::weak_ptr<const CoastPicture>> kept;
  const auto keep = [&](std::size_t vertices, double nm) {
    const auto picture = picture_of(vertices);
    kept.push_back(picture);
    memory.keep(picture, resolution(nm), {{nm, 1, 2}});
  };
  const auto alive = [&] {
    return std::count_if(kept.begin(), kept.end(), [](const auto& p) { return !p.expired(); });
  };
  for (double nm : {3.0, 6.0, 12.0, 24.0}) keep(10, nm);
  EXPECT_EQ(alive(), 3);
  EXPECT_TRUE(memory.find(0, 3.0).empty());
  EXPECT_EQ(memory.find(0, 6.0).size(), 2u);
  keep(10, 12.0);  // in place of the other at 12 NM
  EXPECT_EQ(alive(), 3);
  EXPECT_EQ(memory.find(0, 6.0).size(), 2u);
  keep(3'999'985, 48.0);  // leaves room for one of 10
  EXPECT_EQ(alive(), 2);
  EXPECT_TRUE(memory.find(0, 24.0).empty());
  keep(4'000'001, 96.0);
  EXPECT_EQ(alive(), 0);
}

}  // namespace
}  // namespace skerry::echo
