// DrivenMotion: an own ship's way as an outside simulator's fixes have it.
#pragma once

#include <optional>

#include "protocol/quantity/time.hpp"
#include "server/core/traffic.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Fixes come at any rate, whole or in parts, and rounded (a position in RMC to 0.2 m).  Between
// them a reference ship sails on from the last of each part; the own ship follows the reference,
// her distance from it falling by 1 / e in kCatchUp, so that position, heading and rate of turn
// have no jumps.  Farther off than kJump, or turned by more than kHeadingJump, she is put where she
// should be at once.
//
// Course and speed, or the rate of turn, that no fix has given for kForget are worked out from
// positions, or headings: that of a steady ship to within a tenth after five fixes a second apart.
// Error: none on a steady way once caught up; where a turn at r deg/s begins and fixes T apart give
// no rate, r T of heading, which halves with every fix a second.
// Thread: one at a time.  Times: since scenario time 0.
class DrivenMotion {
 public:
  static constexpr Duration kTimeout = std::chrono::seconds(10);  // as RadarHost::kDriveTimeout
  static constexpr Duration kForget = std::chrono::seconds(5);
  static constexpr double kCatchUp_s = 1.5;
  static constexpr double kJump_m = 200.0;
  static constexpr double kHeadingJump_deg = 45.0;

  DrivenMotion(const ShipState& ship, Duration now)
      : reference_(ship), time_(now), last_fix_(now) {}

  void take(const OwnShipFix& fix, Duration now);
  bool is_over(Duration now) const { return now - last_fix_ >= kTimeout; }

  // Gives the ship, where she is `now`, the motion that is hers for the coming `tick`.
  void steer(Duration now, Duration tick, ShipState& ship) const;

 private:
  ShipState reference_at(Duration now) const;
  void take_position(GeoPoint position, Duration now);
  void take_heading(double heading_deg, Duration now);

  ShipState reference_;  // at time_
  Duration time_;
  Duration last_fix_;
  std::optional<Duration> position_time_, heading_time_, velocity_time_, turn_time_;
};

}  // namespace skerry::server
