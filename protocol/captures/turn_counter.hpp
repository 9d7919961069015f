// TurnCounter: turns of an antenna, counted by where its spokes point.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "protocol/quantity/time.hpp"

namespace skerry::captures {

// A spoke that points a little back (packets in another order, a ship that turns) does not begin a
// turn.  After a pause, the turns of the time that passed are counted, if `turn` is known.
class TurnCounter {
 public:
  // The turn of a spoke that points to `index` of `spokes` (1 ..); 0 is the first.
  std::uint32_t take(std::uint32_t index, std::uint32_t spokes, UtcTime time, Duration turn) {
    if (spokes != spokes_) {
      position_ = spokes_ == 0 ? index : (position_ / spokes_ + 1) * spokes + index;
      spokes_ = spokes;
    } else {
      const std::int64_t steps =
          (index + spokes - static_cast<std::uint32_t>(position_ % spokes)) % spokes;
      position_ =
          std::max<std::int64_t>(position_ + steps + whole_turns(steps, time, turn) * spokes, 0);
    }
    time_ = time;
    return static_cast<std::uint32_t>(position_ / spokes);
  }

 private:
  // To be added to `steps` forwards; -1 where the spoke points back.
  std::int64_t whole_turns(std::int64_t steps, UtcTime time, Duration turn) const {
    constexpr double kMost = 1e6;
    const double forward = static_cast<double>(steps) / spokes_;
    const double passed = turn > Duration{}
                              ? std::clamp(in_seconds(time - time_) / in_seconds(turn), 0.0, kMost)
                              : (forward > 0.9 ? 0.0 : forward);
    return static_cast<std::int64_t>(std::floor(passed - forward + 0.5));
  }

  std::int64_t position_ = 0;  // spokes since index 0 of the first turn
  std::uint32_t spokes_ = 0;
  UtcTime time_{};
};

}  // namespace skerry::captures
