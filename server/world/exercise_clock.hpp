// ExerciseClock: the time of the exercise, which an instructor stops and hastens.
#pragma once

#include <cmath>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Goes by rate * tick with every tick on the air; rates are whole tenths, so that it stays exact.
struct ExerciseClock {
  static constexpr double kMinRate = 0.1, kMaxRate = 20.0;

  Duration now{};
  bool frozen = false;
  std::int64_t rate_tenths = 10;

  double rate() const { return static_cast<double>(rate_tenths) / 10.0; }
  double pace() const { return frozen ? 0.0 : rate(); }
  // Requires kMinRate..kMaxRate.
  void set_rate(double rate) { rate_tenths = std::llround(10.0 * rate); }
  void advance(Duration tick) {
    if (!frozen) now += tick / 10 * rate_tenths;
  }
  // Of a moment `into` a tick on the air.
  Duration at(Duration into) const { return frozen ? now : now + into * rate_tenths / 10; }
};

}  // namespace skerry::server
