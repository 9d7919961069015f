// What an own ship's sensors say of her.
#pragma once

#include "protocol/wire/radar.pb.h"
#include "server/world/dead_reckoning.hpp"
#include "server/world/sensors/sensor_reading.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Her state as consoles, displays and sentences are told of it: `place` is hers as of now, and so
// is the reading.  Without faults it is the truth.
//
//   heading, rate of turn     gyro; both 0 where it is lost
//   position, course, speed   GNSS: a drift of the position is in the speed over ground too
//   speed through the water   log, ahead; to starboard it is right
//   over ground ahead, aside  GNSS's speed, resolved on gyro's heading
//   wind                      the anemometer's, made a true wind by what gyro and GNSS say.  Where
//                             one of them is lost it is the wind as felt, from the bow on, and a
//                             true wind to nobody
//   current                   GNSS's speed less the log's on gyro's heading; 0 where one is lost
//
// What is lost is 0, and no_position, no_motion (course and speed over ground), no_heading, no_log,
// no_wind and no_ais say so.  Rudder, shaft, orders, depth and way along the track are right.
// Radar, UTC and who has the con stay empty.
wire::OwnShip told_ship(const ShipState& ship, const ShipPlace& place,
                        const SensorReading& reading);

}  // namespace skerry::server
