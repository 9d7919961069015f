#include "echo/picture_tool/picture_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/measure/picture_edge.hpp"
#include "echo/measure/picture_outline.hpp"
#include "echo/measure/picture_score.hpp"
#include "echo/measure/picture_turns.hpp"

namespace skerry::echo {
namespace {

// Of those that are numbers.
class Mean {
 public:
  void add(double value) {
    if (std::isfinite(value)) sum_ += value, count_ += 1.0;
  }
  double value() const {
    return count_ > 0.0 ? sum_ / count_ : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0.0, count_ = 0.0;
};

double share_that_echoes(const PictureTurn& turn, const PictureWindow& window) {
  const auto from = static_cast<std::uint32_t>(
      std::min<double>(turn.cells, std::ceil(window.from_m / turn.cell_m)));
  double on = 0.0;
  for (std::uint32_t s = 0; s < turn.spokes; ++s) {
    for (std::uint32_t c = from; c < turn.cells; ++c) on += turn.at(s, c) > 0 ? 1.0 : 0.0;
  }
  return from < turn.cells ? on / (static_cast<double>(turn.spokes) * (turn.cells - from)) : 0.0;
}

}  // namespace

PictureStatistics picture_statistics(std::span<const PictureTurn> turns) {
  const PictureWindow window{.from_m = kPictureFrom_m};
  Mean below, above, p10, p50, p90, spoke1, spoke4, range1, range4, occupancy;
  for (const PictureTurn& turn : turns) {
    const OutlineDimensions outline = outline_dimensions(turn, window, turn.cells * turn.cell_m);
    below.add(outline.at_beam.below), above.add(outline.at_beam.above);
    const EdgeStatistics edge = edge_statistics(turn, window);
    p10.add(edge.thickness_m[0]), p50.add(edge.thickness_m[2]), p90.add(edge.thickness_m[4]);
    const PictureCorrelation correlation = picture_correlation(turn, window);
    spoke1.add(correlation.spoke[0]), spoke4.add(correlation.spoke[2]);
    range1.add(correlation.range[0]), range4.add(correlation.range[2]);
    occupancy.add(share_that_echoes(turn, window));
  }
  return {below.value(),
          above.value(),
          p10.value(),
          p50.value(),
          p90.value(),
          spoke1.value(),
          spoke4.value(),
          range1.value(),
          range4.value(),
          turn_correlation(turns, window, 1),
          bow_seam(turns, window),
          occupancy.value()};
}

}  // namespace skerry::echo
