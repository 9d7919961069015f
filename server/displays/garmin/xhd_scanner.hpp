// The scanner of a Garmin xHD radar: how it gets from standby to a picture and back.
#pragma once

#include <cstdint>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

struct XhdScannerTimes {
  Duration starting{}, spinning_up{}, stopping{}, spinning_down{};
};

// A display that asks for a picture gets it when the scanner has spun up; one switched on from
// elsewhere is on the air already, and so is the scanner.  Thread: one at a time.
class XhdScanner {
 public:
  XhdScanner(const XhdScannerTimes& times, bool transmits, ScenarioTime now);

  void ask(bool on, ScenarioTime now);
  // Follows the radar's state after anybody's change.
  void follow(bool transmits, ScenarioTime now);
  // Goes on in time.  True at the moment when the radar has to go on the air; if it cannot,
  // follow() tells.
  bool step(ScenarioTime now);

  garmin::ScannerState state() const { return state_; }
  bool is_asked_for() const;
  // A real radar counts down from ten seconds, however long the state takes; 0 where no change is
  // due.
  std::uint32_t until_change_ms(ScenarioTime now) const;
  // The antenna's speed, rpm; `full_rpm` is its speed while it makes a picture.
  double rpm(ScenarioTime now, double full_rpm) const;
  // 2 stands, 0 is about to turn, 1 turns.  Reported as 0x918.
  std::uint32_t motion() const;

 private:
  void enter(garmin::ScannerState state, ScenarioTime now);
  Duration length() const;

  XhdScannerTimes times_;
  garmin::ScannerState state_ = garmin::ScannerState::standby;
  ScenarioTime since_{};
};

}  // namespace skerry::server
