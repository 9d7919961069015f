// Edges that lie on each other: which of them is a coast, which has land on both sides.
#pragma once

#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gdal/chart_sheet.hpp"

namespace skerry::echo {

struct EdgeRef {
  std::uint32_t ring = 0, edge = 0;
  EdgeName name;
  bool forward = false;  // from the lower identity to the higher
};

// Edges with the same ends bound together what their directions sum up to: two that run in opposite
// ways have land, or water, on both sides.  Of each such group as many edges as the sum says keep
// the kind they have, the others become EdgeKind::bin_border, so that what a ray counts over the
// edges it sees is what all rings together say.
void settle_shared_edges(std::vector<EdgeRef> edges, std::vector<CoastRing>& rings);

// All edges of `rings` that are no bin_border.
std::vector<EdgeRef> edges_of(const std::vector<CoastRing>& rings);

}  // namespace skerry::echo
