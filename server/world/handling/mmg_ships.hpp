// Particulars of hulls by the MMG method: one published ship, and others out of their main sizes.
#pragma once

#include "server/world/handling/mmg_hull.hpp"

namespace skerry::server {

// KVLCC2, full scale (Yasukawa and Yoshimura 2015, tables 1 to 4): 320 m, 312 600 m3.
MmgParticulars kvlcc2();

// A ship of which only the sizes are known.
struct MainSizes {
  double length_m, beam_m, draught_m, block;
  double total_resistance;  // coefficient CT of the wetted surface at service speed
  double propeller_m;
  double rudder_m2;
  double shaft_rate_rps2;
};

// From regressions: Kijima and Inoue for the linear terms of the hull, the rudder and the wake,
// Clarke 1983 for added masses; cross-flow drag instead of cubic terms.  Surge terms are those of
// KVLCC2 but for the fourth power of v, the propeller has a pitch of its diameter (KT 0.44 - 0.29 J
// - 0.13 J^2, assumed), several screws and rudders count as one.  Made for displacement ships of
// block 0.5 to 0.85: a fast craft is outside that, and only handles like one.  What it makes of
// KVLCC2's own sizes differs from her published coefficients by what
// MmgShips.RegressionsAreNearThePublishedShip prints.
MmgParticulars from_sizes(const MainSizes& sizes);

}  // namespace skerry::server
