// What ASTERIX reports of plots and tracks have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/quantity/time.hpp"

namespace skerry {

// Who sends: system area code and system identification code, assigned by the user.
struct AsterixSource {
  std::uint8_t sac = 0;
  std::uint8_t sic = 0;
  friend bool operator==(const AsterixSource&, const AsterixSource&) = default;
};

// The largest datagram that Ethernet carries whole (UDP over IPv4).
inline constexpr std::size_t kAsterixDatagram = 1472;

// What a report has for its time.
Duration asterix_time_of_day(UtcTime utc);

// Of the reports: what is absent is not sent.  What is not finite, or beyond what its item holds,
// is not sent either, unless its comment says that it is sent as the nearest that there is.  Of
// items with several values all must be good.  Angles may be of any turn.

// From the radar.
struct AsterixPolar {
  double range_m = 0.0;
  double bearing_deg = 0.0;  // true
  friend bool operator==(const AsterixPolar&, const AsterixPolar&) = default;
};

struct AsterixVelocity {
  double speed_mps = 0.0;
  double course_deg = 0.0;  // true
  friend bool operator==(const AsterixVelocity&, const AsterixVelocity&) = default;
};

// A velocity, an acceleration or two standard deviations.
struct AsterixVector {
  double east = 0.0;
  double north = 0.0;
  friend bool operator==(const AsterixVector&, const AsterixVector&) = default;
};

// A target's size.  Lengths in whole metres; what is beyond 127 is sent as 127.
struct AsterixSize {
  double length_m = 0.0;
  std::optional<double> orientation_deg = {};  // true, whither the bow points; to 360/128 deg
  std::optional<double> width_m = {};          // not sent without an orientation
  friend bool operator==(const AsterixSize&, const AsterixSize&) = default;
};

}  // namespace skerry
