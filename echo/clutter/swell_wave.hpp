// SwellWave: how a swell shows in the clutter.
#pragma once

#include "echo/scene/weather.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Deep water: omega^2 = g k (SOURCES.md "Sea"; 10 s: 156.1 m).  Faces turned towards the radar are
// brighter and, where the grazing angle is less than the swell's steepness, troughs lie in shadow.
// Both vary as one wave of the clutter's decibels along the line of sight, `height` octaves to
// either side, and leave the mean power as it is:
//   tilt    12 times the steepness (k H / 2), at most 2 octaves, in quadrature with the crests;
//   shadow  4 octaves in all times what of the steepness is over the grazing angle, with the
//   crests; both times |cos| of the angle between look and swell, so nothing shows across it.
// The form is the project's own (bounded, of the size that low-grazing pictures show), not
// measured.
class SwellWave {
 public:
  explicit SwellWave(const Swell& swell);

  bool any() const { return steepness_ > 0.0; }
  double length_m() const { return length_m_; }

  // In a look direction whose cosine to the swell's way of travel is `towards`.
  struct Modulation {
    double height = 0.0;    // octaves
    double mean = 0.0;      // octaves to be taken off so that the mean power stays
    double lead = 0.0;      // turns, before the crest
    double variance = 0.0;  // of the modulated power over its squared mean
  };
  Modulation modulation(double grazing_rad, double towards) const;

  // Turns of the swell's crests at `from`, and per metre in a direction.
  double phase_at(PlanePoint from, double seconds) const;
  double turns_per_metre(double towards) const { return towards / length_m_; }
  double towards(double east, double north) const { return east * east_ + north * north_; }

 private:
  double steepness_ = 0.0, length_m_ = 1.0, period_s_ = 1.0;
  double east_ = 0.0, north_ = 0.0;  // whither it travels
};

}  // namespace skerry::echo
