#include "echo/receiver/log_video.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

double threshold_db(double gain) { return 22.9 - 0.258 * gain; }

double stc_db(double sea, double range_m) {
  const double limit = nautical_miles(8.0).in_metres() * sea / 100.0;
  if (range_m >= limit) return 0.0;
  const double ratio = limit / std::max(range_m, 1e-3);
  return std::min(kMaxStcDb, 3.0 * decibels_from_ratio(ratio));
}

}  // namespace skerry::echo
