// From a scenario's radar to the unit that turns it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "server/radar/radar_unit.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

RadarConfig radar_config(const scenario::Radar& radar, std::uint32_t index, std::size_t own_ship,
                         std::uint64_t seed);

}  // namespace skerry::server
