// Spoke <-> wire::Spoke, the spoke of the native protocol (radar.proto, SPEC.md).
#pragma once

#include "protocol/quantity/result.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

// Limits of the last cell's end, and so of an instrumented range, in range scales.
inline constexpr double kShortestReach = 1.0 / 16.0, kLongestReach = 2.0;

// Writes every field of `message`, whose memory is used again: a message kept from spoke to spoke
// costs no allocation.  Requires a valid geometry and geometry.cells cells; of a 4-bit cell only
// the low nibble counts. Thread: any.
void to_message(const Spoke& spoke, wire::Spoke& message);

// Checks every field.  What comes back has a valid geometry, index < spokes_per_turn, exactly
// geometry.cells cells (0..15 with 4 bits), Doppler classes of all of them or of none, a known
// range scale, an instrumented range from a sixteenth of that to twice it (to the rounding of a
// double; none where the cell size is the range scale's), and a finite position on the Earth.
// Longitude 180 becomes -180. Error: out_of_range for a value, truncated or oversized for cells or
// classes of the wrong length, malformed for a class that is none and for the unused rest of a last
// byte that is not zero.  The text names the field; offset is 0, except in cells, where it is the
// byte within them. Thread: any.
Result<Spoke, WireError> from_message(const wire::Spoke& message);

}  // namespace skerry
