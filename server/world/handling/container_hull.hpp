// The container ship S175.
#pragma once

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// Son and Nomoto, On the coupled motion of steering and rolling of a high-speed container ship,
// 1982: four degrees of freedom with roll, deep water.  175 m, 21 222 m3, metacentre at 0.3 m.
//
// Our extension: below 1.5 m/s forces of the hull are those of 1.5 m/s in proportion; broadside
// they are cross-flow drag (cross_flow.hpp); an astern shaft thrusts 0.35 of what an ahead one does
// from rest, whatever the ship's speed; from 12 to 20 deg of roll the righting lever doubles, and
// roll is damped by 4e-6 p' |p'| besides.
class ContainerHull final : public Hull {
 public:
  static constexpr double kLength_m = 175.0, kDraught_m = 8.5;

  BodyChange change(const BodyMotion& motion, const Actuators& by, double depth_m,
                    const Loads& outside) const override;
  double shaft_change(const Actuators& by, double ordered_rps) const override;
  double length_m() const override { return kLength_m; }
  double draught_m() const override { return kDraught_m; }
};

}  // namespace skerry::server
