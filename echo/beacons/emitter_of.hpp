// The simulated radars as each other's interference.
#pragma once

#include <cstdint>

#include "echo/radar/radar_set.hpp"
#include "echo/scene/beacons.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::echo {

// A radar's place, and the time when its antenna began to turn.
struct EmitterState {
  PlanePoint place;
  PlanePoint velocity;
  double bow_deg = 0.0;          // clockwise from the plane's north
  ScenarioTime antenna_start{};  // when its beam stood over the bow (SpokeClock's start)
  // Radars of the host: RadarModel::radar, so that each hears the other's pulses when they are
  // sent.  Others: anything else.
  std::uint64_t identity = 0;
};

// No two transmitters are alike: how far at most PRF (a share of it) and frequency are off those of
// the set, drawn by identity.  With 0 for both, sets of one make stand in each other's picture as
// rings; 0.01 and 20 MHz make spirals of them.
struct EmitterSpread {
  double prf = 0.0;
  double frequency_hz = 0.0;
};

// That radar as an emitter.  Its beam turns as the antenna does while the ship keeps her heading;
// on a new heading, make it anew.
Emitter emitter_of(const RadarSet& set, const Pulse& pulse, const EmitterState& state,
                   EmitterSpread spread = {});

}  // namespace skerry::echo
