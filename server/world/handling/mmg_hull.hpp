// Hulls by the method of the Manoeuvring Modelling Group (MMG): hull, propeller and rudder apart.
#pragma once

#include <optional>

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// Yasukawa and Yoshimura, Introduction of MMG standard method for ship maneuvering predictions,
// J. Mar. Sci. Technol. 20 (2015).  Midship is the origin.  Hull forces in units of
// 1/2 rho L d U^2, moments times L; added masses in 1/2 rho L^2 d, the added inertia times L^2.
struct MmgParticulars {
  double length_m, beam_m, draught_m, volume_m3;
  double centre_m = 0.0;   // of gravity, ahead of midship
  double gyradius = 0.25;  // of yaw, in lengths
  double added_x, added_y, added_inertia;

  double resistance;  // R0', positive
  double x_vv = -0.040, x_vr = 0.002, x_rr = 0.011, x_vvvv = 0.771;
  double y_v, y_r, n_v, n_r;  // linear
  // The cubic terms of side force and moment.  Without them: cross-flow drag, strip by strip.
  struct Cubic {
    double y_vvv, y_vvr, y_vrr, y_rrr, n_vvv, n_vvr, n_vrr, n_rrr;
  };
  std::optional<Cubic> cubic = {};

  double propeller_m;                   // diameter
  double thrust_0, thrust_1, thrust_2;  // KT = k0 + k1 J + k2 J^2
  double thrust_deduction;
  double wake;                 // wP0, on a straight course
  double propeller_x = -0.48;  // x'P
  // The wake in a turn: 1 - wP = (1 - wP0)(1 + (1 - exp(-c1 |bP|))(c2 - 1)), c2 by the side of
  // the inflow.  Without it: wP = wP0 exp(-4 bP^2).
  struct TurningWake {
    double c1, c2_positive, c2_negative;
  };
  std::optional<TurningWake> turning_wake = {};

  double rudder_m2, rudder_height_m;
  double rudder_slope;                                 // f_alpha
  double rudder_deduction;                             // tR
  double rudder_on_hull;                               // aH
  double rudder_on_hull_x;                             // x'H
  double rudder_x = -0.5;                              // x'R
  double straightening_x = -0.71;                      // l'R
  double straightening_port, straightening_starboard;  // gamma_R, inflow from either side
  double wake_ratio;                                   // epsilon
  double race;                                         // kappa

  double shaft_rate_rps2;     // the fastest change of her shaft's turns
  double side_thrust = 0.05;  // of an astern thrust, to port at a right-handed propeller; assumed
};

// Extensions of our own, beyond the source: past 30 to 50 deg of drift the hull is cross-flow drag
// (cross_flow.hpp), which holds at rest too; an astern
// shaft gives 0.7 of the thrust at rest; the race is that of momentum theory, finite at rest.
// Where the water is less than four times as deep as she, added masses and the linear terms but YR
// grow as (T / (h - T)): 1 + 0.3 x for sway and yaw, 1 + 0.1 x for surge, x at most 5 (assumed:
// shallow water widens her turning circle; no source of these figures).
class MmgHull final : public Hull {
 public:
  explicit MmgHull(const MmgParticulars& particulars);

  BodyChange change(const BodyMotion& motion, const Actuators& by, double depth_m,
                    const Loads& outside) const override;
  double shaft_change(const Actuators& by, double ordered_rps) const override;
  double length_m() const override { return p_.length_m; }
  double draught_m() const override { return p_.draught_m; }

 private:
  // How much the bottom adds.
  struct Shallow {
    double surge, sway;
  };
  Shallow shallow(double depth_m) const;
  Loads hull_forces(const BodyMotion& motion, const Shallow& shallow) const;
  Loads aft_forces(const BodyMotion& motion, const Actuators& by) const;
  double wake_of(double inflow_angle) const;

  MmgParticulars p_;
  double mass_kg_, added_x_kg_, added_y_kg_, inertia_kgm2_, added_inertia_kgm2_;
};

}  // namespace skerry::server
