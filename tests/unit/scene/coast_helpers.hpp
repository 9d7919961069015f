// Charts by the metre and pictures taken apart, for the tests of the coast.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/scene/coast_picture.hpp"

namespace skerry::echo::test {

inline constexpr GeoPoint kMiddle{60.27, 5.15};

// So many metres east and north of `centre`, on a sphere; below 89 deg of latitude.
GeoPoint place(GeoPoint centre, double east_m, double north_m);

// A closed ring through the places, in metres about `centre`, land on the left; identities from the
// coordinates, so that equal places are one vertex.
CoastRing ring(GeoPoint centre, const std::vector<PlanePoint>& places);

// A ring of `corners` vertices, counter-clockwise, on a circle whose radius varies by chance
// between (1 - rough) and 1 of `radius_m`.
CoastRing island(GeoPoint centre, PlanePoint middle, double radius_m, int corners, double rough,
                 std::uint64_t seed);

CoastChart chart(std::vector<CoastRing> rings, double radius_m = 30e3, GeoPoint centre = kMiddle);

RadarResolution resolution(double nm, std::uint32_t cells = 1024, std::uint32_t spokes = 4096);

// Rules under which every coast is refined by that method; the dimension, or the method's greatest.
CoastRules all_by(CoastMethod method, double dimension = 1.15);

bool identical(const CoastPicture& a, const CoastPicture& b);

using VertexSet = std::set<std::pair<double, double>>;
VertexSet vertices_of(const CoastPicture& picture);

// The refined coast by chart edge: what lies between two vertices of the chart, ends included.
struct Chain {
  std::uint32_t first;  // its first vertex in the picture
  std::vector<PlanePoint> points;
};
// `straight`: the same picture with every coast straight, which has the chart's vertices alone.
std::vector<Chain> chains_of(const CoastPicture& picture, const CoastPicture& straight);

// How often two refined edges, or two pieces of one, touch but at a vertex they share.  Pieces of
// edges that are straight in both are not counted: they are as the chart has them.
int meetings(const std::vector<Chain>& chains);

// Signed crossings of a ray east from `from` with all edges of the picture.
int winding(const CoastPicture& picture, PlanePoint from);

}  // namespace skerry::echo::test
