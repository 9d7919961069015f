// PictureShore: what a stretch of refined coast is, as the echo needs it.
#pragma once

#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

struct PictureShore {
  CoastType type = CoastType::unknown;
  bool seam = false;      // land ends here without a coast (EdgeKind::seam)
  float height_m = 0.0f;  // of the face over high water; 0: as the type has it
  friend bool operator==(const PictureShore&, const PictureShore&) = default;
};

}  // namespace skerry::echo
