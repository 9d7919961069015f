// Side effects of a display's knob.
#pragma once

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// A picture mode of the view decides gain, sea and rain by itself; a display's knob ends that.
inline void by_hand(wire::Set& set, const wire::Settings& now) {
  if (now.mode() != wire::CUSTOM) set.set_mode(wire::CUSTOM);
}

}  // namespace skerry::server
