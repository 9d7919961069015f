// PictureStatistics: the figures by which pictures of one radar are compared with another's.
#pragma once

#include <span>
#include <vector>

#include "echo/measure/picture_patches.hpp"
#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// Means over turns; NaN where the picture has none of it.
struct PictureStatistics {
  double outline_below = 0.0, outline_above = 0.0;  // D of the outline, split at the beam
  double ribbon_p10_m = 0.0, ribbon_p50_m = 0.0, ribbon_p90_m = 0.0;  // first echo's depth
  double spoke_lag1 = 0.0, spoke_lag4 = 0.0;
  double range_lag1 = 0.0, range_lag4 = 0.0;
  double turn_lag1 = 0.0;
  double bow_seam = 0.0;
  double occupancy = 0.0;  // share of cells that echo
};

// Nearer than this a picture shows the radar itself.
inline constexpr double kPictureFrom_m = 100.0;

// `turns` of one size follow each other.  Error: std::invalid_argument as require_valid().
PictureStatistics picture_statistics(std::span<const PictureTurn> turns);

}  // namespace skerry::echo
