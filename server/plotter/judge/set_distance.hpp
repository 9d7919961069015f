// How far a tracker's list of targets is from the truth, as one number in metres.
#pragma once

#include <span>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Both pair the nearest of the two sets at the least cost.  `cut_m` > 0: no pair is farther apart
// than that, and a target missed or made up costs as much (OSPA), or half as much to the power of p
// (GOSPA).  `p` >= 1.  Two empty sets: 0.  Errors: std::invalid_argument.

// The mean of errors and of the lack of targets (Schuhmacher, Vo and Vo 2008, "A Consistent Metric
// for Performance Evaluation of Multi-Object Filters", eq. 3): at most cut_m.
double ospa_m(std::span<const PlanePoint> truth, std::span<const PlanePoint> told, double cut_m,
              double p);

// The sum of errors, misses and false targets, with alpha = 2 (Rahmathullah, Garcia-Fernandez and
// Svensson 2017, "Generalized optimal sub-pattern assignment metric", prop. 1).  What it is made of
// stands beside it.
struct Gospa {
  double m = 0.0;
  std::size_t paired = 0, missed = 0, made_up = 0;
};
Gospa gospa(std::span<const PlanePoint> truth, std::span<const PlanePoint> told, double cut_m,
            double p);

}  // namespace skerry::server
