#include "echo/fractal/clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "echo/fractal/koch_edge.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

TEST(Clearance, AloneAnEdgeHasAllTheRoomThereIs) {
  const std::vector<ShoreEdge> edges{{{0, 0}, {100, 0}, 1, 2}};
  EXPECT_NEAR(Clearance(edges).half_angle_tan(0), kMaxHalfAngleTan, 1e-7);
}

TEST(Clearance, TwoBanksOfAChannelShareIt) {
  const std::vector<ShoreEdge> edges{{{0, 0}, {100, 0}, 1, 2}, {{100, 10}, {0, 10}, 3, 4}};
  Clearance clearance(edges);
  for (std::uint32_t i : {0u, 1u}) {
    const double height = 50.0 * clearance.half_angle_tan(i);
    EXPECT_NEAR(height, 4.7, 1e-4);
  }
}

TEST(Clearance, ASharpCornerIsShared) {
  const double angle = 0.3;
  const std::vector<ShoreEdge> edges{
      {{100, 0}, {0, 0}, 1, 2}, {{0, 0}, {100 * std::cos(angle), 100 * std::sin(angle)}, 2, 3}};
  Clearance clearance(edges);
  EXPECT_LT(std::atan(clearance.half_angle_tan(0)) + std::atan(clearance.half_angle_tan(1)), angle);
  EXPECT_GT(clearance.half_angle_tan(0), 0.4 * angle);
}

TEST(Clearance, AnEdgeOnTopOfAnotherStaysStraight) {
  const std::vector<ShoreEdge> edges{{{0, 0}, {100, 0}, 1, 2}, {{100, 0}, {0, 0}, 2, 1}};
  Clearance clearance(edges);
  EXPECT_EQ(clearance.half_angle_tan(0), 0.0);
  EXPECT_EQ(clearance.half_angle_tan(1), 0.0);
}

// A crowded, crooked coast: star-shaped islands packed at random, refined three levels; no two
// pieces from different edges ever meet but at a vertex the edges share.
TEST(Clearance, RefinedNeighboursNeverMeet) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<ShoreEdge> edges;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 12; ++column) {
      const PlanePoint middle{300.0 * column, 300.0 * row};
      const std::size_t corners = 5 + random() % 9;
      std::vector<PlanePoint> ring;
      for (std::size_t k = 0; k < corners; ++k) {
        const double a = 6.283185307 * static_cast<double>(k) / static_cast<double>(corners);
        const double r = 20.0 + 128.0 * unit(random);
        ring.push_back(middle + PlanePoint{r * std::cos(a), r * std::sin(a)});
      }
      const std::uint64_t base = static_cast<std::uint64_t>(row * 12 + column) * 100;
      for (std::size_t k = 0; k < corners; ++k) {
        edges.push_back({ring[k], ring[(k + 1) % corners], base + k, base + (k + 1) % corners});
      }
    }
  }
  Clearance clearance(edges);
  std::vector<std::vector<ShoreEdge>> pieces(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const Roughness roughness{clearance.half_angle_tan(i), kMaxApexFactor};
    const std::function<void(const CoastPiece&, int)> grow = [&](const CoastPiece& p, int depth) {
      if (depth == 0) {
        pieces[i].push_back({p.from, p.to, 0, 0});
        return;
      }
      CoastPiece four[4];
      split(p, roughness, four);
      for (const CoastPiece& q : four) grow(q, depth - 1);
    };
    grow({edges[i].from, edges[i].to, edges[i].seed()}, 3);
  }
  long pairs = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (segment_distance(edges[i], edges[j]) > 100.0) continue;
      const bool joined = edges[i].to_id == edges[j].from_id || edges[i].from_id == edges[j].to_id;
      for (const ShoreEdge& p : pieces[i]) {
        for (const ShoreEdge& q : pieces[j]) {
          const bool share = p.from == q.to || p.to == q.from || p.from == q.from || p.to == q.to;
          if (joined && share) continue;
          ++pairs;
          ASSERT_GT(segment_distance(p, q), 0.0) << "edges " << i << " and " << j;
        }
      }
    }
  }
  std::printf("%zu edges, %ld pairs of pieces\n", edges.size(), pairs);
  EXPECT_GT(pairs, 100000);
}

TEST(Clearance, DoesNotDependOnTheOrderOfTheEdges) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0.0, 2000.0);
  std::vector<ShoreEdge> edges;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const PlanePoint a{place(random), place(random)};
    edges.push_back(
        {a, a + PlanePoint{place(random) * 0.05, place(random) * 0.05}, 2 * i, 2 * i + 1});
  }
  std::vector<ShoreEdge> reversed(edges.rbegin(), edges.rend());
  Clearance one(edges), other(reversed);
  for (std::uint32_t i = 0; i < 300; ++i) {
    EXPECT_EQ(one.half_angle_tan(i), other.half_angle_tan(299 - i));
  }
}

}  // namespace
}  // namespace skerry::echo
