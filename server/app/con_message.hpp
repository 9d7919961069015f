// A ship's con -> wire::ConState.
#pragma once

#include "protocol/wire/conning.pb.h"
#include "server/world/dead_reckoning.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Requires a ship that has a con; `place` is hers as of now.  Who has the con stays empty.
void tell_con(const ShipState& ship, const ShipPlace& place, wire::ConState& con);

}  // namespace skerry::server
