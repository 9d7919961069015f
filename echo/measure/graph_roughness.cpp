#include "echo/measure/graph_roughness.hpp"

#include <algorithm>

namespace skerry::echo {

std::vector<GraphVariation> second_variation(std::span<const double> heights, int longest_lag) {
  std::vector<GraphVariation> out;
  const auto longest = static_cast<std::size_t>(std::max(longest_lag, 0));
  for (std::size_t lag = 1; lag <= longest && 2 * lag < heights.size(); lag *= 2) {
    const std::size_t terms = heights.size() - 2 * lag;
    double sum = 0.0;
    for (std::size_t i = 0; i < terms; ++i) {
      const double bend =
          (heights[i + 2 * lag] - heights[i + lag]) - (heights[i + lag] - heights[i]);
      sum += bend * bend;
    }
    out.push_back({static_cast<int>(lag), sum / static_cast<double>(terms)});
  }
  return out;
}

}  // namespace skerry::echo
