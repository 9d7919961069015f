// How rough a charted coast is.
#pragma once

#include <span>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Fractal dimension of a polyline by the divider: the slope of log(length by rulers) over
// log(ruler) between the two ruler lengths, metres, averaged over start points (Klinkenberg 1994).
// NaN where the line is shorter than 4 of the longest ruler.  Bias: +0.04 on a Koch curve of 1.262
// (physics.md B8).
double divider_dimension(std::span<const PlanePoint> line, double shortest_ruler_m,
                         double longest_ruler_m);

}  // namespace skerry::echo
