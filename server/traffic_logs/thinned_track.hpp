// Thinning of tracks in space and time: which fixes are needed to say where a ship was when.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// 16 bytes, because logs have many.  Degrees by 1e-7: 1.1 cm at most.
struct LogFix {
  std::int64_t utc_ms = 0;
  std::int32_t latitude_e7 = 0, longitude_e7 = 0;

  GeoPoint place() const { return {latitude_e7 * 1e-7, longitude_e7 * 1e-7}; }
};
LogFix log_fix(std::int64_t utc_ms, GeoPoint place);

// How far a ship that sails from one fix to another, as LoggedTrack does, is from a third at its
// time; metres.  Requires from.utc_ms < to.utc_ms.
double metres_off(const LogFix& from, const LogFix& to, const LogFix& fix);

struct Thinned {
  std::vector<std::size_t> kept;  // of the fixes, ascending; the first and the last are among them
  double worst_m = 0.0;           // of all fixes, against the kept ones
};

// Douglas and Peucker's way of leaving out points, with the distance between places at the same
// time instead of that to a line: no fix is off by more than the tolerance.
// Requires times that grow, two fixes or more.  Cost: fixes times the logarithm of kept ones, as a
// rule; their product at worst.
Thinned thin(std::span<const LogFix> fixes, double tolerance_m);

}  // namespace skerry::server
