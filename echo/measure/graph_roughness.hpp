// How rough a graph is: heights at equal steps, as of fractional Brownian motion.
#pragma once

#include <span>
#include <vector>

namespace skerry::echo {

struct GraphVariation {
  int lag = 0;  // steps
  double mean = 0.0;
};

// Mean square of second differences h(t) - 2 h(t + lag) + h(t + 2 lag), at lags 1, 2, 4 ...
// longest_lag; lags that do not fit into the graph are left out.  For fractional Brownian motion it
// goes as lag^(2 H), as the variogram does, but is blind to a slope of the whole graph, so it may
// be taken of graphs whose ends were pinned.  Source: Istas and Lang (1997).
std::vector<GraphVariation> second_variation(std::span<const double> heights, int longest_lag);

}  // namespace skerry::echo
