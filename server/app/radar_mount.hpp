// RadarServer::Mount: a radar on her ship.
#pragma once

#include <string>
#include <utility>

#include "server/app/radar_server.hpp"

namespace skerry::server {

struct RadarServer::Mount {
  std::string own_ship;
  RadarUnit unit;
  Mount(std::string ship, const RadarConfig& config, Timeline& timeline, CoastService& coast,
        Airwaves& airwaves, std::size_t workers, InputLog& inputs)
      : own_ship(std::move(ship)), unit(config, timeline, coast, airwaves, workers, &inputs) {}
};

}  // namespace skerry::server
