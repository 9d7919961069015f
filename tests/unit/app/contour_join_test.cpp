// Depth contours that charts have in pieces.
#include "server/app/contour_join.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace skerry::server {
namespace {

using testing::ElementsAre;

constexpr GeoPoint kA{60.0, 5.0}, kB{60.0, 5.1}, kC{60.1, 5.1}, kD{60.1, 5.0}, kE{60.2, 5.0};

TEST(ContourJoin, PiecesOfOneDepthBecomeOneLineWhicheverWayTheyRun) {
  const auto lines = joined({{5.0f, {kC, kB}}, {5.0f, {kC, kD}}, {5.0f, {kA, kB}}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].depth_m, 5.0f);
  EXPECT_TRUE(lines[0].line == (std::vector{kA, kB, kC, kD}) ||
              lines[0].line == (std::vector{kD, kC, kB, kA}));
}

TEST(ContourJoin, ALineThatComesBackIsClosed) {
  const auto lines = joined({{5.0f, {kA, kB}}, {5.0f, {kD, kC, kB}}, {5.0f, {kD, kA}}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].line.size(), 5u);
  EXPECT_EQ(lines[0].line.front(), lines[0].line.back());
  // One that was closed by itself stays as it is.
  const auto ring = joined({{5.0f, {kA, kB, kC, kA}}});
  ASSERT_EQ(ring.size(), 1u);
  EXPECT_THAT(ring[0].line, ElementsAre(kA, kB, kC, kA));
}

TEST(ContourJoin, OtherDepthsAndPlacesWhereThreeMeetAreNotJoined) {
  EXPECT_EQ(joined({{5.0f, {kA, kB}}, {10.0f, {kB, kC}}}).size(), 2u);
  EXPECT_EQ(joined({{5.0f, {kA, kB}}, {5.0f, {kB, kC}}, {5.0f, {kB, kD}}}).size(), 3u);
  // A ring that another touches.
  EXPECT_EQ(joined({{5.0f, {kB, kC, kD, kB}}, {5.0f, {kA, kB}}}).size(), 2u);
  EXPECT_TRUE(joined({{5.0f, {kA}}, {5.0f, {}}}).empty());
  EXPECT_TRUE(joined({}).empty());
}

TEST(ContourJoin, ManyPiecesInAnyOrderAreOneLine) {
  constexpr int kPieces = 20'000;
  std::mt19937 random(3);
  std::vector<echo::DepthContour> pieces;
  for (int i = 0; i < kPieces; ++i) {
    GeoPoint from{60.0, 1e-4 * i}, to{60.0, 1e-4 * (i + 1)};
    if (random() % 2 == 0) std::swap(from, to);
    pieces.push_back({2.0f, {from, to}});
  }
  std::shuffle(pieces.begin(), pieces.end(), random);
  const auto lines = joined(pieces);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].line.size(), kPieces + 1u);
}

TEST(ContourJoin, TwoPiecesThatMeetAtBothEndsAreClosed) {
  const auto lines = joined({{5.0f, {kA, kB, kC}}, {5.0f, {kC, kE, kA}}});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].line.size(), 5u);
  EXPECT_EQ(lines[0].line.front(), lines[0].line.back());
}

}  // namespace
}  // namespace skerry::server
