// Which track is which target, from step to step.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Pairs at the least sum of distances, of which none is more than the cut.  A pair that was made
// before counts as nearer by `keep_m`, so that two ships that pass close do not seem to change
// tracks because their places err; but a track that really changes ships is found out.
class StickyPairing {
 public:
  // Errors: std::invalid_argument if cut_m is not more than 0, or keep_m negative or not below it.
  StickyPairing(double cut_m, double keep_m);

  struct Named {
    std::size_t name = 0;
    PlanePoint place;
  };
  // For each truth the index within `told`, or kUnpaired (assignment.hpp).
  std::vector<std::size_t> pair(std::span<const Named> truth, std::span<const Named> told);

 private:
  double cut_m_, keep_m_;
  std::map<std::size_t, std::size_t> held_;  // by name of the truth; the last that it had
};

}  // namespace skerry::server
