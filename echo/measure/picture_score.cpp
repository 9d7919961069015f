#include "echo/measure/picture_score.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace skerry::echo {

namespace {

struct PairSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  void add(double a, double b) { n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b; }
  double correlation() const {
    const double spread = (xx - x * x / n) * (yy - y * y / n);
    if (!(n > 1.0 && spread > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return (xy - x * y / n) / std::sqrt(spread);
  }
};

}  // namespace

PictureCorrelation mean_picture_correlation(std::span<const PictureTurn> turns,
                                            const PictureWindow& window, double least) {
  if (turns.empty()) throw std::invalid_argument("picture: no turns, expected at least one");
  const PictureTurn& first = turns.front();
  for (const PictureTurn& turn : turns) {
    require_valid(turn, window);
    if (turn.spokes != first.spokes || turn.cells != first.cells)
      throw std::invalid_argument("picture: turns of different sizes");
  }
  const WindowCells in = cells_of(first, window);
  const std::size_t width = in.last - in.first;
  std::vector<float> mean(in.spokes.size() * width);
  for (std::size_t s = 0; s < in.spokes.size(); ++s) {
    for (std::uint32_t c = 0; c < width; ++c) {
      float sum = 0.0f;
      for (const PictureTurn& turn : turns) sum += turn.at(in.spokes[s], in.first + c);
      mean[s * width + c] = sum / static_cast<float>(turns.size());
    }
  }
  const auto over = [&](std::size_t spokes, std::size_t cells) {
    PairSums sums;
    for (std::size_t s = 0; s + spokes < in.spokes.size(); ++s) {
      for (std::size_t c = 0; c + cells < width; ++c) {
        const float a = mean[s * width + c], b = mean[(s + spokes) * width + c + cells];
        if (a >= static_cast<float>(least) && b >= static_cast<float>(least)) sums.add(a, b);
      }
    }
    return sums.correlation();
  };
  PictureCorrelation result;
  for (std::size_t i = 0; i < kCorrelationLags.size(); ++i) {
    result.spoke[i] = over(kCorrelationLags[i], 0);
    result.range[i] = over(0, kCorrelationLags[i]);
  }
  return result;
}

PictureCorrelation picture_correlation(const PictureTurn& turn, const PictureWindow& window) {
  return mean_picture_correlation({&turn, 1}, window, 1.0);
}

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
