// The leading edge of every spoke against a reference that knows neither plane nor index: each
// chart vertex by its geodesic from the own ship, each edge tried on each ray it can meet.
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "echo/chart/land_mask.hpp"
#include "echo/fractal/clearance.hpp"
#include "echo/fractal/dimension.hpp"
#include "echo/fractal/edge_refiner.hpp"
#include "echo/fractal/koch_edge.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/scene/edge_detail.hpp"
#include "protocol/quantity/bearing.hpp"
#include "tests/scenes/ray_returns.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

constexpr double kNone = 1e12;
constexpr double kOnTheSpot = 1e-3;  // metres

// First meetings with land of `count` rays a turn, each turned by `shift` of a ray.
class LeadingEdges {
 public:
  LeadingEdges(std::uint32_t count, double shift) : shift_(shift), range_(count, kNone) {}

  // An edge between two places given by range and true bearing (radians) from the own ship.
  void add(double range_a, double bearing_a, double range_b, double bearing_b) {
    const auto count = static_cast<double>(range_.size());
    const double step = 2.0 * std::numbers::pi / count;
    double turn = std::remainder(bearing_b - bearing_a, 2.0 * std::numbers::pi);
    const double low = std::min(bearing_a, bearing_a + turn),
                 high = std::max(bearing_a, bearing_a + turn);
    for (double k = std::ceil(low / step - shift_); (k + shift_) * step <= high; k += 1.0) {
      const double bearing = (k + shift_) * step;
      // Intersection of the ray with the straight line between the two, in polar form.
      const double down =
          range_b * std::sin(bearing_b - bearing) - range_a * std::sin(bearing_a - bearing);
      if (std::fabs(down) < 1e-12) continue;
      const double range = range_a * range_b * std::sin(bearing_b - bearing_a) / down;
      double& nearest = range_[static_cast<std::size_t>(k < 0 ? k + count : k) % range_.size()];
      if (range >= 0.0) nearest = std::min(nearest, range);
    }
  }
  double operator[](std::size_t ray) const { return range_[ray]; }

 private:
  double shift_;
  std::vector<double> range_;
};

struct Polar {
  double range, bearing;
};

// The reference coast: chart vertices by geodesic, refined in the plane of those polar coordinates.
// It stops splitting where the picture did: the same decision, in the picture's plane.
class ReferenceCoast {
 public:
  ReferenceCoast(const CoastChart& chart, const CoastPicture& picture, GeoPoint own_ship,
                 const RadarResolution& resolution)
      : apex_(apex_factor_for_dimension(CoastStyle{}.dimension)) {
    std::map<std::uint64_t, PlanePoint> exact;
    std::vector<ShoreEdge> in_plane, by_geodesic;
    for (const CoastRing& ring : chart.rings) {
      const std::size_t n = ring.vertices.size();
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        if (ring.edges[i] != EdgeKind::shoreline || ring.vertex_ids[i] == ring.vertex_ids[j])
          continue;
        for (std::size_t k : {i, j}) {
          if (exact.count(ring.vertex_ids[k])) continue;
          double s = 0, azimuth = 0, back = 0;
          GeographicLib::Geodesic::WGS84().Inverse(
              own_ship.latitude_deg, own_ship.longitude_deg, ring.vertices[k].latitude_deg,
              ring.vertices[k].longitude_deg, s, azimuth, back);
          const double b = azimuth * std::numbers::pi / 180.0;
          exact[ring.vertex_ids[k]] = {s * std::sin(b), s * std::cos(b)};
        }
        in_plane.push_back({picture.plane.to_plane(ring.vertices[i]),
                            picture.plane.to_plane(ring.vertices[j]), ring.vertex_ids[i],
                            ring.vertex_ids[j]});
        by_geodesic.push_back({exact[ring.vertex_ids[i]], exact[ring.vertex_ids[j]],
                               ring.vertex_ids[i], ring.vertex_ids[j]});
      }
    }
    Clearance room(by_geodesic), room_in_plane(in_plane);
    const double slack = CoastPreparer::slack_for(resolution.range_m);
    for (std::uint32_t e = 0; e < in_plane.size(); ++e) {
      const PlanePoint u = by_geodesic[e].from, v = by_geodesic[e].to;
      if (std::min(std::hypot(u.east_m, u.north_m), std::hypot(v.east_m, v.north_m)) -
              std::hypot(u.east_m - v.east_m, u.north_m - v.north_m) >
          resolution.range_m + slack) {
        continue;
      }
      const std::uint64_t seed = mixed(in_plane[e].seed(), 1);
      const CoastPiece plane{in_plane[e].from, in_plane[e].to, seed}, by_geodesic_piece{u, v, seed};
      const double length =
          std::hypot(plane.to.east_m - plane.from.east_m, plane.to.north_m - plane.from.north_m);
      const DetailLimit radar{picture.centre, slack, resolution.range_m, resolution.cell_m,
                              resolution.spoke_degrees * std::numbers::pi / 180.0};
      const EdgeDetail detail = detail_of((plane.from + plane.to) * 0.5, length, radar);
      limit_ = detail.rule == EdgeDetail::Rule::whole ? whole_edge_limit(detail.cell_m) : radar;
      if (detail.rule == EdgeDetail::Rule::straight) limit_.range_m = -1.0;
      grow(plane, {room_in_plane.half_angle_tan(e), apex_}, by_geodesic_piece,
           {room.half_angle_tan(e), apex_});
    }
  }

  // Edges as pairs of polar coordinates.
  const std::vector<std::pair<Polar, Polar>>& edges() const { return edges_; }

 private:
  void grow(const CoastPiece& plane, Roughness plane_rough, const CoastPiece& exact,
            Roughness rough) {
    const double length =
        std::hypot(plane.to.east_m - plane.from.east_m, plane.to.north_m - plane.from.north_m);
    if (0.5 * length * plane_rough.half_angle_tan * apex_ <=
        limit_.visible_m(plane.from, plane.to)) {
      const auto polar = [](PlanePoint p) {
        return Polar{std::hypot(p.east_m, p.north_m), std::atan2(p.east_m, p.north_m)};
      };
      const Polar a = polar(exact.from), b = polar(exact.to);
      if (a.range > kOnTheSpot && b.range > kOnTheSpot) edges_.push_back({a, b});
      return;
    }
    CoastPiece a[4], b[4];
    split(plane, plane_rough, a);
    split(exact, rough, b);
    for (int i = 0; i < 4; ++i) grow(a[i], plane_rough, b[i], rough);
  }

  double apex_;
  DetailLimit limit_;  // of the edge at hand
  std::vector<std::pair<Polar, Polar>> edges_;
};

struct Worst {
  double p50 = 0, p99 = 0, max = 0;
  std::size_t rays = 0;
};

// `anchor` is where the plane lies, off the own ship as it may be under way.
Worst compare(const CoastChart& chart, GeoPoint anchor, GeoPoint own_ship, RangeScale scale,
              const char* name) {
  const ScanGeometry geometry;
  const RadarResolution resolution{scale.length().in_metres(),
                                   geometry.cell_size(scale).in_metres(),
                                   360.0 / geometry.spokes_per_turn};
  CoastPreparer preparer(chart, anchor, echo::CoastRules{.seed = 1});
  const auto picture = preparer.prepare(own_ship, resolution);
  const PlanePoint at = picture->plane.to_plane(own_ship);
  const PolarIndex index(*picture, at, 30.0);

  // A ray that grazes a headland meets it or not by less than the arithmetic can say: the reference
  // may be off by a fiftieth of a spoke (0.0018 deg) to either side.
  const ReferenceCoast reference(chart, *picture, own_ship, resolution);
  LeadingEdges exact(geometry.spokes_per_turn, 0.0), before(geometry.spokes_per_turn, -0.02),
      after(geometry.spokes_per_turn, 0.02);
  for (const auto& [a, b] : reference.edges()) {
    exact.add(a.range, a.bearing, b.range, b.bearing);
    before.add(a.range, a.bearing, b.range, b.bearing);
    after.add(a.range, a.bearing, b.range, b.bearing);
  }
  const std::uint32_t north =
      TrueBearing::from(degrees(picture->plane.true_north_degrees(own_ship))).units();
  std::vector<Crossing> crossings;
  std::vector<double> errors;
  for (std::uint32_t ray = 0; ray < geometry.spokes_per_turn; ++ray) {
    find_crossings(*picture, index,
                   {at, TrueBearing::of_spoke(ray, geometry.spokes_per_turn).units() + north},
                   crossings);
    // On a coast vertex every ray begins on the shore itself; what counts is what it meets next.
    const auto met = std::find_if(crossings.begin(), crossings.end(),
                                  [](const Crossing& c) { return c.range_m > kOnTheSpot; });
    const double found = met == crossings.end() ? kNone : met->range_m;
    double error = kNone;
    for (const LeadingEdges* r : {&exact, &before, &after}) {
      const double d = found >= resolution.range_m && (*r)[ray] >= resolution.range_m
                           ? 0.0
                           : std::fabs(found - (*r)[ray]);
      error = std::min(error, d / resolution.cell_m);
    }
    if (found < resolution.range_m || exact[ray] < resolution.range_m) errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  Worst w;
  w.rays = errors.size();
  if (!errors.empty()) {
    w.p50 = errors[errors.size() / 2];
    w.p99 = errors[std::min(errors.size() - 1, errors.size() * 99 / 100)];
    w.max = errors.back();
  }
  std::printf("%-28s %6.3f NM: %4zu spokes meet land, error p50 %.4f p99 %.4f max %.4f cells\n",
              name, scale.in_nautical_miles(), w.rays, w.p50, w.p99, w.max);
  return w;
}

void expect_bounds(const Worst& w) {
  EXPECT_LE(w.p99, 0.5);
  EXPECT_LE(w.max, 1.0);
}

constexpr double kScales[] = {0.25, 0.75, 3.0, 6.0, 12.0, 24.0, 96.0};

TEST(LeadingEdge, OfAMadeUpCoastMatchesGeodesics) {
  for (double nm : kScales) {
    const RangeScale scale = *RangeScale::find(nm);
    const auto chart =
        scenes::made_up_chart(scenes::kBergen, scale.length() * 1.3 + nautical_miles(4), 200, 11);
    const Worst w = compare(chart, scenes::kBergen, scenes::kBergen, scale, "made up");
    expect_bounds(w);
    EXPECT_GT(w.rays, nm > 1.0 ? 100u : 0u) << nm;
  }
}

struct Spot {
  const char* name;
  GeoPoint anchor, own_ship;
};

class LeadingEdgeOfTheWorld : public testing::TestWithParam<double> {};

TEST_P(LeadingEdgeOfTheWorld, MatchesGeodesics) {
  const RangeScale scale = *RangeScale::find(GetParam());
  std::size_t met = 0;
  for (const Spot& spot : {Spot{"Bergen", scenes::kBergen, scenes::kBergen},
                           Spot{"Bergen, 4 km off the anchor", {60.30, 5.19}, scenes::kBergen},
                           Spot{"Fiji, 179.9 W", {-16.80, -179.9}, {-16.80, -179.9}},
                           Spot{"Fiji, 179.9 E", {-16.60, 179.9}, {-16.60, 179.9}},
                           Spot{"Svalbard, 80 N", {80.0, 16.0}, {80.0, 16.0}}}) {
    const auto chart = scenes::world_chart(spot.own_ship, scale.length() * 1.1 + nautical_miles(6));
    if (!chart) GTEST_SKIP() << "no chart installed";
    const Worst w = compare(*chart, spot.anchor, spot.own_ship, scale, spot.name);
    expect_bounds(w);
    met += w.rays;
  }
  EXPECT_GT(met, GetParam() < 1.0 ? 0u : 2000u);
}

TEST_P(LeadingEdgeOfTheWorld, MatchesGeodesicsFromACoastVertex) {
  const RangeScale scale = *RangeScale::find(GetParam());
  const auto chart = scenes::world_chart(scenes::kBergen, scale.length() * 1.1 + nautical_miles(6));
  if (!chart) GTEST_SKIP() << "no chart installed";
  // The shoreline vertex nearest to the place.
  GeoPoint vertex;
  double least = 1e9;
  for (const CoastRing& ring : chart->rings) {
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
      const double d =
          std::hypot(ring.vertices[i].latitude_deg - scenes::kBergen.latitude_deg,
                     0.5 * (ring.vertices[i].longitude_deg - scenes::kBergen.longitude_deg));
      if (ring.edges[i] == EdgeKind::shoreline && d < least) least = d, vertex = ring.vertices[i];
    }
  }
  const Worst w = compare(*chart, vertex, vertex, scale, "on a coast vertex");
  expect_bounds(w);
  EXPECT_GT(w.rays, 1000u);
}

INSTANTIATE_TEST_SUITE_P(SevenScales, LeadingEdgeOfTheWorld, testing::ValuesIn(kScales),
                         [](const auto& scale) {
                           return "Nm" + std::to_string(static_cast<int>(scale.param * 1000));
                         });

// No ray of a ship afloat begins on land, whatever lies beyond the range or was left out of the
// picture: that would be a radial line of false land.
TEST(LeadingEdge, NoRayFromAShipAfloatBeginsOnLand) {
  int positions = 0, rays = 0;
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  for (double nm : {0.75, 1.5, 3.0, 6.0, 12.0}) {
    const RangeScale scale = *RangeScale::find(nm);
    for (int k = 0; k < 24; ++k) {
      const GeoPoint own_ship{60.16 + 0.012 * k,
                              4.85 + 0.4 * as_unit(mixed(7, static_cast<std::uint64_t>(k)))};
      const auto chart = scenes::world_chart(own_ship, scale.length() * 1.1 + nautical_miles(6));
      if (!chart) GTEST_SKIP() << "no chart installed";
      // Well afloat: no shore near enough to be moved past her by refinement.
      if (is_land(*chart, own_ship)) continue;
      const auto scene = scenes::scene_at(*chart, own_ship, scale, {});
      bool near = false;
      for (const PlanePoint& v : scene->coast->vertices)
        near = near || std::hypot(v.east_m, v.north_m) < 30.0;
      if (near) continue;
      EXPECT_FALSE(scene->ashore);
      ++positions;
      for (std::uint32_t ray = 0; ray < 4096; ++ray) {
        find_crossings(*scene->coast, *scene->index, {scene->own_ship, ray << 20}, crossings);
        land_along(
            crossings, scene->ashore,
            std::min(scale.length().in_metres(), complete_range(*scene->coast, scene->own_ship)),
            land);
        rays += !land.empty() && land.front().begin_m == 0.0;
      }
    }
  }
  std::printf("%d positions, %d false radials\n", positions, rays);
  EXPECT_GT(positions, 40);
  EXPECT_EQ(rays, 0);
}

// A ray's first echo stands in the cell of the crossing, wherever neither the transmitter nor
// the horizon hides it.
TEST(LeadingEdge, StandsInTheCellOfItsCrossing) {
  const ScanGeometry geometry;
  const RangeScale scale = *RangeScale::find(6.0);
  auto scene = *scenes::scene_at(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 120, 4),
                                 scenes::kBergen, scale, geometry);
  scene.own_velocity = {};
  RayModel model;
  model.pulse = model.set.pulse_for(scale);
  model.rays_per_turn = geometry.spokes_per_turn;
  model.cells = geometry.cells;
  model.cell_m = geometry.cell_size(scale).in_metres();
  RayScratch scratch;
  std::vector<float> power(geometry.cells);
  std::vector<Crossing> crossings;
  int compared = 0;
  for (std::uint32_t ray = 0; ray < geometry.spokes_per_turn; ++ray) {
    ray_returns(scene, model, RelativeBearing::of_spoke(ray, geometry.spokes_per_turn).units(), 0.0,
                scratch, power);
    find_crossings(*scene.coast, *scene.index,
                   {scene.own_ship, TrueBearing::of_spoke(ray, geometry.spokes_per_turn).units()},
                   crossings);
    if (crossings.empty() || crossings[0].range_m < 150.0 ||
        crossings[0].range_m > scale.length().in_metres())
      continue;
    const auto expected =
        static_cast<std::size_t>(crossings[0].range_m / geometry.cell_size(scale).in_metres());
    const auto first = std::find_if(power.begin(), power.end(), [](float p) { return p > 0.0f; });
    ASSERT_NE(first, power.end());
    EXPECT_EQ(static_cast<std::size_t>(first - power.begin()), expected) << "ray " << ray;
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace skerry::echo
