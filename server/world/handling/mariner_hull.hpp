// The Mariner class cargo ship.
#pragma once

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// Chislett and Stroem-Tejsen, Planar motion mechanism tests and full-scale steering and
// manoeuvring predictions for a Mariner class vessel, 1965: a Taylor series of third order about
// 15 kn, three degrees of freedom, deep water.  160.93 m, 15 kn.
//
// The series knows no propeller: the ship tends to the speed that belongs to her shaft, taken as
// 15 kn at 84 rpm and in proportion (assumed).  Our extension where she differs from that by more
// than 40 % of her speed: drag and thrust as squares, 92e-5 of the length squared, which has the
// slope of the series.  An astern shaft gives 0.6 of the speed.  Below 1.5 m/s forces are those of
// 1.5 m/s in proportion to the motion; broadside they are cross-flow drag (cross_flow.hpp).
class MarinerHull final : public Hull {
 public:
  static constexpr double kLength_m = 160.93, kDraught_m = 7.468;
  static constexpr double kServiceSpeed_mps = 7.7175, kServiceShaft_rps = 1.4;

  BodyChange change(const BodyMotion& motion, const Actuators& by, double depth_m,
                    const Loads& outside) const override;
  double shaft_change(const Actuators& by, double ordered_rps) const override;
  double length_m() const override { return kLength_m; }
  double draught_m() const override { return kDraught_m; }
};

}  // namespace skerry::server
