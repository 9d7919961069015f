// StreamClock: what time it is in the video.
#pragma once

#include <algorithm>
#include <chrono>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Gives the items of a recording their times: a spoke its own; what has none (a mark, a change of
// settings) that of the newest spoke, and what has passed since it was taken.  So all are of one
// clock, even where what is recorded is itself a recording of last year.
//
// Times never jump back by more than kSkew: where a playback is rewound, its spokes go on from the
// newest time there was, so that a recording of it has all that was shown in the order in which it
// was shown.  The spokes themselves keep the times they bear.
// Thread: one at a time.
class StreamClock {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  // Between radars of one server.
  static constexpr Duration kSkew = std::chrono::seconds(2);
  // Longer than a spoke waits for the end of its sector.
  static constexpr Duration kSectorTime = std::chrono::milliseconds(100);

  // `longest`: what may pass without a spoke (a playback may stand still).
  StreamClock(UtcTime begin, Steady now, Duration longest)
      : newest_(begin), taken_(now), longest_(longest) {}

  // The time of a spoke as an item.
  UtcTime saw(UtcTime spoke, Steady now) {
    UtcTime time = spoke + shift_;
    if (seen_ && time < newest_ - kSkew) {
      shift_ += newest_ - time;
      time = newest_;
    }
    newest_ = seen_ ? std::max(newest_, time) : time;
    seen_ = true;
    taken_ = now;
    return time;
  }
  // Before any spoke that is yet to come, of all radars.
  UtcTime before() const { return newest_ - kSectorTime; }
  UtcTime at(Steady now) const {
    return newest_ + std::clamp(Duration(now - taken_), Duration(0), longest_);
  }

 private:
  UtcTime newest_;
  Steady taken_;
  Duration longest_;
  Duration shift_{0};
  bool seen_ = false;
};

}  // namespace skerry::server
