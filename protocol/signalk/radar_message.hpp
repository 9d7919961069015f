// Spokes as Signal K displays take them: the protobuf message RadarMessage.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/signalk/legend.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::signalk {

// One spoke of a RadarMessage.
struct RadarSpoke {
  std::uint32_t angle = 0;                // 0 .. spokes of a turn - 1, clockwise from the bow
  std::uint32_t bearing = 0;              // the same from true north
  std::uint32_t range_m = 0;              // where the last cell ends
  std::uint64_t time_ms = 0;              // since 1970-01-01, UTC
  GeoPoint position;                      // of the antenna
  Legend legend;                          // which byte means what
  std::span<const std::uint8_t> cells;    // 0 .. 255, or 0 .. 15 with a legend of 16 levels
  std::span<const DopplerClass> doppler;  // empty, or one per cell
};

// Appends a field `spokes` (2) of RadarMessage.  A message is any number of them one after another,
// so messages can be put together and cut apart between spokes.  Source: signalk/README.md.
void append_radar_spoke(Bytes& out, const RadarSpoke& spoke);

// The range, bearing and the rest of `header`, whose spoke is one of `turn_spokes`.
RadarSpoke radar_spoke(const SpokeHeader& header);

// Metres as the spokes and the range control say them.
std::uint32_t whole_metres(Length range);

}  // namespace skerry::signalk
