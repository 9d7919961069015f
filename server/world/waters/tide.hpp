// Tide: the height of the water and the hour of the tide.
#pragma once

#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

inline constexpr double kTideHours = 12.4206;  // from one high water of M2 to the next

// Either harmonic constituents, or the plain tide of `sea.tide_range_m`, or none.  The same bits on
// every machine, constituents or not, but for level_m() of the plain tide.
// Sources: speeds of the constituents as the Admiralty and NOAA print them (degrees an hour:
// M2 28.9841042, S2 30, N2 28.4397295, K2 30.0821373, K1 15.0410686, O1 13.9430356, P1 14.9589314,
// Q1 13.3986609, M4 57.9682084, MS4 58.9841042); nodal factors are those of the begin, for an
// exercise is short.
class Tide {
 public:
  explicit Tide(const scenario::Sea& sea);

  bool has_constituents() const { return !constituents_.empty(); }
  // Of the water over the mean level, m: the sum of amplitude * cos(speed * t + phase).
  double height_m(Duration time) const;
  // Over the charted coastline, m: that is the mean level and the amplitudes of M2 and S2 (mean
  // high water springs) with constituents, and high water without.
  double over_coastline_m(Duration time) const;
  // Since high water, -6.21 .. 6.21 h: of M2, or of the plain tide.
  double hours_from_high_water(Duration time) const;
  // 0 at neaps, 1 at springs: where the range of M2 and S2 together stands between their least and
  // greatest.  Without both: 1.
  double springs(Duration time) const;

 private:
  struct Constituent {
    double speed_deg_h, amplitude_m, phase_deg;
  };
  const Constituent* find(scenario::TideConstituent::Name name) const;

  std::vector<Constituent> constituents_;
  std::vector<scenario::TideConstituent::Name> names_;  // as long
  double range_m_, high_water_h_;                       // of the plain tide
};

}  // namespace skerry::server
