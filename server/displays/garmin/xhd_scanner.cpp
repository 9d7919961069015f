#include "server/displays/garmin/xhd_scanner.hpp"

#include <algorithm>

namespace skerry::server {

using garmin::ScannerState;

XhdScanner::XhdScanner(const XhdScannerTimes& times, bool transmits, ScenarioTime now)
    : times_(times) {
  enter(transmits ? ScannerState::transmitting : ScannerState::standby, now);
}

void XhdScanner::enter(ScannerState state, ScenarioTime now) {
  state_ = state;
  since_ = now;
}

Duration XhdScanner::length() const {
  switch (state_) {
    case ScannerState::starting:
      return times_.starting;
    case ScannerState::spinning_up:
      return times_.spinning_up;
    case ScannerState::stopping:
      return times_.stopping;
    case ScannerState::spinning_down:
      return times_.spinning_down;
    default:
      return Duration::max();
  }
}

bool XhdScanner::is_asked_for() const {
  return state_ == ScannerState::starting || state_ == ScannerState::spinning_up ||
         state_ == ScannerState::transmitting;
}

void XhdScanner::ask(bool on, ScenarioTime now) {
  if (on == is_asked_for()) return;
  if (on) {
    enter(ScannerState::starting, now);
  } else {
    enter(state_ == ScannerState::starting ? ScannerState::standby : ScannerState::stopping, now);
  }
}

void XhdScanner::follow(bool transmits, ScenarioTime now) {
  if (transmits && state_ != ScannerState::transmitting) enter(ScannerState::transmitting, now);
  if (!transmits && state_ == ScannerState::transmitting) enter(ScannerState::stopping, now);
}

bool XhdScanner::step(ScenarioTime now) {
  bool on_the_air = false;
  while (length() != Duration::max() && now - since_ >= length()) {
    const ScenarioTime then = since_ + length();
    switch (state_) {
      case ScannerState::starting:
        enter(ScannerState::spinning_up, then);
        break;
      case ScannerState::spinning_up:
        enter(ScannerState::transmitting, then);
        on_the_air = true;
        break;
      case ScannerState::stopping:
        enter(ScannerState::spinning_down, then);
        break;
      default:
        enter(ScannerState::standby, then);
        break;
    }
  }
  return on_the_air;
}

std::uint32_t XhdScanner::until_change_ms(ScenarioTime now) const {
  if (length() == Duration::max()) return 0;
  constexpr std::int64_t kCountsFrom = 10'000;
  const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(now - since_).count();
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(kCountsFrom - passed, 0, kCountsFrom));
}

double XhdScanner::rpm(ScenarioTime now, double full_rpm) const {
  const Duration whole = length();
  const double part = whole == Duration::max() || whole <= Duration::zero()
                          ? 1.0
                          : std::clamp(in_seconds(now - since_) / in_seconds(whole), 0.0, 1.0);
  switch (state_) {
    case ScannerState::spinning_up:
      return full_rpm * part;
    case ScannerState::transmitting:
      return full_rpm;
    case ScannerState::stopping:
      return full_rpm * (1.0 - part / 2.0);
    case ScannerState::spinning_down:
      return full_rpm * (1.0 - part) / 2.0;
    default:
      return 0.0;
  }
}

std::uint32_t XhdScanner::motion() const {
  return state_ == ScannerState::standby ? 2 : state_ == ScannerState::starting ? 0 : 1;
}

}  // namespace skerry::server
