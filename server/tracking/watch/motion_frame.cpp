#include "server/tracking/watch/motion_frame.hpp"

#include <fmt/format.h>

namespace skerry::server {
namespace {

constexpr const char* kNoCourses = "no courses and speeds of targets; relative motion and CPA stay";

}  // namespace

MotionFrame motion_frame(wire::Stabilisation stabilisation, const OwnSensors& own,
                         const ReferenceTarget& reference) {
  if (stabilisation == wire::STABILISATION_WATER) {
    if (own.through_water_mps) return {own.through_water_mps, "gyro and log", ""};
    return {{}, "", fmt::format("speed through water is not known: {}", kNoCourses)};
  }
  if (reference.number != 0 && reference.is_tracked) {
    if (!reference.relative_mps) {
      return {
          {}, "", fmt::format("reference target {} is not seen: {}", reference.number, kNoCourses)};
    }
    return {*reference.relative_mps * -1.0, fmt::format("target {}", reference.number), ""};
  }
  MotionFrame frame;
  if (own.over_ground_mps) {
    frame.own_mps = own.over_ground_mps;
    frame.by = "GNSS";
  } else {
    frame.problem = fmt::format("motion over ground is not known: {}", kNoCourses);
  }
  if (reference.number != 0) {
    if (!frame.problem.empty()) frame.problem += "; ";
    frame.problem += fmt::format("reference target {} is lost{}", reference.number,
                                 frame.own_mps ? ": courses and speeds are by GNSS" : "");
  }
  return frame;
}

}  // namespace skerry::server
