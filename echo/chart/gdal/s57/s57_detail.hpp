// Depths and marks of an S-57 cell.
#pragma once

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"

namespace skerry::echo {

// Fills contours and marks of `sheet`:
//  - DEPCNT lines, by VALDCO; one without a depth is left out.
//  - BOY*, BCN*, LITFLT and LITVES; LIGHTS and RTPBCN are told with what stands at their place, by
//    themselves elsewhere.  Ramarks (CATRTB 1) are not told.
//  - WRECKS, OBSTRN and UWTROC, with VALSOU; of a line its middle vertex, of an area a place
//    within it.
// Of a cell whose depths are not in metres (DUNI) contours and VALSOU are left out with a warning.
// More than kMostContourVertices or kMostMarks are left out with a warning.
void read_detail(const S57Cell& cell, bool depths_in_metres, ChartSheet& sheet);

}  // namespace skerry::echo
