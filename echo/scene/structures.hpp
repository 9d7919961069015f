// Structures: what is built on the coast and in the water, in the plane.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "echo/chart/chart_object.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A vertical face, seen from both sides.
struct Wall {
  PlanePoint from, to;
  float base_m = 0.0f, top_m = 0.0f;  // over the water
  ObjectClass kind = ObjectClass::pier;
};

// Something small.
struct PointObject {
  PlanePoint place;
  float height_m = 1.0f;          // over the water
  float cross_section_m2 = 1.0f;  // X band
  ObjectClass kind = ObjectClass::buoy;
  std::uint64_t identity = 0;
};

// A bridge's deck is at least so deep, metres, where the chart gives no more than its clearance.
inline constexpr double kDeckDepth = 2.0;

struct Structures {
  std::vector<Wall> walls;
  std::vector<PointObject> points;
};

}  // namespace skerry::echo
