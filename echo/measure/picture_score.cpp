#include "echo/measure/picture_score.hpp"

namespace skerry::echo {

PictureScore picture_score(const PictureTurn& turn, const PictureWindow& window, double range_m) {
  PictureScore score;
  const OutlineDimensions outline = outline_dimensions(turn, window, range_m);
  score.below_beam = outline.at_beam.below;
  score.above_beam = outline.at_beam.above;
  score.below_recorded = outline.recorded.below;
  score.above_recorded = outline.recorded.above;
  const EdgeStatistics edge = edge_statistics(turn, window);
  score.thickness_m = edge.thickness_m;
  score.within_a_cell = edge.within_a_cell;
  score.change_p99_m = edge.change_p99_m;
  const PictureCorrelation correlation = picture_correlation(turn, window);
  score.spoke_correlation = correlation.spoke;
  score.range_correlation = correlation.range;
  return score;
}

}  // namespace skerry::echo
