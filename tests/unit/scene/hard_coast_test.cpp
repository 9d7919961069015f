// Charts and places at the edge of what there is: each gives a picture, in bounded time and memory,
// that rays can be cast through.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/scene/polar_index.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "protocol/video/range_scale.hpp"
#include "tests/scenes/charts.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/scene/coast_helpers.hpp"

namespace skerry::echo {
namespace {

using namespace test;

constexpr std::uint32_t kMostEdges = 2'000'000;

// Finite and bounded; all rays meet the coast in order, and land that begins ends.
void expect_sound(const CoastPicture& picture, PlanePoint own_ship, const char* what) {
  ASSERT_LT(picture.edge_count(), kMostEdges) << what;
  for (const PlanePoint& v : picture.vertices)
    ASSERT_TRUE(std::isfinite(v.east_m) && std::isfinite(v.north_m)) << what;
  const PolarIndex index(picture, own_ship, 10.0);
  const bool ashore = is_ashore(picture, index, own_ship);
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  for (std::uint32_t ray = 0; ray < 256; ++ray) {
    find_crossings(picture, index, {own_ship, ray << 24}, crossings);
    for (std::size_t k = 0; k < crossings.size(); ++k) {
      ASSERT_TRUE(std::isfinite(crossings[k].range_m)) << what;
      ASSERT_LT(crossings[k].shore, picture.shores.size()) << what;
      ASSERT_LE(crossings[k > 0 ? k - 1 : 0].range_m, crossings[k].range_m) << what;
    }
    const double reach = complete_range(picture, own_ship);
    land_along(crossings, ashore, reach, land);
    double last = 0.0;
    for (const LandInterval& interval : land) {
      ASSERT_LE(last, interval.begin_m) << what;
      ASSERT_LT(interval.begin_m, interval.end_m) << what;
      ASSERT_LE(interval.end_m, reach) << what;
      last = interval.end_m;
    }
  }
}

// Tries every method at every range scale; at most so many edges in all.
void expect_sound_everywhere(const CoastChart& c, GeoPoint own_ship, const char* what) {
  std::uint32_t most = 0;
  for (const CoastMethod method : scenes::every_method()) {
    CoastPreparer preparer(c, own_ship, all_by(method, 1.5));
    for (const double nm : RangeScale::kNauticalMiles) {
      const auto picture = preparer.prepare(own_ship, resolution(nm));
      most = std::max(most, picture->edge_count());
      expect_sound(*picture, picture->plane.to_plane(own_ship), what);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  std::printf("%s: %u edges at most\n", what, most);
}

// Two edges of so many metres across the ship's bow, 700 m off, closed behind by a third vertex.
TEST(HardCoast, EdgesOfEveryLength) {
  for (const double length : {0.0, 1e-3, 1.0, 1e3, 500e3}) {
    const double back = std::max(50.0, 0.3 * length);
    const CoastChart c = chart(
        {ring(kMiddle,
              {{700, -0.5 * length}, {700, 0}, {700, 0.5 * length}, {700 + back, 0.1 * length}})});
    // Counter-clockwise, seen from the east.
    expect_sound_everywhere(c, kMiddle, std::to_string(length).c_str());
  }
}

TEST(HardCoast, DuplicateAndCollinearVerticesSpikesAndSlivers) {
  CoastChart c = chart(
      {// Every vertex twice, and one three times.
       ring(kMiddle, {{500, 0}, {500, 0}, {900, 0}, {900, 0}, {900, 0}, {700, 400}, {700, 400}}),
       // Collinear, with one edge going back over another.
       ring(kMiddle, {{-900, 0}, {-800, 0}, {-850, 0}, {-700, 0}, {-500, 0}, {-700, 300}}),
       // A spike out to sea and back along itself.
       ring(kMiddle, {{0, 600}, {400, 600}, {200, 800}, {200, 1900}, {200, 800}}),
       // A sliver 1 mm wide and 3 km long, and one of no width.
       ring(kMiddle, {{-1500, -700}, {1500, -700}, {1500, -699.999}}),
       ring(kMiddle, {{-1500, -800}, {1500, -800}, {0, -800}}),
       // The same island twice over, and one across it.
       island(kMiddle, {2500, 2500}, 300, 12, 0.3, 5),
       island(kMiddle, {2500, 2500}, 300, 12, 0.3, 5),
       island(kMiddle, {2600, 2500}, 300, 13, 0.3, 6),
       // Two that touch in one vertex, and a figure of eight.
       ring(kMiddle, {{-2000, 2000}, {-1500, 2000}, {-1700, 2400}}),
       ring(kMiddle, {{-1500, 2000}, {-1000, 2100}, {-1200, 2500}}),
       ring(kMiddle, {{3000, -2000}, {3600, -1500}, {3600, -2000}, {3000, -1500}})});
  // Copies of a vertex with identities of their own.
  c.rings[1].vertex_ids[2] = 77;
  // Nothing, one vertex, two.
  c.rings.push_back({});
  c.rings.push_back(ring(kMiddle, {{100, 100}}));
  c.rings.push_back(ring(kMiddle, {{100, 100}, {200, 200}}));
  expect_sound_everywhere(c, kMiddle, "degenerate rings");
  // Overlapping coast has no room: it stays as the chart has it.
  CoastPreparer preparer(c, kMiddle, all_by(CoastMethod::random_koch));
  CoastPreparer straight(c, kMiddle, all_by(CoastMethod::straight));
  const auto chains = chains_of(*preparer.prepare(kMiddle, resolution(3)),
                                *straight.prepare(kMiddle, resolution(3)));
  EXPECT_EQ(meetings(chains), 0);
}

// All edges of a star lie on bearings from the ship.
TEST(HardCoast, EdgesThatPointAtTheShip) {
  std::vector<CoastRing> rings;
  for (int k = 0; k < 12; ++k) {
    const double a = k * std::numbers::pi / 6.0, b = a + 0.2;
    const PlanePoint u{std::cos(a), std::sin(a)}, v{std::cos(b), std::sin(b)};
    rings.push_back(ring(kMiddle, {u * 400.0, u * 3000.0, v * 3000.0, v * 400.0}));
  }
  const CoastChart c = chart(std::move(rings));
  expect_sound_everywhere(c, kMiddle, "edges that point at the ship");
  // Straight, a ray along an edge sees land or not, but never half of it.
  CoastPreparer preparer(c, kMiddle, all_by(CoastMethod::straight));
  const auto picture = preparer.prepare(kMiddle, resolution(3));
  const PolarIndex index(*picture, picture->centre, 10.0);
  std::vector<Crossing> crossings;
  for (std::uint32_t k = 0; k < 12; ++k) {
    for (std::int64_t off = -3; off <= 3; ++off) {
      const auto bearing = static_cast<std::uint32_t>((k * (std::int64_t{1} << 32)) / 12 + off);
      find_crossings(*picture, index, {picture->centre, bearing}, crossings);
      EXPECT_EQ(crossings.size() % 2, 0u) << k << ", " << off;
    }
  }
}

// Land around a lake with an island in it, a kilometre from the middle of the island.
CoastChart island_in_a_lake() {
  CoastRing lake = island(kMiddle, {0, 0}, 3000, 40, 0.2, 12);
  std::reverse(lake.vertices.begin(), lake.vertices.end());
  std::reverse(lake.vertex_ids.begin(), lake.vertex_ids.end());
  lake.level = 2;
  CoastRing isle = island(kMiddle, {0, 0}, 700, 20, 0.2, 13);
  isle.level = 3;
  return chart({island(kMiddle, {0, 0}, 9000, 60, 0.2, 11), lake, isle});
}

TEST(HardCoast, TheShipOnLandInALakeAndOnAnIslandInIt) {
  const CoastChart c = island_in_a_lake();
  struct Spot {
    const char* what;
    double east_m;
    bool ashore;
  };
  for (const Spot& spot : {Spot{"at sea", 9900, false}, Spot{"inside land", 5000, true},
                           Spot{"in a lake", 1500, false}, Spot{"on the island in it", 0, true}}) {
    const GeoPoint at = place(kMiddle, spot.east_m, 0);
    expect_sound_everywhere(c, at, spot.what);
    for (const CoastMethod method : scenes::every_method()) {
      CoastPreparer preparer(c, at, all_by(method, 1.5));
      for (const double nm : {0.125, 0.75, 6.0}) {
        const auto picture = preparer.prepare(at, resolution(nm));
        EXPECT_EQ(picture->centre_ashore, spot.ashore) << spot.what << ", " << nm;
        const PolarIndex index(*picture, picture->centre, 10.0);
        EXPECT_EQ(is_ashore(*picture, index, picture->centre), spot.ashore)
            << spot.what << ", " << nm;
      }
    }
  }
}

TEST(HardCoast, TheShipOnAVertexAndOnAnEdge) {
  const CoastChart c = chart({island(kMiddle, {800, 300}, 700, 14, 0.4, 8)});
  const CoastRing& r = c.rings[0];
  for (std::size_t i = 0; i < 3; ++i) {
    expect_sound_everywhere(c, r.vertices[i], "on a vertex");
    const GeoPoint a = r.vertices[i], b = r.vertices[i + 1];
    expect_sound_everywhere(
        c, {0.5 * (a.latitude_deg + b.latitude_deg), 0.5 * (a.longitude_deg + b.longitude_deg)},
        "on an edge");
  }
}

// A ring of the parallel, its vertices all around the globe.
CoastRing around_the_pole(double latitude, int corners, bool land_to_the_north) {
  CoastRing r;
  for (int k = 0; k < corners; ++k) {
    const double east = 360.0 * k / corners;
    r.vertices.push_back({latitude, wrapped_longitude(land_to_the_north ? east : -east)});
    r.vertex_ids.push_back(mixed(9, static_cast<std::uint64_t>(k)));
  }
  r.edges.assign(r.vertices.size(), EdgeKind::shoreline);
  return r;
}

TEST(HardCoast, PolygonsAroundThePoleAndAcrossTheAntimeridian) {
  // An ice cap to 89 N, seen from 20 km off it, from on it and from the pole itself.
  for (const double latitude : {88.8, 89.2, 90.0}) {
    const GeoPoint at{latitude, 33.0};
    const CoastChart c = chart({around_the_pole(89.0, 120, true)}, 400e3, at);
    expect_sound_everywhere(c, at, "around the pole");
    CoastPreparer preparer(c, at, all_by(CoastMethod::random_koch));
    const auto picture = preparer.prepare(at, resolution(96));
    // All of it, 111.7 km from the pole.
    EXPECT_GT(picture->edge_count(), 120u);
    const PolarIndex index(*picture, picture->centre, 10.0);
    EXPECT_EQ(is_ashore(*picture, index, picture->centre), latitude > 89.0) << latitude;
    if (latitude == 90.0) {
      for (const PlanePoint& v : picture->vertices) EXPECT_NEAR(length_of(v), 111.7e3, 2e3);
    }
  }
  // Closed along the antimeridian and the pole, as files in degrees have it: those edges lie on
  // each other and cancel.
  CoastRing cap;
  for (int k = 0; k <= 72; ++k)
    cap.vertices.push_back({-80.0, std::min(179.9999999, -180.0 + 5.0 * k)});
  cap.vertices.push_back({-90.0, 179.9999999});
  cap.vertices.push_back({-90.0, -180.0});
  std::reverse(cap.vertices.begin(), cap.vertices.end());
  for (std::size_t k = 0; k < cap.vertices.size(); ++k) cap.vertex_ids.push_back(mixed(10, k));
  cap.edges.assign(cap.vertices.size(), EdgeKind::shoreline);
  expect_sound_everywhere(chart({cap}, 400e3, {-79.9, 179.9}), {-79.9, 179.9}, "a polar cap");
  for (const GeoPoint at : {scenes::kEastOfTheAntimeridian, GeoPoint{-16.75, 179.999}}) {
    const CoastChart c = chart(
        {island(at, {3000, 0}, 2500, 30, 0.5, 3), island(at, {-9000, 4000}, 5000, 50, 0.5, 4)},
        60e3, at);
    expect_sound_everywhere(c, at, "across the antimeridian");
    CoastPreparer preparer(c, at, all_by(CoastMethod::random_koch));
    for (const PlanePoint& v : preparer.prepare(at, resolution(24))->vertices)
      EXPECT_LT(length_of(v), 20e3);
  }
}

// A continent as one ring of 600 000 vertices, 80 m apart, 8000 km across; the ship off its west
// coast, then at its antipode, where a plane that took it all would draw edges through her.
TEST(HardCoast, AContinentAsOneRing) {
  constexpr int kCorners = 600'000;
  CoastRing r;
  r.vertices.reserve(kCorners);
  for (int k = 0; k < kCorners; ++k) {
    const double at = 2.0 * std::numbers::pi * k / kCorners;
    const auto noise = [&](int step, double size) {
      const auto from = static_cast<std::uint64_t>(k / step);
      const double part = static_cast<double>(k % step) / step;
      const auto of = [&](std::uint64_t n) {
        return as_unit(mixed(4, static_cast<std::uint64_t>(step), n % (kCorners / step)));
      };
      return size * (of(from) + (of(from + 1) - of(from)) * part);
    };
    const double radius = 30.0 + noise(10'000, 5.0) + noise(100, 0.05) + noise(1, 0.0002);
    r.vertices.push_back({20.0 + 0.8 * radius * std::sin(at),
                          wrapped_longitude(80.0 + 1.2 * radius * std::cos(at))});
    r.vertex_ids.push_back(mixed(6, static_cast<std::uint64_t>(k)));
  }
  r.edges.assign(r.vertices.size(), EdgeKind::shoreline);
  const GeoPoint coast = r.vertices[kCorners / 2];
  const GeoPoint off{coast.latitude_deg, coast.longitude_deg - 0.15};
  for (const CoastMethod method : scenes::every_method()) {
    CoastPreparer preparer(chart({r}, 150e3, off), off, all_by(method, 1.5));
    for (const double nm : {0.125, 12.0, 96.0}) {
      const auto picture = preparer.prepare(off, resolution(nm));
      EXPECT_FALSE(picture->centre_ashore);
      EXPECT_EQ(picture->edge_count() > 0, nm > 10.0) << nm;
      if (nm > 10.0) {
        std::printf("%s %g NM: %u edges\n", std::string(name_of(method)).c_str(), nm,
                    picture->edge_count());
      }
      expect_sound(*picture, picture->centre, "a continent");
    }
  }
  const GeoPoint antipode{-20.0, -100.0};
  CoastPreparer preparer(chart({r}, 150e3, antipode), antipode, all_by(CoastMethod::random_koch));
  EXPECT_EQ(preparer.prepare(antipode, resolution(96))->edge_count(), 0u);
}

// The longest closed shoreline of the bins' land rings, joined across their borders.
CoastRing longest_joined(const CoastChart& c) {
  struct Line {
    std::vector<GeoPoint> vertices;  // the last one is the next line's first
    std::vector<std::uint64_t> ids;
    bool used = false;
  };
  std::vector<Line> lines;
  for (const CoastRing& r : c.rings) {
    const std::size_t n = r.vertices.size();
    std::size_t border = 0;
    while (border < n && r.edges[border] == EdgeKind::shoreline) ++border;
    if (r.level != 1 || border == n) continue;
    bool open = false;
    for (std::size_t k = 1; k <= n; ++k) {
      const std::size_t i = (border + k) % n, j = (i + 1) % n;
      if (r.edges[i] == EdgeKind::shoreline) {
        if (!open) lines.push_back({{r.vertices[i]}, {r.vertex_ids[i]}});
        lines.back().vertices.push_back(r.vertices[j]);
        lines.back().ids.push_back(r.vertex_ids[j]);
      }
      open = r.edges[i] == EdgeKind::shoreline;
    }
  }
  std::multimap<std::uint64_t, std::size_t> by_begin;
  for (std::size_t i = 0; i < lines.size(); ++i) by_begin.emplace(lines[i].ids.front(), i);
  CoastRing longest;
  for (const Line& line : lines) {
    CoastRing joined;
    const std::uint64_t begin = line.ids.front();
    for (std::uint64_t at = begin; joined.vertices.empty() || at != begin;) {
      auto [next, end] = by_begin.equal_range(at);
      while (next != end && lines[next->second].used) ++next;
      if (next == end) break;
      Line& part = lines[next->second];
      part.used = true;
      joined.vertices.insert(joined.vertices.end(), part.vertices.begin(), part.vertices.end() - 1);
      joined.vertex_ids.insert(joined.vertex_ids.end(), part.ids.begin(), part.ids.end() - 1);
      at = part.ids.back();
    }
    if (joined.vertices.size() > longest.vertices.size()) longest = std::move(joined);
  }
  longest.edges.assign(longest.vertices.size(), EdgeKind::shoreline);
  return longest;
}

TEST(HardCoast, EurasiaAsOneRing) {
  const auto world = scenes::world_chart({45.0, 50.0}, metres(12'000e3));
  if (!world) GTEST_SKIP() << "no chart installed";
  const CoastRing eurasia = longest_joined(*world);
  std::printf("%zu vertices\n", eurasia.vertices.size());
  if (eurasia.vertices.size() < 500'000) GTEST_SKIP() << "a coarse chart is installed";
  for (const GeoPoint at : {GeoPoint{61.0, 5.0}, GeoPoint{38.9, 121.72}, GeoPoint{-40.0, -130.0}}) {
    const CoastChart one = chart({eurasia}, 100e3, at);
    CoastPreparer whole(one, at, all_by(CoastMethod::straight));
    CoastPreparer rough(one, at, all_by(CoastMethod::random_koch));
    const auto bins = scenes::world_chart(at, metres(60e3));
    CoastPreparer binned(*bins, at, all_by(CoastMethod::straight));
    for (const double nm : {6.0, 24.0}) {
      const auto a = whole.prepare(at, resolution(nm)), b = binned.prepare(at, resolution(nm));
      const VertexSet all = vertices_of(*b);
      for (const PlanePoint& v : a->vertices) ASSERT_TRUE(all.count({v.east_m, v.north_m})) << nm;
      EXPECT_EQ(a->edge_count() > 20, at.latitude_deg > 0.0) << nm;
      const auto refined = rough.prepare(at, resolution(nm));
      std::printf("%g NM: %u edges, refined %u\n", nm, a->edge_count(), refined->edge_count());
      expect_sound(*refined, refined->centre, "Eurasia");
    }
  }
}

TEST(HardCoast, IslandsSmallerThanACell) {
  std::vector<CoastRing> rings;
  for (int k = 1; k <= 40; ++k)
    rings.push_back(island(kMiddle, {100.0 * k, 40.0 * k}, 0.02 * k, 4 + k % 5, 0.3,
                           static_cast<std::uint64_t>(k)));
  const CoastChart c = chart(std::move(rings), 250e3);
  expect_sound_everywhere(c, kMiddle, "islands smaller than a cell");
  // They are there, as the chart has them.
  CoastPreparer preparer(c, kMiddle, all_by(CoastMethod::random_koch));
  const auto picture = preparer.prepare(kMiddle, resolution(96));
  EXPECT_EQ(picture->run_starts.size(), 41u);
  std::size_t corners = 0;
  for (const CoastRing& r : c.rings) corners += r.vertices.size();
  EXPECT_EQ(picture->edge_count(), corners);
}

// Long edges all over each other: what the grid of the clearance costs stays in bounds.
TEST(HardCoast, TwoThousandEdgesOf300Kilometres) {
  std::vector<CoastRing> rings;
  for (std::uint64_t k = 0; k < 700; ++k) {
    const auto at = [&](std::uint64_t j) { return 300e3 * (as_unit(mixed(21, k, j)) - 0.5); };
    rings.push_back(ring(kMiddle, {{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}}));
  }
  const CoastChart c = chart(std::move(rings), 250e3);
  CoastPreparer preparer(c, kMiddle, all_by(CoastMethod::midpoint, 1.5));
  for (const double nm : {0.125, 6.0, 96.0}) {
    const auto picture = preparer.prepare(kMiddle, resolution(nm));
    expect_sound(*picture, picture->centre, "long edges");
  }
}

}  // namespace
}  // namespace skerry::echo
