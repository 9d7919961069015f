// Boxes of latitude and longitude.
#pragma once

#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

using Line = std::vector<GeoPoint>;

inline Line box(double south, double west, double north, double east) {
  return {{south, west}, {south, east}, {north, east}, {north, west}};
}

}  // namespace skerry::echo
