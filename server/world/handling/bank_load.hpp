// What a bank does to a ship that runs along it: it draws her near, and her bow away.
#pragma once

#include "server/world/handling/hull.hpp"

namespace skerry::server {

struct BankShape {
  double length_m, beam_m, draught_m, block;  // block coefficient
};

// Forces for each square of her way ahead through the water, u.
struct BankPull {
  double sway = 0.0;  // N for 1 m/s: by u^2, to starboard
  double yaw = 0.0;   // N m for 1 m/s: by u |u|, bow to starboard

  bool acts() const { return sway != 0.0 || yaw != 0.0; }
};

// Of a straight wall to STARBOARD, parallel to her, from the bottom up through the surface:
// `distance_m` >= 0 from her middle to it, the water `depth_m` deep.  sway >= 0, yaw <= 0.
//
// Derived, for no published formula could be checked against a second source: slender-body theory.
//   Her section areas S(x) are a line of sources U S'(x) (twice that for her and her mirror image
//   in the surface).  Bank and bottom are plane mirrors.  R^2 = (x - y)^2 + 4 a^2 + 4 k^2 h^2:
//   Lagally: Y / U^2 = rho / 2pi  int int S'(x) S'(y)  sum over all k of 2a / R^3  dx dy
//   Flow across her stern (x = -L/2), towards the bank:
//            v / U = 1 / 2pi  int S'(y)  sum over all k of 2a / R^3  dy
//   Her stern sheds the momentum m U v of that flow, half a length astern: the moment that turns
//   her bow out.  m = -(4 rho h^2 / pi) ln cos(pi T / 2h): the added mass of a plate of her
//   draught over a flat bottom (deep: rho pi T^2 / 2, the wing of R. T. Jones).
// Assumed: parabolic ends and a parallel middle, alike fore and aft, with S = B T amidships where
// the block coefficient is 2/3 or more; the flow leaves her stern as it leaves a wing's edge, over
// all of her draught (astern: her bow); no waves (way well below sqrt(g h)).
// Left out: her beam (lines of sources are worst where she nearly touches), that she is pushed off
// where there is hardly any water below her keel, slopes, and a second bank's images of the first.
// Nearer than 0.6 beams: falls with the distance to nothing on the line itself.  From 6 beams on it
// fades, and is nothing from 8 on.  Depths count from 1.1 to 20 draughts.
// Error: within 0.5 % of those integrals; held by BankLoad.IsThatOfTheIntegrals, and the first of
// them against the pressure on the wall by BankLoad.IsThePressureOnTheWall.  Cost: about 1 us.
BankPull wall_pull(const BankShape& shape, double distance_m, double depth_m);

// Whence a bank is felt, and where the pull is at its strongest: from a ship's middle.
inline double bank_reach_m(const BankShape& shape) { return 8.0 * shape.beam_m; }
inline double bank_nearest_m(const BankShape& shape) { return 0.6 * shape.beam_m; }

// `u`: m/s ahead.  Astern the suction is the same, and the moment the other way.
Loads bank_load(const BankPull& pull, double u);

}  // namespace skerry::server
