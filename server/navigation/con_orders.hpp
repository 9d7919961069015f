// What a bridge or an autopilot outside orders, as the con takes it.
#pragma once

#include "protocol/nmea/con_command.hpp"
#include "protocol/wire/conning.pb.h"

namespace skerry::server {

// Of several shafts the one on the centre line or the first to starboard counts; revolutions and
// pitch are no lever and are left out; a track to steer is a heading, since the route is the
// scenario's.  A rudder order beyond 35 deg is 35.
wire::ConOrder con_order_of(const nmea::ConCommand& command);

}  // namespace skerry::server
