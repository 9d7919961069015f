#include "echo/fractal/koch_edge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "echo/fractal/clearance.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

struct Rhombus {
  PlanePoint corner[4];  // from, right, to, left
};
Rhombus rhombus_of(const CoastPiece& p, double tan) {
  const PlanePoint along = p.to - p.from, left{-along.north_m, along.east_m};
  const PlanePoint middle = p.from + along * 0.5;
  return {{p.from, middle + left * (-0.5 * tan), p.to, middle + left * (0.5 * tan)}};
}

// How far (as part of the diagonal) a point stands out of a convex quadrilateral.
double outside(const Rhombus& r, PlanePoint p) {
  double worst = 0.0;
  const PlanePoint diagonal = r.corner[2] - r.corner[0];
  for (int i = 0; i < 4; ++i) {
    const PlanePoint side = r.corner[(i + 1) % 4] - r.corner[i];
    const double length = std::sqrt(dot(side, side));
    if (length == 0.0) continue;
    worst = std::max(worst,
                     -cross(side, p - r.corner[i]) / length / std::sqrt(dot(diagonal, diagonal)));
  }
  return worst;
}

// Two convex quadrilaterals share at most their boundary: some side of one has all of the other
// outside, to within `slack` of the longer diagonal.
bool apart(const Rhombus& a, const Rhombus& b, double slack) {
  const auto separates = [&](const Rhombus& p, const Rhombus& q) {
    for (int i = 0; i < 4; ++i) {
      const PlanePoint side = p.corner[(i + 1) % 4] - p.corner[i];
      const double length = std::sqrt(dot(side, side));
      double most = -1e300;
      for (const PlanePoint& c : q.corner)
        most = std::max(most, cross(side, c - p.corner[i]) / length);
      if (most <= slack * length) return true;
    }
    return false;
  };
  return separates(a, b) || separates(b, a);
}

TEST(KochEdge, PiecesStayInTheEnvelopeAndApart) {
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 60000; ++seed) {
    const double tan = kMaxHalfAngleTan * as_unit(mixed(seed, 100));
    const double apex = kMaxApexFactor * as_unit(mixed(seed, 101));
    const double angle = 6.283 * as_unit(mixed(seed, 102));
    const double length = std::pow(10.0, -3.0 + 9.0 * as_unit(mixed(seed, 103)));
    const CoastPiece edge{
        {12.0, -7.0}, {12.0 + length * std::cos(angle), -7.0 + length * std::sin(angle)}, seed};
    CoastPiece pieces[4];
    split(edge, {tan, apex}, pieces);
    EXPECT_EQ(pieces[0].from, edge.from);
    EXPECT_EQ(pieces[3].to, edge.to);
    const Rhombus whole = rhombus_of(edge, tan);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(pieces[i].from, i > 0 ? pieces[i - 1].to : edge.from);
      const Rhombus part = rhombus_of(pieces[i], tan);
      for (const PlanePoint& c : part.corner) worst = std::max(worst, outside(whole, c));
      for (int j = 0; j < i; ++j) {
        ASSERT_TRUE(apart(part, rhombus_of(pieces[j], tan), 1e-9))
            << "pieces " << j << " and " << i << " of seed " << seed;
      }
    }
  }
  std::printf("worst excursion from the envelope: %.3g of the edge\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST(KochEdge, IsSeededAndDisplacesAlongTheNormal) {
  const Roughness roughness{kMaxHalfAngleTan, 0.9};
  for (double bearing = 0.0; bearing < 360.0; bearing += 22.5) {
    const double r = bearing * 0.017453292519943295;
    const CoastPiece edge{{0, 0}, {100.0 * std::sin(r), 100.0 * std::cos(r)}, 99};
    CoastPiece pieces[4];
    split(edge, roughness, pieces);
    // The paper adds one offset to x and y, so that edges at 45 deg get no roughness at all
    // (SOURCES.md "Corrections 1"); here the apex stands equally far from the edge at every
    // bearing.
    const double height = cross(edge.to - edge.from, pieces[1].to - edge.from) / 100.0;
    EXPECT_NEAR(height, 100.0 * koch_joints(99, roughness).apex_height, 1e-9);
    EXPECT_GT(std::fabs(height), 5.0);
  }
}

TEST(KochEdge, AStraightEdgeStaysStraight) {
  CoastPiece pieces[4];
  split({{0, 0}, {10, 0}, 5}, {0.0, 0.9}, pieces);
  EXPECT_EQ(pieces[1].to.north_m, 0.0);
  split({{0, 0}, {10, 0}, 5}, {kMaxHalfAngleTan, 0.0}, pieces);
  EXPECT_EQ(pieces[1].to.north_m, 0.0);
}

void refine(const CoastPiece& piece, int depth, Roughness roughness, std::vector<PlanePoint>& out) {
  if (depth == 0) {
    out.push_back(piece.to);
    return;
  }
  CoastPiece pieces[4];
  split(piece, roughness, pieces);
  for (const CoastPiece& p : pieces) refine(p, depth - 1, roughness, out);
}

TEST(KochEdge, ACurveNeverCrossesOrTouchesItself) {
  int segments = 0;
  double nearest = 1e9;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::vector<PlanePoint> curve{{0, 0}};
    refine({{0, 0}, {1000, 0}, seed}, 4, {kMaxHalfAngleTan, kMaxApexFactor}, curve);
    const auto edge = [&](std::size_t i) { return ShoreEdge{curve[i], curve[i + 1], i, i + 1}; };
    for (std::size_t i = 0; i + 1 < curve.size(); ++i, ++segments) {
      for (std::size_t j = i + 2; j + 1 < curve.size(); ++j) {
        const double shorter =
            std::min(std::sqrt(dot(curve[i + 1] - curve[i], curve[i + 1] - curve[i])),
                     std::sqrt(dot(curve[j + 1] - curve[j], curve[j + 1] - curve[j])));
        const double gap = segment_distance(edge(i), edge(j)) / shorter;
        ASSERT_GT(gap, 0.0) << "segments " << i << " and " << j << " of seed " << seed;
        nearest = std::min(nearest, gap);
      }
    }
  }
  std::printf("%d segments, nearest approach %.3g of the shorter one\n", segments, nearest);
}

// The curve of von Koch is (4/3)^n long after n splits.
TEST(KochEdge, RegularWithAFullApexIsFourThirdsAsLongEveryLevel) {
  for (const double bearing : {0.0, 1.0, 2.5}) {
    std::vector<CoastPiece> pieces{
        {{3, 4}, {3 + 100 * std::sin(bearing), 4 + 100 * std::cos(bearing)}, 1}};
    for (int level = 1; level <= 7; ++level) {
      std::vector<CoastPiece> finer;
      double length = 0.0;
      for (const CoastPiece& piece : pieces) {
        CoastPiece four[4];
        split_regular(piece, {kMaxHalfAngleTan, 1.0}, four);
        for (const CoastPiece& q : four) {
          finer.push_back(q);
          length += std::sqrt(dot(q.to - q.from, q.to - q.from));
        }
      }
      pieces = std::move(finer);
      EXPECT_NEAR(length / 100.0, std::pow(4.0 / 3.0, level), 1e-9);
    }
  }
}

TEST(KochEdge, RegularPiecesStayInTheEnvelopeApartAndOnOneSide) {
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    const double tan = kMaxHalfAngleTan * as_unit(mixed(seed, 100));
    const double apex = kMaxRegularApexFactor * as_unit(mixed(seed, 101));
    const double angle = 6.283 * as_unit(mixed(seed, 102));
    const CoastPiece edge{
        {12.0, -7.0}, {12.0 + 50.0 * std::cos(angle), -7.0 + 50.0 * std::sin(angle)}, seed};
    CoastPiece pieces[4];
    split_regular(edge, {tan, apex}, pieces);
    const Rhombus whole = rhombus_of(edge, tan);
    for (int i = 0; i < 4; ++i) {
      const Rhombus part = rhombus_of(pieces[i], tan);
      EXPECT_EQ(pieces[i].seed, seed);
      for (const PlanePoint& c : part.corner) worst = std::max(worst, outside(whole, c));
      for (int j = 0; j < i; ++j) {
        ASSERT_TRUE(apart(part, rhombus_of(pieces[j], tan), 1e-9));
      }
    }
    const double height = cross(edge.to - edge.from, pieces[1].to - edge.from);
    EXPECT_TRUE((seed & 1u) ? height >= 0.0 : height <= 0.0);
  }
  EXPECT_LE(worst, 1e-9);
}

TEST(KochEdge, DeeperLevelsNeverMoveAnOlderVertex) {
  std::vector<PlanePoint> coarse{{0, 0}}, fine{{0, 0}};
  refine({{0, 0}, {700, 300}, 3}, 3, {kMaxHalfAngleTan, 0.9}, coarse);
  refine({{0, 0}, {700, 300}, 3}, 5, {kMaxHalfAngleTan, 0.9}, fine);
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_EQ(coarse[i], fine[i * 16]);
}

}  // namespace
}  // namespace skerry::echo
