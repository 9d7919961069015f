// Which cells of a ray cannot show the sea.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/returns/coast_crossings.hpp"

namespace skerry::echo {

// Cells first .. last - 1.
struct CellRun {
  std::uint16_t first = 0, last = 0;
  friend bool operator==(const CellRun&, const CellRun&) = default;
};

// From `antenna_height_m`, the nearest range at which the sea comes out from under land that hides
// all below `slope` (land_ray.hpp): the nearer root of R^2 / 2 ae + slope R + antenna = 0; infinite
// where it never does.
double sea_seen_from(double slope, double antenna_height_m);

// The runs of cells that are land, or water behind it that its shadow hides, nearest first, apart.
// `slopes`: by cell, of the shadow before it.  A cell counts if its middle does.
void find_dry(std::span<const LandInterval> land, std::span<const float> slopes, double cell_m,
              double antenna_height_m, std::uint32_t cells, std::vector<CellRun>& dry);

}  // namespace skerry::echo
