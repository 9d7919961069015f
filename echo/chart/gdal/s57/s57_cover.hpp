// What covers the land of an S-57 cell.
#pragma once

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"

namespace skerry::echo {

// Fills `sheet.covers` from areas of BUAARE (built-up), PRDARE (industrial), VEGATN by CATVEG,
// LNDRGN by CATLND, SLOGRD by CATSLO (dunes, scree), ICEARE, AIRARE (grass) and RUNWAY (paved).
// Points and lines of these have no extent and say nothing here.
void read_cover(const S57Cell& cell, ChartSheet& sheet);

}  // namespace skerry::echo
