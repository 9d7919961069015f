// CoastRules: what a scenario says of its coast.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/fractal/coast_style.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A stretch of coast of which the scenario says more than the chart: edges whose middle lies within
// `radius_m` of `centre`.
struct CoastPlace {
  GeoPoint centre;
  double radius_m = 0.0;
  std::optional<CoastType> type;
  std::optional<CoastStyle> style;
};

struct CoastRules {
  std::uint64_t seed = 0;  // makes another coast between the same chart vertices
  // Indexed by CoastType: unknown, artificial, rocky, sandy.
  std::array<CoastStyle, kCoastTypes> styles = {
      CoastStyle{}, CoastStyle{.method = CoastMethod::straight, .dimension = 1.0}, CoastStyle{},
      CoastStyle{.dimension = 1.05}};
  bool guess_types = true;              // of unknown coast, from its own measured dimension
  std::vector<CoastPlace> places = {};  // a later one wins over an earlier
};

}  // namespace skerry::echo
