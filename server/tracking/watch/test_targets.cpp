#include "server/tracking/watch/test_targets.hpp"

#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {

TestTargetNow test_target_at(const TestTarget& target, Duration since_begun) {
  const double time_s = in_seconds(since_begun % kTestTargetsLast);
  const PlanePoint mps = vector_of(target.course_deg, target.speed_kn * kKnot);
  const PlanePoint from =
      vector_of(target.bearing_deg, nautical_miles(target.range_nm).in_metres());
  return {from + mps * time_s, mps};
}

}  // namespace skerry::server
