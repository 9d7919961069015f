#include "server/plotter/tracks/pairing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/plotter/assignment/assignment.hpp"

namespace skerry::server {
namespace {

constexpr double kLn2 = 0.6931471805599453, kTurn = 6.283185307179586;

double ln(double x) { return kLn2 * echo::exact_log2(x); }

}  // namespace

std::vector<std::size_t> pair_up(std::span<const Target* const> targets,
                                 std::span<const PlacedPlot* const> plots, const PairRule& rule) {
  std::vector<double> costs(targets.size() * plots.size(), kNoPair);
  double least = 0.0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    for (std::size_t p = 0; p < plots.size(); ++p) {
      const Innovation off = targets[t]->off(*plots[p]);
      if (!(off.distance2 <= Target::kGate)) continue;
      const double cost = off.distance2 + ln(off.covariance.determinant());
      costs[t * plots.size() + p] = cost;
      least = std::min(least, cost);
    }
  }
  for (double& cost : costs) cost -= least;
  const double alone =
      2.0 * ln(Target::kSeen / ((1.0 - Target::kSeen) * rule.false_per_m2 * kTurn)) - least;
  return cheapest_pairs(costs, targets.size(), plots.size(), std::max(alone, 0.0));
}

}  // namespace skerry::server
