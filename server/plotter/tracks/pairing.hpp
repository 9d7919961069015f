// Which plot is which target's: at the least cost, over all that compete for the same ones.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "server/plotter/tracks/target.hpp"

namespace skerry::server {

struct PairRule {
  double false_per_m2 = 1e-7;
};

// Global nearest neighbour: the cost of a pair is twice the negative log-likelihood of the plot at
// the target, and a target without one costs what a miss does; so each target takes the plot, or
// none, with which all together are most likely (Blackman and Popoli 1999, "Design and Analysis of
// Modern Tracking Systems", section 6.4).  All targets have gone on to their looks.  Returns, for
// each target, the index of its plot or kUnpaired.
std::vector<std::size_t> pair_up(std::span<const Target* const> targets,
                                 std::span<const PlacedPlot* const> plots, const PairRule& rule);

}  // namespace skerry::server
