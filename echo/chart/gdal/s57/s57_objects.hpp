// Objects on the land and in the water of an S-57 cell.
#pragma once

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"

namespace skerry::echo {

// Fills `sheet.objects`; its rings must be there.  SCAMIN is ignored: it is for displays.
//  - Classes and defaults: object_defaults.hpp.  Charted: HEIGHT, else ELEVAT plus VERLEN, is the
//    top over the water; VERLEN alone the height over the ground; a bridge's VERCLR, or VERCCL of
//    one that opens, is its clearance, 5 m where none is charted.
//  - UWTROC, OBSTRN and WRECKS count where WATLEV says that they stand out at high water (1 partly
//    submerged, 2 always dry) or float (7), wrecks also where CATWRK shows mast or hull.  SLCONS
//    that are under water at high water (3, 4, 5) do not.
//  - SLCONS and MORFAC drawn as lines are walls where they are no edge of land and not on land,
//    drawn as areas blocks where they are not land.  LNDARE drawn as points and lines are rocks.
//  - Buoys, beacons and other points charted radar conspicuous (CONRAD 1, 3), or with a RADRFL at
//    the same place, are reflectors.
//  - A racon (RTPBCN) whose letters are not charted answers "K", with a warning.
//  - Objects past kMostOutlineVertices are left out, with a warning.
void read_objects(const S57Cell& cell, double metres_per_height_unit, ChartSheet& sheet);

}  // namespace skerry::echo
