// The land of an S-57 cell.
#pragma once

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"

namespace skerry::echo {

// Fills coverage (M_COVR where CATCOV is 1), rings and shores of `sheet`:
//  - LNDARE areas are land; LAKARE, RIVERS and CANALS that lie within one of them are water in it.
//  - Edges along SLCONS, dams, dykes, causeways and gates are artificial, whatever CATSLC says;
//    along COALNE as CATCOA says, else along LNDRGN and SBDARE as NATSUR says, else unknown.
//  - Edges on the limit of the coverage are seams: the land goes on where the chart ends.
//  - Edges between two pieces of land are bin_borders.
// An area that reaches more than 0.01 degrees out of the coverage is left out with a warning: group
// 1 objects end at the cell's limit.
//
// Error: std::runtime_error if the cell is too large or has no land and no coverage.
void read_land(const S57Cell& cell, ChartSheet& sheet);

}  // namespace skerry::echo
