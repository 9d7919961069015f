// ChartDetail: what a display draws of a chart besides its coast.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

enum class MarkKind : std::uint8_t {
  other,  // a buoy or beacon that is none of the following
  lateral_port,
  lateral_starboard,
  preferred_starboard,  // the preferred channel lies to starboard of it
  preferred_port,
  cardinal_north,
  cardinal_east,
  cardinal_south,
  cardinal_west,
  isolated_danger,
  safe_water,
  special,
  light,  // by itself; one on another mark is told with that
  wreck,
  obstruction,
  rock,
  racon,         // by itself
  light_vessel,  // or a light float
};

struct ChartMark {
  MarkKind kind = MarkKind::other;
  GeoPoint place;
  bool fixed = false;                 // a beacon, not a buoy
  std::uint8_t shape = 0;             // BOYSHP of S-57; 0: not charted
  std::vector<std::uint8_t> colours;  // COLOUR of S-57, from above
  std::string name;                   // OBJNAM, may be empty
  std::string light;                  // its character, "Fl(2) R 5s"; empty: none
  bool racon = false;
  std::optional<float> depth_m;  // over a wreck, an obstruction or a rock; below 0: dries
};

struct DepthContour {
  float depth_m = 0.0f;  // below 0: dries
  std::vector<GeoPoint> line;
};

struct ChartDetail {
  bool is_charted = false;  // a chart that knows of depths and marks covers a part of the window
  std::vector<DepthContour> contours;
  std::vector<ChartMark> marks;
};

}  // namespace skerry::echo
