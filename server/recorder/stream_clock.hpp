// StreamClock: what time it is in the video.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Gives the items of a recording their times: a spoke its own; what has none (a mark, a change of
// settings) that of the newest spoke, and what has passed since it was taken.  So all are of one
// clock, even where what is recorded is itself a recording of last year.
//
// Where the system's clock was set, so that UTC of a radar's spokes steps against its antenna's
// clock, times go on as if it had not been: a recording has neither a hole nor an hour twice.
// Spokes keep the times they bear, and stepped() tells.  Where what is recorded is played back,
// such steps are the recording's own and no matter.
//
// Times never jump back by more than kSkew: where a playback is rewound, its spokes go on from the
// newest time there was, so that a recording of it has all that was shown in the order in which it
// was shown.  The spokes themselves keep the times they bear.
// Thread: one at a time.
class StreamClock {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  using Stream = std::pair<std::uint32_t, std::uint32_t>;  // radar, view
  // Between radars of one server.
  static constexpr Duration kSkew = std::chrono::seconds(2);
  // Longer than a spoke waits for the end of its sector.
  static constexpr Duration kSectorTime = std::chrono::milliseconds(100);
  // A step: of UTC against the antenna's clock, between two spokes of a stream; less is followed.
  static constexpr Duration kStep = std::chrono::milliseconds(10);

  // `longest`: what may pass without a spoke (a playback may stand still).
  // `zero`: UTC of scenario time 0, where it is known before any spoke.
  StreamClock(UtcTime begin, Steady now, Duration longest, std::optional<UtcTime> zero = {})
      : newest_(begin), taken_(now), longest_(longest) {
    if (zero) latest_ = Known{*zero, Duration{0}, Duration{0}};
  }

  // The time of a spoke as an item.
  UtcTime saw(Stream stream, UtcTime spoke, ScenarioTime scenario, Steady now) {
    if (longest_ != Duration::max()) return saw(spoke, now);
    const UtcTime zero = spoke - scenario.time_since_epoch();
    if (!latest_) latest_ = Known{zero, Duration{0}, Duration{0}};
    const bool is_behind = before_step_ && std::chrono::abs(zero - before_step_->zero) < kStep;
    Known& known = streams_.try_emplace(stream, is_behind ? *before_step_ : *latest_).first->second;
    // A real radar's, whose time counts by the system's clock, has none if that was set back.
    if (scenario != ScenarioTime{}) look_for_step(known, zero);
    const UtcTime time = place(spoke - known.stepped_by, known.shift, now);
    latest_ = known;
    return time;
  }
  // Of a stream without an antenna's clock.
  UtcTime saw(UtcTime spoke, Steady now) { return place(spoke, shift_, now); }
  // A step that the last spokes showed, once for all streams.
  std::optional<Duration> stepped() { return std::exchange(step_, std::nullopt); }

  // Before any spoke that is yet to come, of all radars.
  UtcTime before() const { return newest_ - kSectorTime; }
  UtcTime at(Steady now) const {
    return newest_ + std::clamp(Duration(now - taken_), Duration(0), longest_);
  }

 private:
  // Each stream its own: a set clock does not reach all at the same moment.
  struct Known {
    UtcTime zero;  // UTC of scenario time 0, by the last spoke
    Duration stepped_by, shift;
  };
  void look_for_step(Known& known, UtcTime zero) {
    const Known before = std::exchange(known, Known{zero, known.stepped_by, known.shift});
    const Duration by = zero - before.zero;
    const bool is_told = std::chrono::abs(zero - told_) < kStep;
    if (std::chrono::abs(by) >= kStep) {
      known.stepped_by += by;
      before_step_ = before;
      if (!is_told) step_ = by;
      told_ = zero;
    } else if (is_told) {
      told_ = zero;
    }
  }
  UtcTime place(UtcTime spoke, Duration& shift, Steady now) {
    UtcTime time = spoke + shift;
    if (seen_ && time < newest_ - kSkew) {
      shift += newest_ - time;
      time = newest_;
    }
    newest_ = seen_ ? std::max(newest_, time) : time;
    seen_ = true;
    taken_ = now;
    return time;
  }

  UtcTime newest_;
  Steady taken_;
  Duration longest_;
  Duration shift_{0};
  bool seen_ = false;
  std::map<Stream, Known> streams_;
  std::optional<Known> latest_;       // a new stream begins like it
  std::optional<Known> before_step_;  // or like this, if it has not seen the last step yet
  UtcTime told_{};                    // zero after the last step
  std::optional<Duration> step_;
};

}  // namespace skerry::server
