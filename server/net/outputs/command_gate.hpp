// CommandGate: how many commands of displays are looked at.
#pragma once

#include <algorithm>
#include <chrono>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// kPerSecond in the long run, and kBurst at once: far more than the displays on one radar send, and
// so few that a flood costs the network thread next to nothing.
class CommandGate {
 public:
  static constexpr int kPerSecond = 200;
  static constexpr int kBurst = 40;

  // Whether one may pass at `now`, which never goes back.
  bool lets_pass(ScenarioTime now) {
    const Duration most = kBurst * kSpacing;
    credit_ = std::min(most, credit_ + (now - last_));
    last_ = now;
    if (credit_ < kSpacing) return false;
    credit_ -= kSpacing;
    return true;
  }

 private:
  static constexpr Duration kSpacing = Duration(std::chrono::seconds(1)) / kPerSecond;

  Duration credit_ = kBurst * kSpacing;
  ScenarioTime last_{};
};

}  // namespace skerry::server
