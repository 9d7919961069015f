#include "server/radar/rain_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/radar/laid_fixtures.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {

std::vector<echo::RainMapPtr> RainAhead::make(const WorldState& state, std::uint64_t seed,
                                              ScenarioTime now) {
  std::vector<echo::RainMapPtr> maps;
  for (const RainState& rain : state.rain) {
    echo::RainCell cell;
    cell.kind = rain.cloud->kind;
    cell.radius_m = rain.cloud->radius_m;
    cell.identity = identity_of(seed, Fixture::rain, rain.cloud->id);
    const bool seen =
        std::any_of(state.own_ships.begin(), state.own_ships.end(), [&](const ShipState& own_ship) {
          const ShortWay way = short_way_between(own_ship.position, rain.centre);
          return std::hypot(way.north_m, way.east_m) < kFarthestSight_m + cell.radius_m;
        });
    if (cell.kind == echo::RainKind::even || !seen) continue;
    const double then = in_seconds((now + kLead).time_since_epoch());
    maps.push_back(echo::rain_map_for(echo::rain_map_key(cell, then)));
  }
  return maps;
}

RainAhead::RainAhead(Timeline& timeline, std::uint64_t seed, std::function<ScenarioTime()> now)
    : timeline_(timeline), seed_(seed), now_(std::move(now)) {}

void RainAhead::start() {
  thread_.start("rain", kPause,
                [this](const std::stop_token&) { make(*timeline_.latest(), seed_, now_()); });
}

}  // namespace skerry::server
