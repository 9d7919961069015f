// The host's ships and marks as recordings have them.
#pragma once

#include <vector>

#include "protocol/recording/recording.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

recording::Traffic traffic_message(const std::vector<TrafficItem>& traffic);

}  // namespace skerry::server
