// ApproachGuard: whether a target comes too close too soon.
#pragma once

#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

struct ApproachLimits {
  double cpa_m = 0.0, tcpa_s = 0.0;  // cpa_m 0: nothing is dangerous
};

// CPA within its limit, and TCPA from now to its own limit.
bool is_dangerous(const PlottedApproach& approach, const ApproachLimits& limits);

// Of one target.  It is dangerous at once, and no longer only once it has stayed clear for a while:
// CPA and TCPA have the errors of video and compass, and an alarm that comes and goes is
// acknowledged unread.  Held by ApproachGuard.NoiseDoesNotMakeItComeAndGo.
class ApproachGuard {
 public:
  // It is clear beyond these, or past by more than kPast_s.
  static constexpr double kClearFactor = 1.1, kClearBy_m = 100.0;  // of the CPA limit
  static constexpr double kClearLater_s = 60.0, kPast_s = 6.0;     // of TCPA
  static constexpr Duration kStaysClear = std::chrono::seconds(10);

  // `approach` absent: its motion is not known, and nothing changes.  `now` does not go back.
  void update(const std::optional<PlottedApproach>& approach, const ApproachLimits& limits,
              UtcTime now);
  bool is_on() const { return on_; }
  void clear() { *this = {}; }

 private:
  bool on_ = false;
  std::optional<UtcTime> clear_since_;
};

}  // namespace skerry::server
