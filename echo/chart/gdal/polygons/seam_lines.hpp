// Edges along the limits of charts laid over each other.
#pragma once

#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gdal/polygons/cut_lines.hpp"

namespace skerry::echo {

// Finds the edges that lie on `lines`, divides them at one another's ends, and settles by
// settle_shared_edges() which are seams and which are bin_borders.
void settle_seams(const CutLines& lines, std::vector<CoastRing>& rings);

}  // namespace skerry::echo
