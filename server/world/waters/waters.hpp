// Waters: tide and tidal streams of an exercise, everywhere and at any time.
#pragma once

#include <array>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/waters/tide.hpp"

namespace skerry::server {

// Of the water over the ground, m/s.
struct Stream {
  double north_mps = 0.0, east_mps = 0.0;
};

// Immutable.  The same bits on every machine.
class Waters {
 public:
  // Of a scenario whose waters are sound (check_waters).
  explicit Waters(const scenario::Scenario& scenario);

  const Tide& tide() const { return tide_; }
  bool has_streams() const { return !diamonds_.empty(); }

  // By all diamonds, weighed by the inverse square of their distances; at a diamond its own.  Each
  // is interpolated between its hours as a vector, and between neaps and springs by the tide's
  // range of the moment.  Beyond 6 h from high water: between the last hour and the first.
  // Without diamonds: nothing.
  // Cost: some 100 ns a diamond.
  Stream stream(GeoPoint at, Duration time) const;
  // What the tide adds to the depth that the scenario gives, m: with constituents that depth is
  // below the mean level; without them it is the depth at all times.
  double over_depth_m(Duration time) const {
    return tide_.has_constituents() ? tide_.height_m(time) : 0.0;
  }

 private:
  static constexpr int kHours = 13;
  struct Diamond {
    GeoPoint at;
    std::array<Stream, kHours> springs, neaps;
  };
  Tide tide_;
  std::vector<Diamond> diamonds_;
};

}  // namespace skerry::server
