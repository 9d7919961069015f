// What consoles draw of a chart under their picture.
#pragma once

#include <cstddef>
#include <deque>

#include "echo/chart/chart_source.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Shorelines and contours, cut at the square about the circle that was asked for, and the marks
// within it.  The message has at most `most_bytes`, kMostChartLines lines and kMostChartMarks
// marks, which take at most kMarkShare of the bytes: the nearest.  Of lines the longest are told,
// coast before contours.  They are thinned by the tolerance asked for, or twice, four times ...
// that, up to kMostTolerance of the radius, until so many lines fit; then fewer are told.  Places
// are right to the tolerance and 0.1 m.  `most_bytes` is at least 1000.
inline constexpr std::size_t kMostChartBytes = 200'000;
inline constexpr int kMostChartLines = 4000, kMostChartMarks = 4000;  // clients bound their lists
inline constexpr double kMarkShare = 0.4;
inline constexpr double kMostTolerance = 0.01;
wire::ChartObjects chart_objects_of(const echo::CoastChart& coast, const echo::ChartDetail& detail,
                                    const wire::GetChartObjects& place,
                                    std::size_t most_bytes = kMostChartBytes);

// Answers, and keeps the last of them: consoles of one ship ask for the same place.
// Thread: one at a time, that which reads the chart.
class ChartObjectsMaker {
 public:
  static constexpr std::size_t kKept = 8;

  // Error: as ChartSource::load().
  const wire::ChartObjects& about(const echo::ChartSource& chart,
                                  const wire::GetChartObjects& place);

 private:
  struct Kept {
    wire::GetChartObjects place;
    wire::ChartObjects objects;
  };
  std::deque<Kept> kept_;  // the newest last
};

}  // namespace skerry::server
