// Where small craft lie in an S-57 cell.
#pragma once

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"

namespace skerry::echo {

// Adds moored craft (moored_craft.hpp) to `sheet.objects`; its rings and other objects must be
// there. Harbours: HRBFAC with CATHAF 5 (marina) and 4 (fishing), SMCFAC with CATSCF 1, 2, 5 and 29
// (visitors' berths and moorings, clubs, boatyards), areas and points.  BERTHS count within these.
// PONTON counts everywhere.
void read_moorings(const S57Cell& cell, ChartSheet& sheet);

}  // namespace skerry::echo
