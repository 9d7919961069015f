#include "echo/chart/gshhg_bin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

namespace skerry::echo {
namespace {

constexpr std::uint8_t kClosed = ShoreSegment::kClosed;
constexpr int kSouth = 0, kEast = 1, kNorth = 2, kWest = 3;

ShoreSegment segment(std::uint8_t level, int entry, int exit,
                     std::vector<std::pair<int, int>> places) {
  ShoreSegment s{level, static_cast<std::uint8_t>(entry), static_cast<std::uint8_t>(exit), {}};
  for (const auto& [x, y] : places)
    s.points.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  return s;
}

std::vector<BinRing> rings_of(std::vector<ShoreSegment> segments, std::uint8_t corners = 0,
                              bool antarctic = false) {
  return assemble_bin({0, {corners, corners, corners, corners}, std::move(segments)}, antarctic);
}

// Area as a part of the bin, positive counter-clockwise.
double area_of(const BinRing& r) {
  double sum = 0.0;
  for (std::size_t i = 0, n = r.points.size(); i < n; ++i) {
    const BinPoint a = r.points[i], b = r.points[(i + 1) % n];
    sum += 1.0 * a.x * b.y - 1.0 * b.x * a.y;
  }
  return 0.5 * sum / (65535.0 * 65535.0);
}

auto shore_edges(const BinRing& r) {
  return std::count(r.edges.begin(), r.edges.end(), EdgeKind::shoreline);
}

TEST(GshhgBin, WithoutShorelineIsWhatItsCornersSay) {
  EXPECT_TRUE(rings_of({}, 0).empty());
  const auto land = rings_of({}, 1);
  ASSERT_EQ(land.size(), 1u);
  EXPECT_EQ(land[0].level, 1);
  EXPECT_DOUBLE_EQ(area_of(land[0]), 1.0);
  EXPECT_EQ(land[0].edges, std::vector<EdgeKind>(4, EdgeKind::bin_border));
  const auto lake = rings_of({}, 2);  // land, and a lake that covers it
  ASSERT_EQ(lake.size(), 2u);
  EXPECT_DOUBLE_EQ(area_of(lake[1]), -1.0);
  EXPECT_EQ(rings_of({}, 1, true)[0].level, 5);
}

TEST(GshhgBin, LandSouthOfAShoreThatRunsWest) {
  const auto rings =
      rings_of({segment(1, kEast, kWest, {{65535, 20000}, {30000, 25000}, {0, 10000}})});
  ASSERT_EQ(rings.size(), 1u);
  const std::vector<BinPoint> expected = {
      {65535, 20000}, {30000, 25000}, {0, 10000}, {0, 0}, {65535, 0}};
  EXPECT_EQ(rings[0].points, expected);
  using enum EdgeKind;
  EXPECT_EQ(rings[0].edges,
            (std::vector{shoreline, shoreline, bin_border, bin_border, bin_border}));
  EXPECT_GT(area_of(rings[0]), 0.0);
}

TEST(GshhgBin, LandNorthOfAShoreThatRunsEast) {
  const auto rings = rings_of({segment(1, kWest, kEast, {{0, 10000}, {65535, 10000}})});
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_NEAR(area_of(rings[0]), 55535.0 / 65535.0, 1e-9);
}

TEST(GshhgBin, TwoShoresMakeAStraitOrAnIsthmus) {
  const auto strait = rings_of({segment(1, kEast, kWest, {{65535, 20000}, {0, 20000}}),
                                segment(1, kWest, kEast, {{0, 40000}, {65535, 40000}})});
  ASSERT_EQ(strait.size(), 2u);
  EXPECT_NEAR(area_of(strait[0]), 20000.0 / 65535.0, 1e-9);
  const auto isthmus = rings_of({segment(1, kWest, kEast, {{0, 20000}, {65535, 20000}}),
                                 segment(1, kEast, kWest, {{65535, 40000}, {0, 40000}})});
  ASSERT_EQ(isthmus.size(), 1u);
  EXPECT_NEAR(area_of(isthmus[0]), 20000.0 / 65535.0, 1e-9);
  EXPECT_EQ(shore_edges(isthmus[0]), 2);
}

TEST(GshhgBin, ALakeKeepsLandOnTheLeftOfItsShore) {
  const auto rings =
      rings_of({segment(2, kClosed, kClosed,
                        {{1000, 1000}, {1000, 2000}, {2000, 2000}, {2000, 1000}, {1000, 1000}})},
               1);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[1].level, 2);
  EXPECT_LT(area_of(rings[1]), 0.0);
  EXPECT_EQ(shore_edges(rings[1]), 4);
}

TEST(GshhgBin, ALakeCutByTheBorderIsClosedAlongIt) {
  const double lake = 0.5 * 9000 * 10000 / (65535.0 * 65535.0);
  // Land on the left, so the shore runs clockwise around the lake at the west border.
  const auto bay = rings_of({segment(2, kWest, kWest, {{0, 20000}, {9000, 15000}, {0, 10000}})}, 1);
  ASSERT_EQ(bay.size(), 2u);
  EXPECT_EQ(bay[1].points.size(), 3u);
  EXPECT_EQ(shore_edges(bay[1]), 2);
  EXPECT_NEAR(area_of(bay[1]), -lake, 1e-9);
  for (int i = 0; i < 3; ++i) {
    const bool along_border = bay[1].points[i].x == 0 && bay[1].points[(i + 1) % 3].x == 0;
    EXPECT_EQ(bay[1].edges[i] == EdgeKind::bin_border, along_border);
  }
  // The other way round, all but a cape of the bin is lake.
  const auto cape =
      rings_of({segment(2, kWest, kWest, {{0, 10000}, {9000, 15000}, {0, 20000}})}, 1);
  ASSERT_EQ(cape.size(), 2u);
  EXPECT_EQ(cape[1].points.size(), 7u);
  EXPECT_NEAR(area_of(cape[1]), lake - 1.0, 1e-9);
}

TEST(GshhgBin, ShoresThatTouchOnTheBorderAreToldApartByTheirTurns) {
  // Three capes on the east border; the second begins where the first ends, in either stored order.
  const std::vector<ShoreSegment> capes = {
      segment(1, kEast, kEast, {{65535, 30000}, {60000, 20000}, {65535, 10000}}),
      segment(1, kEast, kEast, {{65535, 50000}, {60000, 40000}, {65535, 30000}}),
      segment(1, kEast, kEast, {{65535, 60000}, {60000, 55000}, {65535, 52000}})};
  const double cape = 0.5 * 20000 * 5535 / (65535.0 * 65535.0);
  for (const auto& order : {std::array{0, 1, 2}, std::array{2, 1, 0}, std::array{1, 0, 2}}) {
    const auto rings = rings_of({capes[order[0]], capes[order[1]], capes[order[2]]});
    double area = 0.0;
    for (const BinRing& ring : rings) area += area_of(ring);
    EXPECT_NEAR(area, 2 * cape + 0.5 * 8000 * 5535 / (65535.0 * 65535.0), 1e-9);
  }
}

TEST(GshhgBin, AnIslandTurnedInsideOutIsSetRight) {
  const auto rings =
      rings_of({segment(1, kClosed, kClosed, {{100, 100}, {100, 200}, {200, 200}, {100, 100}})});
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_GT(area_of(rings[0]), 0.0);
}

TEST(GshhgBin, AFlatIslandIsLeftOut) {
  EXPECT_TRUE(
      rings_of({segment(1, kClosed, kClosed, {{100, 100}, {200, 200}, {100, 100}})}).empty());
}

TEST(GshhgBin, RepeatedPointsFallAway) {
  const auto rings = rings_of(
      {segment(1, kClosed, kClosed, {{100, 100}, {200, 100}, {200, 100}, {200, 200}, {100, 100}})});
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_EQ(rings[0].points.size(), 3u);
  EXPECT_EQ(rings[0].edges.size(), 3u);
}

TEST(GshhgBin, ContradictionsAreRefused) {
  EXPECT_THROW(rings_of({segment(7, kWest, kEast, {{0, 1}, {65535, 1}})}), BinError);
  EXPECT_THROW(rings_of({segment(1, 5, kEast, {{0, 1}, {65535, 1}})}), BinError);
  EXPECT_THROW(rings_of({segment(1, kClosed, kEast, {{0, 1}, {65535, 1}})}), BinError);
  EXPECT_THROW(rings_of({segment(1, kClosed, kClosed, {{1, 1}, {9, 1}, {9, 9}})}), BinError);
  EXPECT_THROW(rings_of({segment(1, kSouth, kNorth, {{0, 1}, {65535, 1}})}), BinError);
  EXPECT_THROW(rings_of({segment(1, kWest, kEast, {{0, 1}})}), BinError);
  // Two shores that both run west: water and land would meet along the border.
  EXPECT_THROW(rings_of({segment(1, kEast, kWest, {{65535, 100}, {0, 100}}),
                         segment(1, kEast, kWest, {{65535, 900}, {0, 900}})}),
               BinError);
  EXPECT_THROW(assemble_bin({0, {0, 1, 0, 0}, {}}, false), BinError);
}

}  // namespace
}  // namespace skerry::echo
