#include "echo/picture_tool/picture_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "echo/measure/picture_edge.hpp"
#include "echo/measure/picture_outline.hpp"
#include "echo/measure/picture_score.hpp"
#include "echo/measure/picture_turns.hpp"

namespace skerry::echo {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

using Of = PictureStatistics;
constexpr std::array kStatisticRows = {
    StatisticRow{"outline_below", "outline D below the beam", &Of::outline_below, 2, 0.03},
    StatisticRow{"outline_above", "outline D above the beam", &Of::outline_above, 2, 0.05},
    StatisticRow{"ribbon_p10_m", "ribbon p10, m", &Of::ribbon_p10_m, 0, 5.0},
    StatisticRow{"ribbon_p50_m", "ribbon p50, m", &Of::ribbon_p50_m, 0, 10.0},
    StatisticRow{"ribbon_p90_m", "ribbon p90, m", &Of::ribbon_p90_m, 0, 25.0},
    StatisticRow{"spoke_lag1", "spoke lag 1", &Of::spoke_lag1, 3, 0.01},
    StatisticRow{"spoke_lag4", "spoke lag 4", &Of::spoke_lag4, 3, 0.03},
    StatisticRow{"range_lag1", "range lag 1", &Of::range_lag1, 3, 0.02},
    StatisticRow{"range_lag4", "range lag 4", &Of::range_lag4, 3, 0.03},
    StatisticRow{"turn_lag1", "turn lag 1", &Of::turn_lag1, 2, 0.03},
    StatisticRow{"bow_seam", "bow seam", &Of::bow_seam, 2, 0.3},
    StatisticRow{"occupancy", "occupancy", &Of::occupancy, 3, 0.01},
};

// Over stretches of turns that follow each other, by their number of pairs.
template <typename Measure>
double over_runs(std::span<const PictureTurn> turns, const std::vector<bool>& follow,
                 const Measure& measure) {
  double sum = 0.0, pairs = 0.0;
  for (std::size_t from = 0, to; from < turns.size(); from = to) {
    to = from + 1;
    while (to < turns.size() && (follow.empty() || follow[to])) ++to;
    const auto n = static_cast<double>(to - from - 1);
    const double value = to - from > 1 ? measure(turns.subspan(from, to - from)) : kNoValue;
    if (std::isfinite(value)) sum += n * value, pairs += n;
  }
  return pairs > 0.0 ? sum / pairs : kNoValue;
}

}  // namespace

std::span<const StatisticRow> statistic_rows() { return kStatisticRows; }

double share_that_echoes(std::span<const PictureTurn> turns) {
  double on = 0.0, all = 0.0;
  for (const PictureTurn& turn : turns) {
    const auto from = static_cast<std::uint32_t>(
        std::min<double>(turn.cells, std::ceil(kPictureFrom_m / turn.cell_m)));
    for (std::uint32_t s = 0; s < turn.spokes; ++s) {
      for (std::uint32_t c = from; c < turn.cells; ++c) on += turn.at(s, c) > 0 ? 1.0 : 0.0;
    }
    all += static_cast<double>(turn.spokes) * (turn.cells - from);
  }
  return all > 0.0 ? on / all : 0.0;
}

PictureStatistics turn_statistics(const PictureTurn& turn) {
  const PictureWindow window{.from_m = kPictureFrom_m};
  const OutlineDimensions outline = outline_dimensions(turn, window, turn.cells * turn.cell_m);
  const EdgeStatistics edge = edge_statistics(turn, window);
  const PictureCorrelation correlation = picture_correlation(turn, window);
  return {outline.at_beam.below,
          outline.at_beam.above,
          edge.thickness_m[0],
          edge.thickness_m[2],
          edge.thickness_m[4],
          correlation.spoke[0],
          correlation.spoke[2],
          correlation.range[0],
          correlation.range[2],
          kNoValue,
          kNoValue,
          share_that_echoes({&turn, 1})};
}

PictureStatistics mean_of(std::span<const PictureStatistics> all) {
  PictureStatistics mean;
  for (const StatisticRow& row : kStatisticRows) {
    double sum = 0.0, n = 0.0;
    for (const PictureStatistics& each : all) {
      if (std::isfinite(each.*row.of)) sum += each.*row.of, n += 1.0;
    }
    mean.*row.of = n > 0.0 ? sum / n : kNoValue;
  }
  return mean;
}

PictureStatistics deviation_of(std::span<const PictureStatistics> all) {
  const PictureStatistics mean = mean_of(all);
  PictureStatistics deviation;
  for (const StatisticRow& row : kStatisticRows) {
    double sum = 0.0, n = 0.0;
    for (const PictureStatistics& each : all) {
      const double off = each.*row.of - mean.*row.of;
      if (std::isfinite(off)) sum += off * off, n += 1.0;
    }
    deviation.*row.of = n > 1.0 ? std::sqrt(sum / (n - 1.0)) : kNoValue;
  }
  return deviation;
}

PictureStatistics picture_statistics(std::span<const PictureTurn> turns,
                                     const std::vector<bool>& follow) {
  const PictureWindow window{.from_m = kPictureFrom_m};
  std::vector<PictureStatistics> each;
  for (const PictureTurn& turn : turns) each.push_back(turn_statistics(turn));
  PictureStatistics all = mean_of(each);
  all.turn_lag1 =
      over_runs(turns, follow, [&](auto run) { return turn_correlation(run, window, 1); });
  all.bow_seam = over_runs(turns, follow, [&](auto run) { return bow_seam(run, window); });
  return all;
}

}  // namespace skerry::echo
