// Control ranges: what may stand in a Set message.
#pragma once

#include <optional>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// The reply that refuses the first thing wrong with it: UNKNOWN for a field this server does not
// know (of `set` or anything in it), OUT_OF_RANGE with the allowed range for a value outside its
// own.  Nothing if all is well; what depends on the state of the radars is not looked at.
std::optional<wire::Reply> refusal_of(const wire::Set& set);

wire::Reply refusal(wire::Reply::Code code, std::string text);

}  // namespace skerry::server
