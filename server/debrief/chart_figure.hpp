// The tracks of an exercise on the coast, as SVG.
#pragma once

#include <optional>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/debrief/debrief.hpp"

namespace skerry::server {

// What the figure shows: own ships' tracks and a margin.
struct ChartExtent {
  GeoPoint middle;
  double half_east_m = 0.0, half_north_m = 0.0;
};
ChartExtent chart_extent(const Debrief& debrief);

// `coast`: the shore about the extent's middle; nothing: none is drawn.  Own ships' tracks have
// their times along them, collisions and groundings their numbers.
std::string chart_figure(const Debrief& debrief, const std::optional<wire::Coastline>& coast);

}  // namespace skerry::server
