// Harm that refinement never does to a coast, for every method, on made-up and real charts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <random>

#include "echo/chart/land_mask.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/scene/coast_helpers.hpp"

namespace skerry::echo {
namespace {

using namespace test;

// Apart from each other, with lakes, an island in a lake, and a channel of 8 m.
CoastChart archipelago() {
  std::vector<CoastRing> rings;
  for (int k = 0; k < 60; ++k) {
    const double east = 900.0 * (k % 8) - 3000.0, north = 900.0 * (k / 8) - 3000.0;
    if (std::hypot(east, north) < 700.0) continue;
    rings.push_back(island(kMiddle, {east, north}, 150.0 + 6.0 * k, 6 + k % 17, 0.6,
                           static_cast<std::uint64_t>(k)));
  }
  CoastRing lake = island(kMiddle, {6000, 0}, 700, 24, 0.3, 101);
  std::reverse(lake.vertices.begin(), lake.vertices.end());
  std::reverse(lake.vertex_ids.begin(), lake.vertex_ids.end());
  lake.level = 2;
  rings.push_back(island(kMiddle, {6000, 0}, 1500, 40, 0.3, 100));
  rings.push_back(lake);
  rings.push_back(island(kMiddle, {6000, 0}, 200, 12, 0.3, 102));
  rings.push_back(ring(kMiddle, {{-7000, -900}, {-5500, -900}, {-5500, -4}, {-7000, -4}}));
  rings.push_back(ring(kMiddle, {{-7000, 4}, {-5500, 4}, {-5500, 900}, {-7000, 900}}));
  return chart(std::move(rings));
}

struct Place {
  const char* name;
  GeoPoint centre;
};

class RefinedCoast : public testing::TestWithParam<CoastMethod> {
 protected:
  // The made-up chart and the real ones that are installed.
  template <typename Check>
  void on_all_charts(const Check& check) {
    check("made up", archipelago(), kMiddle);
    for (const Place& p : {Place{"Bergen", scenes::kBergen}, Place{"Plymouth", {50.32, -4.15}},
                           Place{"Dalian", {38.90, 121.72}}}) {
      auto window = scenes::world_chart(p.centre, nautical_miles(8));
      if (!window) GTEST_SKIP() << "no chart installed";
      check(p.name, *std::move(window), p.centre);
    }
  }
  static constexpr double kRoughest = 1.5;
};

// The test below can fail.
TEST(Meetings, AreFound) {
  const std::vector<Chain> chains = {{0, {{0, 0}, {50, 10}, {100, 0}}},
                                     {3, {{60, -50}, {60, 50}}},
                                     {5, {{0, 200}, {20, 200}, {10, 220}, {10, 180}}}};
  EXPECT_EQ(meetings(chains), 2);
  EXPECT_EQ(meetings({chains[0], {3, {{60, -50}, {60, -1}}}}), 0);
}

// Edges of the chart that meet have no room and are straight; no other ever meets anything.
TEST_P(RefinedCoast, NeverMeetsItselfNorAnotherEdge) {
  on_all_charts([&](const char* name, const CoastChart& c, GeoPoint centre) {
    CoastPreparer preparer(c, centre, all_by(GetParam(), kRoughest));
    CoastPreparer straight(c, centre, all_by(CoastMethod::straight));
    for (double nm : {1.5, 6.0}) {
      const auto picture = preparer.prepare(centre, resolution(nm));
      const auto chains = chains_of(*picture, *straight.prepare(centre, resolution(nm)));
      EXPECT_EQ(meetings(chains), 0) << name << ", " << nm;
      const auto refined = std::count_if(
          chains.begin(), chains.end(), [](const Chain& chain) { return chain.points.size() > 2; });
      std::printf("%s %g NM: %zu edges, %td refined, %zu vertices\n", name, nm, chains.size(),
                  refined, picture->vertices.size());
    }
  });
}

// Land stays land and sea stays sea wherever the chart's shore is farther away than it may move:
// 0.29 of an edge's length.
TEST_P(RefinedCoast, LeavesLandAndSeaOnTheirSides) {
  std::mt19937_64 random(5);
  int checked = 0, land = 0;
  on_all_charts([&](const char* name, const CoastChart& c, GeoPoint centre) {
    CoastPreparer preparer(c, centre, all_by(GetParam(), kRoughest));
    CoastPreparer straight(c, centre, all_by(CoastMethod::straight));
    const auto picture = preparer.prepare(centre, resolution(6));
    const auto plain = straight.prepare(centre, resolution(6));
    std::uniform_real_distribution<double> within(-5500.0, 5500.0);
    for (int k = 0; k < 150; ++k) {
      const PlanePoint at = picture->centre + PlanePoint{within(random), within(random)};
      bool near = false;
      for (std::size_t run = 0; run + 1 < plain->run_starts.size() && !near; ++run) {
        for (std::uint32_t v = plain->run_starts[run]; v + 1 < plain->run_starts[run + 1]; ++v) {
          const PlanePoint a = plain->vertices[v], b = plain->vertices[v + 1];
          near = near || distance_to_segment(at, a, b) <= 0.29 * length_of(b - a);
        }
      }
      if (near) continue;
      ++checked;
      const int before = winding(*plain, at), after = winding(*picture, at);
      ASSERT_EQ(after, before) << name << " at " << at.east_m << ", " << at.north_m;
      if (std::string(name) == "made up") {
        const bool is = is_land(c, picture->plane.to_geo(at));
        EXPECT_EQ(after > 0, is);
        land += is;
      }
    }
  });
  std::printf("%d places\n", checked);
  EXPECT_GT(checked, 60);
  EXPECT_GT(land, 3);
}

// The channel between the two blocks, 8 m wide and 1500 m long: six hundredths of it at least stay
// free about its middle line, from end to end.
TEST_P(RefinedCoast, KeepsANarrowFairwayOpen) {
  const GeoPoint mouth = place(kMiddle, -7000, 0);
  CoastPreparer preparer(archipelago(), mouth, all_by(GetParam(), kRoughest));
  const auto picture = preparer.prepare(mouth, resolution(1.5, 4096, 8192));
  double nearest = 1e9;
  std::size_t inside = 0;
  // The plane's middle line is bent by the meridians: 0.1 m in 1500 m.
  for (const PlanePoint& v : picture->vertices) {
    if (v.east_m < 0.0 || v.east_m > 1490.0 || std::fabs(v.north_m) > 5.0) continue;
    nearest = std::min(nearest, std::fabs(v.north_m));
    ++inside;
  }
  EXPECT_GE(nearest, 0.03 * 8.0 - 0.1);
  EXPECT_GT(inside, GetParam() == CoastMethod::straight ? 2u : 15u);
  for (double east = 5.0; east < 1490.0; east += 5.0)
    ASSERT_EQ(winding(*picture, {east, 0.0}), 0) << east;
}

TEST_P(RefinedCoast, KeepsTheOrientationOfRings) {
  const CoastChart c = archipelago();
  CoastPreparer preparer(c, kMiddle, all_by(GetParam(), kRoughest));
  const auto picture = preparer.prepare(kMiddle, resolution(6));
  ASSERT_EQ(picture->run_starts.size(), c.rings.size() + 1);
  for (std::size_t run = 0; run < c.rings.size(); ++run) {
    double area = 0.0;
    const std::uint32_t first = picture->run_starts[run], end = picture->run_starts[run + 1];
    ASSERT_EQ(picture->vertices[first], picture->vertices[end - 1]);
    for (std::uint32_t v = first; v + 1 < end; ++v) {
      const PlanePoint a = picture->vertices[v], b = picture->vertices[v + 1];
      area += 0.5 * (a.east_m * b.north_m - a.north_m * b.east_m);
    }
    EXPECT_EQ(area > 0.0, c.rings[run].level != 2) << run;
  }
}

// Whatever the scale, the resolution and the place, what is seen of an edge is some of the vertices
// of one and the same curve, in order: the one made in cells of 2 m.
TEST_P(RefinedCoast, IsNestedAcrossScales) {
  on_all_charts([&](const char* name, const CoastChart& c, GeoPoint centre) {
    CoastPreparer preparer(c, centre, all_by(GetParam(), kRoughest));
    CoastPreparer straight(c, centre, all_by(CoastMethod::straight));
    const auto by_edge = [&](GeoPoint at, const RadarResolution& r) {
      // Edges by the chart edge's ends.
      using At = std::pair<double, double>;
      std::map<std::pair<At, At>, std::vector<PlanePoint>> edges;
      for (Chain& chain : chains_of(*preparer.prepare(at, r), *straight.prepare(at, r))) {
        const PlanePoint a = chain.points.front(), b = chain.points.back();
        edges[{{a.east_m, a.north_m}, {b.east_m, b.north_m}}] = std::move(chain.points);
      }
      return edges;
    };
    const auto finest = by_edge(centre, {4500.0, 2.0, 1e-4});
    std::size_t compared = 0;
    for (const RadarResolution& r : {resolution(1.5), resolution(3), resolution(6), resolution(12),
                                     resolution(3, 512, 256), RadarResolution{500.0, 2.0, 0.1}}) {
      for (const GeoPoint at : {centre, place(centre, 700, -500)}) {
        for (const auto& [ends, points] : by_edge(at, r)) {
          const auto fine = finest.find(ends);
          // Within the finest picture's range with all that grows out of it.
          const PlanePoint a = points.front(), b = points.back();
          if (fine == finest.end() || length_of((a + b) * 0.5) + 0.6 * length_of(b - a) > 4500.0)
            continue;
          std::size_t k = 0;
          for (const PlanePoint& p : points) {
            while (k < fine->second.size() && !(fine->second[k] == p)) ++k;
            ASSERT_LT(k, fine->second.size()) << name << ", range " << r.range_m;
          }
          compared += points.size();
        }
      }
    }
    std::printf("%s: %zu vertices found again\n", name, compared);
    EXPECT_GT(compared, GetParam() == CoastMethod::straight ? 500u : 2000u) << name;
  });
}

// However the chart's rings are listed and wherever they begin, the vertices are the same.
TEST_P(RefinedCoast, DoesNotDependOnTheOrderOfRingsNorWhereTheyBegin) {
  CoastChart c = archipelago(), other = c;
  std::reverse(other.rings.begin(), other.rings.end());
  std::size_t by = 1;
  for (CoastRing& r : other.rings) {
    by = (by * 7 + 3) % r.vertices.size();
    std::rotate(r.vertices.begin(), r.vertices.begin() + static_cast<std::ptrdiff_t>(by),
                r.vertices.end());
    std::rotate(r.vertex_ids.begin(), r.vertex_ids.begin() + static_cast<std::ptrdiff_t>(by),
                r.vertex_ids.end());
  }
  CoastPreparer one(c, kMiddle, all_by(GetParam(), kRoughest));
  CoastPreparer two(other, kMiddle, all_by(GetParam(), kRoughest));
  for (double nm : {0.75, 3.0, 12.0}) {
    const auto a = one.prepare(kMiddle, resolution(nm)), b = two.prepare(kMiddle, resolution(nm));
    EXPECT_EQ(vertices_of(*a), vertices_of(*b)) << nm;
    EXPECT_EQ(a->edge_count(), b->edge_count());
  }
}

// Another anchor, and the ship coming from elsewhere: the same coast to a few millimetres.
TEST_P(RefinedCoast, IsTheSameFromAnotherAnchor) {
  const CoastChart c = archipelago();
  CoastPreparer one(c, kMiddle, all_by(GetParam(), kRoughest));
  CoastPreparer two(c, place(kMiddle, -2800, 3100), all_by(GetParam(), kRoughest));
  two.prepare(place(kMiddle, -2000, 2000), resolution(6));
  const auto a = one.prepare(kMiddle, resolution(1.5)), b = two.prepare(kMiddle, resolution(1.5));
  std::vector<PlanePoint> sorted = a->vertices;
  const auto by_east = [](PlanePoint p, PlanePoint q) { return p.east_m < q.east_m; };
  std::sort(sorted.begin(), sorted.end(), by_east);
  std::size_t matched = 0;
  double worst = 0.0;
  for (const PlanePoint& v : b->vertices) {
    const PlanePoint p = a->plane.to_plane(b->plane.to_geo(v));
    double nearest = 1.0;
    for (auto it = std::lower_bound(sorted.begin(), sorted.end(), p - PlanePoint{0.05, 0}, by_east);
         it != sorted.end() && it->east_m < p.east_m + 0.05; ++it)
      nearest = std::min(nearest, length_of(p - *it));
    if (nearest > 0.05) continue;
    ++matched;
    worst = std::max(worst, nearest);
  }
  std::printf("%zu of %zu matched, worst %.2g m\n", matched, b->vertices.size(), worst);
  EXPECT_GT(static_cast<double>(matched), 0.995 * static_cast<double>(b->vertices.size()));
  EXPECT_LE(worst, 0.005);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, RefinedCoast, testing::ValuesIn(scenes::every_method()),
                         scenes::kMethodName);

}  // namespace
}  // namespace skerry::echo
