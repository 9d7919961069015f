// Depth contours, joined end to end.
#pragma once

#include <vector>

#include "echo/chart/chart_detail.hpp"

namespace skerry::server {

// Charts have a contour in pieces.  Two of one depth become one where they share an end and no
// third of that depth does.  Those of fewer than two points are left out.  Time: n log n.
std::vector<echo::DepthContour> joined(const std::vector<echo::DepthContour>& pieces);

}  // namespace skerry::server
