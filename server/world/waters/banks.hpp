// Banks: walls along lines, and those of them that are near a place.
#pragma once

#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "server/world/hull_outline.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// The nearest point of a bank's part between two of its points.
struct NearWall {
  PlanePoint way;           // to it
  double distance_m = 0.0;  // positive
  // How much of a wall it is from here: 1 where a part is abreast, and beyond its end the square of
  // the cosine by which the way to that end is off the right angle.
  double share = 1.0;
};

// Immutable.  The same bits on every machine.
class Banks {
 public:
  // Of a scenario whose banks are sound (check_waters).
  explicit Banks(const scenario::Scenario& scenario);

  // All parts within `reach_m` but those through the very place, nearest first.  Requires at most
  // 5 km.  Cost: some 10 ns a bank that is far, some 50 ns a part of one that is near.
  std::vector<NearWall> near(GeoPoint at, double reach_m) const;

  // The first that a hull at `at` touches: its name, or "the bank".  nullptr: none.
  const std::string* touched_by(GeoPoint at, const HullOutline& hull) const;

 private:
  struct Line {
    std::string name;
    std::vector<GeoPoint> points;
    // About all of them; degrees, east of the first point.
    double south = 0.0, north = 0.0, west = 0.0, east = 0.0;
  };
  static bool may_reach(const Line& line, GeoPoint at, double reach_m);

  std::vector<Line> lines_;
};

}  // namespace skerry::server
