// Rain of one area along a bearing.
#pragma once

#include <optional>
#include <span>

#include "echo/kernel/exact_math.hpp"
#include "echo/rain/rain_map.hpp"
#include "echo/scene/weather.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// The way of a ray over a map: a straight line in columns and rows, too.
struct RainChord {
  const RainMap* map = nullptr;
  double rate_mm_h = 0.0;
  double column = 0.0, row = 0.0;                // at range 0
  double columns_per_m = 0.0, rows_per_m = 0.0;  // along the ray
  double from_m = 0.0, to_m = 0.0;               // over the map
};

// Nothing where the ray misses the map or ends before it.  off: from the antenna to the area's
// centre; ray: a direction in the plane; reach_m: how far it goes.  The map's axis follows the
// area's drift, or its identity where it does not drift.
std::optional<RainChord> find_rain_chord(const RainCell& cell, const RainMap& map, PlanePoint off,
                                         SinCos ray, double reach_m);

// rates[j] += the mean rate in the beam at first_m + j * step_m: a ray through the two levels of
// the map whose values are next to 0.6 beams apart, each by its nearness.  Read between values,
// that is the standard deviation of a Gaussian beam's two-way pattern, 0.3 of its width, along the
// ray as across it.  Error: rms 0.02 of the greatest rate, held by
// RainProfile.IsTheMeanOverTheBeam; and it is the rate that is averaged, not its 1.6th power, which
// echoes.  beam_width: radians, one way, -3 dB.
void add_rain(const RainChord& chord, double beam_width, double first_m, double step_m,
              std::span<float> rates);

}  // namespace skerry::echo
