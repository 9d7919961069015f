// AntennaPattern: the horizontal pattern all round, main lobe and side lobes.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// Power against the axis, 1 on it.  The main lobe is that of the cosine taper (beam.hpp); side
// lobes stay at or below the set's near and far levels.  Immutable; any thread.
class AntennaPattern {
 public:
  explicit AntennaPattern(const RadarSet& set);

  // `off_units`: bearing off the axis, 2^32 = one turn, either sense.
  float one_way(std::uint32_t off_units) const;
  float two_way(std::uint32_t off_units) const;  // its square

  // Off the axis by more than this, two_way() stays below `level` (a ratio in (0, 1)).
  std::uint32_t reach_units(double level) const;
  // Width of the uniform beam that gathers as much of evenly spread clutter, radians: the integral
  // of two_way(), 0.75 beam widths (physics.md B1).
  double clutter_width() const;

 private:
  std::vector<float> one_way_;
};

}  // namespace skerry::echo
