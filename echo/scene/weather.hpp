// Air and sea as a radar meets them.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

struct Atmosphere {
  double k_factor = 4.0 / 3.0;  // effective Earth radius over the true one, 0.8 to 4
  // Share of the diffraction loss beyond the horizon that a duct takes away: 0 (none) to 1 (all).
  double ducting = 0.0;
  friend bool operator==(const Atmosphere&, const Atmosphere&) = default;
};

// One wave train, coming from one direction.  SeaReturns compares its members one by one to see a
// change.
struct Swell {
  double height_m = 0.0;   // crest to trough, 0 (none) to 15
  double period_s = 10.0;  // 4 to 25
  double from_deg = 0.0;   // clockwise from the plane's north
};

struct SeaSurface {
  double state = 0.0;          // Douglas sea state, 0 (no clutter at all) to 6, need not be whole
  double wind_from_deg = 0.0;  // clockwise from the plane's north
  Swell swell;
};

// The shape of a rain area (echo/rain/rain_form.hpp).
enum class RainKind : std::uint8_t {
  cell,         // one body of rain with a ragged edge
  even,         // a disc: uniform within half its radius, fading to nothing at the radius
  shower,       // scattered showers with dry air between them
  squall_line,  // a band across its way, sharp ahead, long behind
};

// An area of rain.  Nothing falls beyond the radius.
struct RainCell {
  PlanePoint centre;
  PlanePoint velocity;  // m/s
  double radius_m = 2000.0;
  double rate_mm_h = 4.0;      // mean over where it rains; of an even one, in the middle
  std::uint64_t identity = 0;  // seed of its field
  RainKind kind = RainKind::cell;
  PlanePoint facing = {};  // at rest, which way it would drift: of length 1, or 0 for any
};

}  // namespace skerry::echo
