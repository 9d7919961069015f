// MotionFrame: to what courses and speeds refer at a moment.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/tracking/watch/target_watch.hpp"

namespace skerry::server {

// A target's motion in it is its relative motion and own ship's together.
struct MotionFrame {
  // Own ship's, m/s; absent: nothing tells it, so courses and speeds are not known.  Relative
  // motion and CPA need none of it.
  std::optional<PlanePoint> own_mps;
  std::string by;       // as TargetList.stabilised_by
  std::string problem;  // what is lost, and what that means; empty: nothing
};

// A target that is taken to lie still over ground.
struct ReferenceTarget {
  std::uint32_t number = 0;                // 0: none
  bool is_tracked = false;                 // false: it is lost
  std::optional<PlanePoint> relative_mps;  // absent: its motion is not known now
};

// Over ground: by the reference target; by own ship's positions where there is none, or it is lost.
// Through water: by heading and log.  Neither takes the other's place: the two differ by the
// current, and nobody would see it.
MotionFrame motion_frame(wire::Stabilisation stabilisation, const OwnSensors& own,
                         const ReferenceTarget& reference);

}  // namespace skerry::server
