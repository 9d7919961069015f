// PictureStatistics: the figures by which pictures of one radar are compared with another's.
#pragma once

#include <span>
#include <string_view>
#include <vector>

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

// How a statistic is told: its key in files, its name in tables, its digits there, and the least
// spread that differences are measured by: what two turns of one place differ by at most.
struct StatisticRow {
  std::string_view key, name;
  double PictureStatistics::*of;
  int digits;
  double least_spread;
};
std::span<const StatisticRow> statistic_rows();

// Nearer than this a picture shows the radar itself.
inline constexpr double kPictureFrom_m = 100.0;

// Of one turn: turn_lag1 and bow_seam are NaN.  Error: std::invalid_argument as require_valid().
PictureStatistics turn_statistics(const PictureTurn& turn);
// Mean of those that are numbers, each statistic by itself; NaN where none is.
PictureStatistics mean_of(std::span<const PictureStatistics> all);
// Standard deviation of one of them; NaN for fewer than two.
PictureStatistics deviation_of(std::span<const PictureStatistics> all);

// `turns` of one size follow each other where `follow` says so of each and the one before it;
// empty: all do.  Error: std::invalid_argument as require_valid().
PictureStatistics picture_statistics(std::span<const PictureTurn> turns,
                                     const std::vector<bool>& follow = {});

// Share of the cells from kPictureFrom_m on that echo, mean over turns.
double share_that_echoes(std::span<const PictureTurn> turns);

}  // namespace skerry::echo
