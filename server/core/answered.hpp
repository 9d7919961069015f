// Answered: what is called with the answer to an order that another server decides on.
#pragma once

#include <functional>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Called once, from any thread, while the host that was asked runs; it must only post.
using Answered = std::function<void(wire::Reply)>;

}  // namespace skerry::server
