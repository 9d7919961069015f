// Ships and marks as a recording has them.
#pragma once

#include <vector>

#include "protocol/recording/recording.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

recording::Traffic traffic_message(const std::vector<TrafficItem>& traffic);

}  // namespace skerry::server
