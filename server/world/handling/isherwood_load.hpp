// What the wind does to a merchant ship, by Isherwood's regression.
#pragma once

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// What his regression asks of a ship.  Areas are projections above the water.
struct IsherwoodShape {
  double length_m = 0.0;  // over all
  double beam_m = 0.0;
  double frontal_m2 = 0.0, lateral_m2 = 0.0;
  double superstructure_m2 = 0.0;  // of the lateral area
  double perimeter_m = 0.0;        // of the lateral projection, without waterline and masts
  double centre_from_bow_m = 0.0;  // of the lateral area
  int masts = 0;                   // groups of masts or king posts, seen from the side
  double height_m = 0.0;           // of the lateral area's centre above the water
};

// `wind_x`, `wind_y` and the signs of what comes out as in wind_load.hpp.  Nothing if it is calm.
// Source: Isherwood, Wind resistance of merchant ships, Trans. RINA 115 (1972): CX, CY and CN for
// every 10 deg off the bow, straight lines between; the table as two programs print it alike.  CX
// counts with the frontal area, CY with the lateral, CN with that and the length, about midship.
// He has no heeling moment: the side force at the centre's height (assumed).
// Error: his fit's (not at hand); outside merchant ships unknown.  Of a high-sided ship (2 AL / L^2
// of 0.2 and more) CX changes its sign twice, before and behind the beam, as his rows have it.
// Held by IsherwoodLoad.IsThatOfAnotherProgram and ...IsNearBlendermannForMerchantShips.
Loads isherwood_load(const IsherwoodShape& shape, double wind_x, double wind_y);

}  // namespace skerry::server
