// Whether an echo stands out of its surroundings: the measure behind `sees` and `misses`.
#pragma once

#include <functional>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/video/scan.hpp"

namespace skerry::server {

// Where an echo is to be, and of what sort.
struct EchoPlace {
  enum class Sort { hull, racon, sart };
  Sort sort = Sort::hull;
  GeoPoint position;
  double half_length_m = 0.0;  // of a hull: to any side
  double beam_deg = 1.0;       // the radar's
  double trail_m = 0.0;        // of beacons: how far their signal reaches behind them
};

struct EchoStand {
  bool stands_out = false;
  std::string why;  // in numbers
};

inline constexpr double kLeastRise = 40.0;  // levels of 255
inline constexpr double kLeastSpread = 2.5;
inline constexpr double kLeastTrail = 0.25;
inline constexpr int kLeastDots = 6;

// Levels are means over half a beam's spokes at one range.  The box is where the echo can be: the
// hull's half length and kBoxMargin to all sides, and half a beam besides.  The ring around it
// reaches three beams and 300 m (or the box's size) further and leaves out a guard of a third of
// the box.  Cells whose place, or 100 m or half a beam beside it, is land belong to neither.
//
// A hull stands out if the strongest level of the box is over the ring's median by kLeastRise and
// by kLeastSpread times what the ring's upper tenth is over its median: in a calm any clear echo,
// in clutter one that no wave or shower makes.
// A racon stands out if at least kLeastTrail of the cells behind it, as far as its trail, stand out
// so of the same ranges to either side; a SART if kLeastDots separate runs of cells do.
// Requires a scan of one range scale.
EchoStand stand_of(const EchoPlace& place, const Scan& scan,
                   const std::function<bool(GeoPoint)>& is_land);

// Shares of the picture, each spoke in eight and cell in four looked at: `land` of what the chart
// has as land, `water` of water nearer than `within_m`; lit is a level of 64 or more.
struct LitShares {
  double land = 0.0, water = 0.0;
  int land_cells = 0, water_cells = 0;  // looked at
};
LitShares lit_shares(const Scan& scan, double within_m,
                     const std::function<bool(GeoPoint)>& is_land);

}  // namespace skerry::server
