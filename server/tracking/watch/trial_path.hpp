// TrialPath: where own ship would be if she manoeuvred, and how close others would come.
#pragma once

#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

// Own ship keeps on for the delay, then turns the shorter way (to starboard, if both are equal) at
// her rate of turn and, at the same time, goes over to her new speed.  She goes where her bow
// points: no drift, no loss of speed in the turn.
class TrialPath {
 public:
  // A manoeuvre that would last longer is broken off; she keeps on as she then goes.
  static constexpr double kLongest_s = 3.0 * 3600.0;
  // Error: the path's way is a polygon, within this of the curve.
  static constexpr double kBound_m = 1.0;

  // From course and speed as they are, in the order's ranges; `delay_s`: what is left of it.
  TrialPath(const wire::TrialOrder& order, double course_deg, double speed_mps, double delay_s);

  struct Closest {
    double range_m = 0.0, time_s = 0.0;  // from now; 0: it is never as close as it is now
  };
  // To what is at `place` now, from own ship, and keeps on so (over the same water or ground as own
  // ship's motion).  Over all time to come.  Error: kBound_m.
  Closest closest_to(PlanePoint place, PlanePoint motion_mps) const;

  std::size_t steps() const { return corners_.size(); }

 private:
  struct Corner {
    double time_s = 0.0;
    PlanePoint place;
  };
  std::vector<Corner> corners_;  // from now; beyond the last one she goes on straight
  PlanePoint last_mps_;
};

}  // namespace skerry::server
