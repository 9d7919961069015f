// ElevationGrid: heights of the ground, from a raster.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Heights over the sea by latitude and longitude, metres, in rows from the south.  Between posts
// bilinear.  NaN posts are no data.
struct ElevationGrid {
  double south_deg = 0.0, west_deg = 0.0;  // of the first post
  double step_lat_deg = 1.0, step_lon_deg = 1.0;
  std::int32_t rows = 0, columns = 0;
  std::vector<float> heights_m;  // rows * columns
  std::string source;

  // NaN outside the raster and beside posts without data.
  float at(GeoPoint place) const {
    const double x = wrapped_longitude(place.longitude_deg - west_deg - 179.0) + 179.0;
    const double u = x / step_lon_deg, v = (place.latitude_deg - south_deg) / step_lat_deg;
    if (!(u >= 0.0 && v >= 0.0 && u <= columns - 1 && v <= rows - 1)) return std::nanf("");
    const auto c = std::min(static_cast<std::int32_t>(u), columns > 1 ? columns - 2 : 0);
    const auto r = std::min(static_cast<std::int32_t>(v), rows > 1 ? rows - 2 : 0);
    const auto post = [&](std::int32_t row, std::int32_t column) {
      row = std::min(row, rows - 1);
      column = std::min(column, columns - 1);
      return heights_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    };
    const auto fu = static_cast<float>(u - c), fv = static_cast<float>(v - r);
    const float low = post(r, c) + (post(r, c + 1) - post(r, c)) * fu;
    const float high = post(r + 1, c) + (post(r + 1, c + 1) - post(r + 1, c)) * fu;
    return low + (high - low) * fv;
  }
};

}  // namespace skerry::echo
