#include "echo/fractal/edge_refiner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "echo/fractal/clearance.hpp"
#include "tests/scenes/every_method.hpp"
#include "tests/unit/fractal/fractal_samples.hpp"

namespace skerry::echo {
namespace {

using samples::any_edge;
using samples::chance;

constexpr SeriesPhases kPhases[] = {SeriesPhases::cosine, SeriesPhases::alternating,
                                    SeriesPhases::random};

// Styles over the whole of what a method takes.
CoastStyle any_style(CoastMethod method, std::uint64_t run) {
  return {.method = method,
          .dimension = 1.0 + (greatest_dimension(method) - 1.0) * chance(run, 20),
          .amplitude = 4.0 * chance(run, 21) * chance(run, 22),
          .gamma = 1.05 + 6.95 * chance(run, 23) * chance(run, 24),
          .phases = kPhases[run % 3]};
}

std::vector<PlanePoint> grown(const EdgeRefiner& refiner, const GrowingEdge& edge,
                              const DetailLimit& limit) {
  std::vector<PlanePoint> curve{edge.from};
  refiner.refine(edge, limit, curve);
  return curve;
}

class EveryMethod : public testing::TestWithParam<CoastMethod> {};
INSTANTIATE_TEST_SUITE_P(Coast, EveryMethod, testing::ValuesIn(scenes::every_method()),
                         scenes::kMethodName);

// 12 000 edges of each method, each with a style of its own: the guarantees of refine().
TEST_P(EveryMethod, KeepsItsGuarantees) {
  double outside = 0.0;
  std::size_t vertices = 0, turned_back = 0;
  for (std::uint64_t set = 0; set < 60; ++set) {
    const EdgeRefiner refiner(any_style(GetParam(), set));
    for (std::uint64_t i = 0; i < 200; ++i) {
      const std::uint64_t run = 1000 * set + i;
      const GrowingEdge edge = any_edge(run);
      const double length = length_of(edge.to - edge.from);
      const DetailLimit coarse{.centre = edge.from + PlanePoint{3000.0 * chance(run, 7), 0.0},
                               .slack_m = 100.0,
                               .range_m = 3000.0,
                               .cell_m = std::max(0.3, 0.2 * length * chance(run, 8)),
                               .spoke_radians = 0.002};
      DetailLimit fine = coarse;
      fine.cell_m *= 0.25 + 0.75 * chance(run, 9);
      fine.spoke_radians *= chance(run, 10);
      fine.range_m += 1000.0 * chance(run, 11);
      const std::vector<PlanePoint> few = grown(refiner, edge, coarse);
      const std::vector<PlanePoint> many = grown(refiner, edge, fine);
      vertices += few.size() + many.size();

      ASSERT_EQ(few.back(), edge.to);
      ASSERT_EQ(many.back(), edge.to);
      std::size_t found = 0;  // nested: the few are among the many, in order, to the last bit
      for (const PlanePoint& p : many) found += found < few.size() && p == few[found];
      ASSERT_EQ(found, few.size()) << "edge " << run;

      const PlanePoint along = (edge.to - edge.from) * (1.0 / length);
      double before = 0.0;
      for (const PlanePoint& p : many) {
        const double a = dot(along, p - edge.from), h = cross(along, p - edge.from);
        ASSERT_TRUE(std::isfinite(a) && std::isfinite(h));
        outside = std::max(outside,
                           (std::fabs(h) - edge.half_angle_tan * std::min(a, length - a)) / length);
        turned_back += a < before - 1e-9;
        before = a;
      }
    }
  }
  std::printf("%s: %zu vertices, worst excursion from the rhombus %.3g of the edge\n",
              name_of(GetParam()).data(), vertices, outside);
  EXPECT_LE(outside, 1e-9);  // of 1e4 m: rounding at 20 km from the origin
  const bool is_graph = GetParam() == CoastMethod::straight ||
                        GetParam() == CoastMethod::midpoint ||
                        GetParam() == CoastMethod::weierstrass;
  if (is_graph) {
    EXPECT_EQ(turned_back, 0u);  // a graph over the edge cannot cross itself
  }
}

TEST_P(EveryMethod, DependsOnNothingButItsArguments) {
  const EdgeRefiner refiner(any_style(GetParam(), 4)), again(any_style(GetParam(), 4));
  const DetailLimit limit{.cell_m = 2.0};
  std::vector<std::vector<PlanePoint>> forwards;
  for (std::uint64_t i = 0; i < 300; ++i) {
    GrowingEdge edge = any_edge(i);
    edge.half_angle_tan = kMaxHalfAngleTan;
    forwards.push_back(grown(refiner, edge, limit));
  }
  for (std::uint64_t i = 300; i-- > 0;) {
    GrowingEdge edge = any_edge(i);
    edge.half_angle_tan = kMaxHalfAngleTan;
    ASSERT_EQ(grown(again, edge, limit), forwards[i]);
  }
}

TEST_P(EveryMethod, NeverCrossesOrTouchesItself) {
  std::size_t pairs = 0;
  for (std::uint64_t run = 0; run < 60; ++run) {
    CoastStyle style = any_style(GetParam(), run);
    style.dimension = greatest_dimension(GetParam());
    style.amplitude = run % 2 ? 1.0 : 4.0;
    GrowingEdge edge{{0, 0}, {600, 200}, mixed(run, 1), kMaxHalfAngleTan};
    const std::vector<PlanePoint> curve = grown(EdgeRefiner(style), edge, {.cell_m = 12.0});
    const auto piece = [&](std::size_t i) { return ShoreEdge{curve[i], curve[i + 1], i, i + 1}; };
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      for (std::size_t j = i + 2; j + 1 < curve.size(); ++j, ++pairs) {
        ASSERT_GT(segment_distance(piece(i), piece(j)), 0.0)
            << "pieces " << i << " and " << j << " of run " << run;
      }
    }
  }
  if (GetParam() != CoastMethod::straight) {
    EXPECT_GT(pairs, 100000u);
  }
}

// Star-shaped islands packed at random, each edge within its clearance: no piece of one edge ever
// meets a piece of another but at the vertex they share.  So land and sea stay on their sides.
TEST_P(EveryMethod, NeighboursNeverMeetWithinTheirClearance) {
  std::vector<ShoreEdge> edges;
  for (std::uint64_t island = 0; island < 36; ++island) {
    const PlanePoint middle{300.0 * static_cast<double>(island % 6),
                            300.0 * static_cast<double>(island / 6)};
    const std::size_t corners = 5 + mixed(island, 7) % 9;
    std::vector<PlanePoint> ring;
    for (std::size_t k = 0; k < corners; ++k) {
      const double a = 6.283185307 * static_cast<double>(k) / static_cast<double>(corners);
      const double r = 20.0 + 128.0 * chance(island, 100 + k);
      ring.push_back(middle + PlanePoint{r * std::cos(a), r * std::sin(a)});
    }
    for (std::size_t k = 0; k < corners; ++k) {
      edges.push_back(
          {ring[k], ring[(k + 1) % corners], 100 * island + k, 100 * island + (k + 1) % corners});
    }
  }
  Clearance clearance(edges);
  const EdgeRefiner refiner(
      {.method = GetParam(), .dimension = greatest_dimension(GetParam()), .amplitude = 4.0});
  std::vector<std::vector<PlanePoint>> curves;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    curves.push_back(
        grown(refiner, {edges[i].from, edges[i].to, edges[i].seed(), clearance.half_angle_tan(i)},
              {.cell_m = 6.0}));
  }
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      if (segment_distance(edges[i], edges[j]) > 100.0) continue;
      for (std::size_t p = 0; p + 1 < curves[i].size(); ++p) {
        for (std::size_t q = 0; q + 1 < curves[j].size(); ++q) {
          const PlanePoint a = curves[i][p], b = curves[i][p + 1];
          const PlanePoint c = curves[j][q], d = curves[j][q + 1];
          if (a == d || b == c || a == c || b == d) continue;
          ++pairs;
          ASSERT_GT(segment_distance({a, b, 0, 1}, {c, d, 2, 3}), 0.0)
              << "edges " << i << " and " << j;
        }
      }
    }
  }
  std::printf("%s: %zu pairs of pieces\n", name_of(GetParam()).data(), pairs);
}

// The paper adds one offset to x and y, so that an edge's roughness depends on its bearing and is
// nothing at 45 deg (SOURCES.md "Corrections 1").
TEST_P(EveryMethod, IsEquallyRoughAtAllBearings) {
  if (GetParam() == CoastMethod::straight) return;
  const EdgeRefiner refiner({.method = GetParam(), .dimension = 1.15});
  double least_rms = 1e9, most_rms = 0.0, least_length = 1e9, most_length = 0.0;
  for (double bearing = 0.0; bearing < 360.0; bearing += 22.5) {
    const double r = bearing * 0.017453292519943295;
    const PlanePoint to{1000.0 * std::sin(r), 1000.0 * std::cos(r)};
    double square = 0.0, length = 0.0;
    std::size_t count = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const std::vector<PlanePoint> curve =
          grown(refiner, {{0, 0}, to, mixed(seed, 3), kMaxHalfAngleTan}, {.cell_m = 10.0});
      for (std::size_t i = 1; i < curve.size(); ++i, ++count) {
        const double h = cross(to, curve[i]) / 1000.0;
        square += h * h;
        length += length_of(curve[i] - curve[i - 1]);
      }
    }
    const double rms = std::sqrt(square / static_cast<double>(count));
    least_rms = std::min(least_rms, rms);
    most_rms = std::max(most_rms, rms);
    // With the same number of pieces the length says the dimension: L ~ ruler^(1-D).
    least_length = std::min(least_length, length);
    most_length = std::max(most_length, length);
  }
  std::printf("%s: rms %.2f to %.2f m, length %.0f to %.0f m\n", name_of(GetParam()).data(),
              least_rms, most_rms, least_length / 100, most_length / 100);
  EXPECT_GT(least_rms, 20.0);
  EXPECT_LT(most_rms / least_rms, 1.05);
  EXPECT_LT(most_length / least_length, 1.01);
}

// The detail left out by a limit: how far it stands out from the coast that is made.
TEST_P(EveryMethod, LeavesOutOnlyWhatIsHardlyVisible) {
  if (GetParam() == CoastMethod::straight) return;
  std::vector<double> missed;
  const EdgeRefiner refiner({.method = GetParam(), .dimension = 1.15});
  for (std::uint64_t run = 0; run < 200; ++run) {
    const double length = 100.0 * std::exp2(2.0 * chance(run, 1));
    const GrowingEdge edge{{0, 0}, {length, 0}, mixed(run, 2), kMaxHalfAngleTan};
    const DetailLimit limit{.cell_m = 10.0};  // visible: 1 m
    const std::vector<PlanePoint> few = grown(refiner, edge, limit);
    const std::vector<PlanePoint> many = grown(refiner, edge, {.cell_m = 0.5});
    std::size_t k = 0;
    for (const PlanePoint& p : many) {
      if (k + 1 < few.size() && p == few[k + 1]) ++k;
      if (k + 1 >= few.size() || p == few[k]) continue;
      const PlanePoint chord = few[k + 1] - few[k];
      missed.push_back(std::fabs(cross(chord, p - few[k])) / length_of(chord));
    }
  }
  std::sort(missed.begin(), missed.end());
  const auto part = [&](double share) {
    return missed[static_cast<std::size_t>(share * static_cast<double>(missed.size() - 1))];
  };
  std::printf("%s: left out of 1 m visible: p50 %.2f, p95 %.2f, p99 %.2f, most %.2f m\n",
              name_of(GetParam()).data(), part(0.5), part(0.95), part(0.99), part(1.0));
  EXPECT_LT(part(0.95), 1.1);
  EXPECT_LT(part(1.0), 5.0);  // half a cell
}

TEST(EdgeRefiner, GivesEdgesTheirSideByTheirSeed) {
  for (const SeriesPhases phases : {SeriesPhases::cosine, SeriesPhases::alternating}) {
    const EdgeRefiner refiner(
        {.method = CoastMethod::weierstrass, .dimension = 1.2, .phases = phases});
    std::size_t left = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      double sum = 0.0;
      for (const PlanePoint& p :
           grown(refiner, {{0, 0}, {100, 0}, mixed(seed, 1), 0.5}, {.cell_m = 5.0}))
        sum += p.north_m;
      left += sum > 0.0;
    }
    EXPECT_NEAR(static_cast<double>(left), 200.0, 40.0);  // 4 standard deviations
  }
}

}  // namespace
}  // namespace skerry::echo
