// The tanker Esso 190 000 dwt.
#pragma once

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// Van Berlekom and Goddard, Maneuvering of large tankers, 1972: three degrees of freedom, in water
// of any depth down to 1.2 times her draught of 18.46 m; shallower counts as that.  304.8 m,
// 220 000 m3, 8.23 m/s at 80 rpm.  She does not keep her course by herself in deep water.
//
// The source holds for way ahead.  Our extension: drag works against way astern as against way
// ahead; the drift angle is held within 60 deg; a shaft that turns astern gives no race.
class TankerHull final : public Hull {
 public:
  static constexpr double kLength_m = 304.8, kDraught_m = 18.46;

  BodyChange change(const BodyMotion& motion, const Actuators& by, double depth_m,
                    const Loads& outside) const override;
  double shaft_change(const Actuators& by, double ordered_rps) const override;
  double length_m() const override { return kLength_m; }
  double draught_m() const override { return kDraught_m; }
};

}  // namespace skerry::server
