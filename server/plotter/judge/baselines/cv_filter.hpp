// Kalman filter of a place on the plane that moves on straight.
#pragma once

#include <array>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// m, m/s; order of the matrix: east, north, velocity east, velocity north.
struct CvState {
  PlanePoint place, velocity_mps;
  std::array<std::array<double, 4>, 4> p{};
};

// Of both axes of a measured place, m2.
struct PlaceVariance {
  double east = 0.0, across = 0.0, north = 0.0;
};

CvState cv_begun(PlanePoint place, double place_variance, double velocity_variance);
// White acceleration of `variance`, (m/s2)2, over dt_s: standard textbook (Bar-Shalom, Li and
// Kirubarajan 2001, 6.3.2).
void cv_predict(CvState& state, double dt_s, double variance);
// `innovation`: the measured place less the state's.  Returns its likelihood, 1/m2.
double cv_update(CvState& state, PlanePoint innovation, const PlaceVariance& r);

}  // namespace skerry::server
