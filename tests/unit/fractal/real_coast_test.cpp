// The guarantees of refinement on charted edges: skerries, channels and fjords off Bergen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <utility>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/fractal/clearance.hpp"
#include "echo/fractal/edge_refiner.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

constexpr GeoPoint kBergen{60.27, 5.15};

std::vector<ShoreEdge> edges_off_bergen(const std::filesystem::path& file) {
  const CoastChart chart = GshhgReader::open(file).load(kBergen, nautical_miles(15.0));
  const LocalPlane plane(kBergen);
  std::vector<ShoreEdge> edges;
  for (const CoastRing& ring : chart.rings) {
    const std::size_t n = ring.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      if (ring.edges[i] != EdgeKind::shoreline || ring.vertex_ids[i] == ring.vertex_ids[j])
        continue;
      const PlanePoint a = plane.to_plane(ring.vertices[i]), b = plane.to_plane(ring.vertices[j]);
      if (std::max(length_of(a), length_of(b)) > 15.0 * 1852.0) continue;
      edges.push_back({a, b, ring.vertex_ids[i], ring.vertex_ids[j]});
    }
  }
  return edges;
}

struct Piece {
  ShoreEdge line;
  std::uint32_t edge;
};

bool boxes_meet(const ShoreEdge& p, const ShoreEdge& q) {
  const auto meet = [](double a, double b, double c, double d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
  };
  return meet(p.from.east_m, p.to.east_m, q.from.east_m, q.to.east_m) &&
         meet(p.from.north_m, p.to.north_m, q.from.north_m, q.to.north_m);
}

// Calls visit(p, q) once or more for all pairs of pieces whose boxes meet.
template <typename Visit>
void for_each_near_pair(const std::vector<Piece>& pieces, const Visit& visit) {
  constexpr double kSquare = 5.0;
  std::vector<std::pair<std::int64_t, std::uint32_t>> squares;  // and the pieces in them
  const auto at = [](double x) { return static_cast<std::int64_t>(std::floor(x / kSquare)); };
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const PlanePoint from = pieces[i].line.from, along = pieces[i].line.to - from;
    // In stretches no longer than a square, so that the boxes of long pieces stay small.
    const double stretches = std::floor(length_of(along) / kSquare) + 1.0;
    for (double k = 0.0; k < stretches; ++k) {
      const PlanePoint a = from + along * (k / stretches), b = from + along * ((k + 1) / stretches);
      const auto [x0, x1] = std::minmax({at(a.east_m), at(b.east_m)});
      const auto [y0, y1] = std::minmax({at(a.north_m), at(b.north_m)});
      for (std::int64_t x = x0; x <= x1; ++x) {
        for (std::int64_t y = y0; y <= y1; ++y) squares.emplace_back(x * 1000000 + y, i);
      }
    }
  }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  for (std::size_t begin = 0, end = 0; begin < squares.size(); begin = end) {
    while (end < squares.size() && squares[end].first == squares[begin].first) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = begin; j < i; ++j) {
        const Piece &p = pieces[squares[j].second], &q = pieces[squares[i].second];
        if (boxes_meet(p.line, q.line)) visit(p, q);
      }
    }
  }
}

bool share_an_end(const ShoreEdge& p, const ShoreEdge& q) {
  return p.from == q.to || p.to == q.from || p.from == q.from || p.to == q.to;
}

class RealCoast : public testing::TestWithParam<CoastMethod> {};
INSTANTIATE_TEST_SUITE_P(Bergen, RealCoast, testing::ValuesIn(scenes::every_refining_method()),
                         scenes::kMethodName);

TEST_P(RealCoast, NothingMeetsAndNothingMoves) {
  std::filesystem::path file;
  try {
    file = GshhgReader::find_finest();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();  // not installed; what is wrong with an installed one fails
  }
  const std::vector<ShoreEdge> edges = edges_off_bergen(file);
  Clearance clearance(edges);
  const EdgeRefiner refiner({.method = GetParam(), .dimension = greatest_dimension(GetParam())});
  const DetailLimit coarse{.range_m = 20000.0, .cell_m = 20.0, .spoke_radians = 0.0015};
  const DetailLimit fine{.range_m = 29000.0, .cell_m = 10.0, .spoke_radians = 0.0008};
  std::vector<Piece> pieces;
  std::vector<PlanePoint> few, many;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const GrowingEdge edge{edges[i].from, edges[i].to, edges[i].seed(),
                           clearance.half_angle_tan(i)};
    few.clear();
    many.clear();
    refiner.refine(edge, coarse, few);
    refiner.refine(edge, fine, many);
    std::size_t found = 0;
    for (const PlanePoint& p : many) found += found < few.size() && p == few[found];
    ASSERT_EQ(found, few.size()) << "edge " << i;
    PlanePoint before = edge.from;
    for (const PlanePoint& p : many) {
      pieces.push_back({{before, p, 0, 0}, i});
      before = p;
    }
  }
  // Where the chart's own edges meet, there is nothing to keep apart.
  std::size_t pairs = 0, charted = 0;
  for_each_near_pair(pieces, [&](const Piece& p, const Piece& q) {
    if (share_an_end(p.line, q.line)) return;
    ++pairs;
    if (segment_distance(p.line, q.line) > 0.0) return;
    const ShoreEdge &a = edges[p.edge], &b = edges[q.edge];
    if (p.edge != q.edge && !share_an_end(a, b) && segment_distance(a, b) == 0.0) {
      ++charted;
      return;
    }
    ADD_FAILURE() << "edges " << p.edge << " and " << q.edge << " meet at " << p.line.from.east_m
                  << ", " << p.line.from.north_m;
  });
  std::printf("%s: %zu edges, %zu pieces, %zu near pairs; %zu meet in the chart itself\n",
              name_of(GetParam()).data(), edges.size(), pieces.size(), pairs, charted);
  EXPECT_GT(edges.size(), 8000u);
}

}  // namespace
}  // namespace skerry::echo
