// The display that Ji et al. 2016 draw their coasts on.
#pragma once

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo::as_printed {

// A place on the display, pixels: x to the right, y down.
struct PixelPoint {
  double x_px = 0.0;
  double y_px = 0.0;
  friend constexpr bool operator==(PixelPoint, PixelPoint) = default;
};

// A round picture, north up, of the coast within `range_m` of `centre`.  The paper's c and L count
// pixels: on the ground they are another length at every range (SOURCES.md "Corrections 11").
struct Display {
  PlanePoint centre;
  double range_m = 1.0;  // > 0
  double diameter_px = 1000.0;

  constexpr double metres_per_pixel() const { return 2.0 * range_m / diameter_px; }
  constexpr PixelPoint to_pixel(PlanePoint p) const {
    return {0.5 * diameter_px + (p.east_m - centre.east_m) / metres_per_pixel(),
            0.5 * diameter_px - (p.north_m - centre.north_m) / metres_per_pixel()};
  }
  constexpr PlanePoint to_plane(PixelPoint p) const {
    return {centre.east_m + (p.x_px - 0.5 * diameter_px) * metres_per_pixel(),
            centre.north_m + (0.5 * diameter_px - p.y_px) * metres_per_pixel()};
  }
};

}  // namespace skerry::echo::as_printed
