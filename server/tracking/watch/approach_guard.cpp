#include "server/tracking/watch/approach_guard.hpp"

namespace skerry::server {

bool is_dangerous(const PlottedApproach& approach, const ApproachLimits& limits) {
  return limits.cpa_m > 0.0 && approach.moves && approach.range_m <= limits.cpa_m &&
         approach.time_s >= 0.0 && approach.time_s <= limits.tcpa_s;
}

void ApproachGuard::update(const std::optional<PlottedApproach>& approach,
                           const ApproachLimits& limits, UtcTime now) {
  if (limits.cpa_m <= 0.0) return clear();
  if (!approach) return;
  if (is_dangerous(*approach, limits)) {
    on_ = true;
    clear_since_.reset();
    return;
  }
  const bool is_clear =
      !approach->moves || approach->range_m > kClearFactor * limits.cpa_m + kClearBy_m ||
      approach->time_s < -kPast_s || approach->time_s > limits.tcpa_s + kClearLater_s;
  if (!on_ || !is_clear) {
    clear_since_.reset();
  } else if (!clear_since_) {
    clear_since_ = now;
  } else if (now - *clear_since_ >= kStaysClear) {
    clear();
  }
}

}  // namespace skerry::server
