// The shore of a chart as consoles and instructors draw it.
#pragma once

#include <cstddef>

#include "echo/chart/coast_chart.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Land and the water within it, cut at the square about the circle that was asked for.  Points
// nearer than `detail_m` to the one before are left out: a 4000th of the diameter, and twice, four
// times ... that until there are at most `most_points`.  Places are right to that and 0.1 m.
wire::Coastline coastline_of(const echo::CoastChart& chart, const wire::GetCoastline& place,
                             std::size_t most_points = 120'000);

}  // namespace skerry::server
