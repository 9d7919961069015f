// Station: how a ship keeps her place on another.
#pragma once

#include "server/world/traffic/ship_answer.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// The place kept, from the leader: a bearing off her bow, and how far.
struct Station {
  double bearing_deg = 180.0;
  double distance_m = 926.0;
};

struct StationOrder {
  double course_deg = 0.0;
  double speed_mps = 0.0;
};

// She sails as the leader does, and towards her station as fast as what is missing asks for:
// slowly enough for her own lags.  Beyond her greatest speed she is left behind.
StationOrder keep_station(const Station& station, const ShipState& leader, const ShipState& ship,
                          const ShipAnswer& answer);

}  // namespace skerry::server
