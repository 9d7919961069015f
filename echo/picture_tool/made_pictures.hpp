// Our pictures at places that stand in for a real one's, which nobody charted for us.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "echo/picture_tool/picture_source.hpp"
#include "echo/radar/radar_set.hpp"
#include "echo/receiver/controls.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// What we would look at a place with.
struct MadeRadar {
  RadarSet set;
  ViewControls controls;  // the instrumented range is the picture's reach
  ScanGeometry geometry;
  std::uint8_t highest = 255;  // what is stronger is shown so

  double reach_m() const { return reach_of(controls).in_metres(); }
};

// Of the set, with the sizes and the reach of `real`; the range scale is the one nearest to the
// reach over `reach_over_scale` of those that reach so far.  The antenna stands 10 m high, as small
// craft's [unverified].
// Error: std::runtime_error where our spokes or cells cannot be so few or so many.
MadeRadar radar_like(const TurnsOfPicture& real, const RadarSet& set, double reach_over_scale);

// A place with its coast, made for one reach and size of cells.
struct StandIn {
  GeoPoint at;
  ScenePtr scene;
};

struct StandInWish {
  std::uint32_t count = 6;
  std::uint64_t seed = 77;
  double occupancy = 0.0;  // of the real picture; 0: not known
  std::uint32_t most_tried = 60;
};

// Told now and then how far something is.
using PictureTelling = std::function<void(const std::string&)>;

// Places afloat near coasts of twelve kinds, as the seed shakes them, in the order they are tried:
// those whose picture echoes on half to twice the share of cells that the real one does; where
// these are too few, then those nearest to that, of at least 1 and at most 70 %.  A pure function
// of chart, radar and wish; takes about a quarter of a second a place tried.
std::vector<StandIn> find_stand_ins(const ChartSource& chart, const MadeRadar& radar,
                                    const StandInWish& wish, const PictureTelling& tell);

// Video of `turns` turns at rest there, one after the other.
TurnsOfPicture make_picture(const MadeRadar& radar, const StandIn& place, std::uint32_t turns);

}  // namespace skerry::echo
