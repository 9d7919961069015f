// Whether a Set asks for what is so already.
#pragma once

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Displays say "transmit" to a radar that transmits, and set a control to what it is: that is not
// refused by a playback.  Locks, orders to the ship and the world always ask for a change.
bool is_so_already(const wire::Set& set, const wire::Settings& settings);

}  // namespace skerry::server
