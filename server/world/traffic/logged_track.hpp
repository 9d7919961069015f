// LoggedTrack: the way of a ship that sails as a log has her (scenario key `as_logged`).
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// At each waypoint just at its time; between two of them latitude and longitude go evenly, and she
// turns at once.  Each place follows from the log alone, nothing adds up, with the same bits on
// every machine.  Her heading is her course; while she makes less than kSteers_mps, it is that of
// the leg before, or of the target's `course_deg` before she has made way.
// Immutable.  Thread: any.
class LoggedTrack {
 public:
  static constexpr double kSteers_mps = 0.25;  // 0.5 kn

  // Requires what check_logged() checks.
  explicit LoggedTrack(const scenario::Target& target);

  // Whether she is on the water: from her first fix until her last.
  bool covers(Duration exercise) const;
  // Her place and motion at that time, which lead exactly to those a tick later on the same leg;
  // before and after she lies at her first and last place.
  void put(Duration exercise, ShipState& ship) const;
  // The waypoints that she has passed by then.
  std::size_t passed_at(Duration exercise) const;

 private:
  struct Fix {
    double at_s;
    GeoPoint place;
    double heading_deg;  // on the leg from it, while she makes no way
  };
  // The leg's place at that time, before its begin and after its end too.
  static GeoPoint place_on(const Fix& from, const Fix& to, double at_s);
  std::size_t leg_at(double at_s) const;

  std::vector<Fix> fixes_;  // two or more
};

}  // namespace skerry::server
