// SpokeStamp: the numbers that a spoke has when it is played.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/video/spoke.hpp"

namespace skerry::server {

// Numbers that grow as the recorded ones do, however often the playback jumps back: what lies
// before stays before.  A recorded gap of at most `kept_gap` stays one; any other jump, and the
// first number after begin_anew(), is one more than the last.
template <typename Number>
class GrowingNumber {
 public:
  void begin_anew() { recorded_.reset(); }
  // Requires least <= kept_gap; `least` of 0: the same number may come again.
  Number next(Number recorded, Number least, Number kept_gap) {
    // Unsigned: a step back is an enormous step ahead.
    const Number step = recorded_ ? static_cast<Number>(recorded - *recorded_) : Number{0};
    const bool follows = recorded_ && step >= least && step <= kept_gap;
    if (follows) {
      played_ = static_cast<Number>(played_ + step);
    } else if (begun_) {
      ++played_;
    }
    begun_ = true;
    recorded_ = recorded;
    return played_;
  }

 private:
  std::optional<Number> recorded_;  // the last one
  Number played_ = 0;               // the same, as played
  bool begun_ = false;
};

// Sequence and scan of one view.  A gap in the recorded sequence of less than a turn is kept: those
// spokes are missing, and a console shall know.
class SpokeStamp {
 public:
  // The playback has jumped: the next spoke begins another turn.
  void begin_anew() {
    sequence_.begin_anew();
    scan_.begin_anew();
  }
  void put_on(SpokeHeader& header) {
    header.sequence = sequence_.next(header.sequence, 1, header.geometry.spokes_per_turn);
    header.scan = scan_.next(header.scan, 0, kKeptTurns);
  }

 private:
  // So many turns without video, as in standby, keep their count.
  static constexpr std::uint32_t kKeptTurns = 100'000;
  GrowingNumber<std::uint64_t> sequence_;
  GrowingNumber<std::uint32_t> scan_;
};

}  // namespace skerry::server
