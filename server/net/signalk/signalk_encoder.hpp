// The format of spokes that Signal K displays take.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/video/scan_geometry.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// Fields `spokes` of RadarMessage, one per spoke: any run of whole ones is a message.
inline const std::string kSignalkFormat = "signalk";

// How a turn is cut for displays: as the radar does, but never finer than browsers can draw.
// Freeboard-SK's canvas is twice the cells wide and it holds 28 bytes per cell of a turn.
struct SignalkShape {
  std::uint32_t turn_spokes = 2048, cells = 1024;
};
SignalkShape signalk_shape(const ScanGeometry& geometry);
SignalkShape signalk_shape(std::uint32_t turn_spokes, std::uint32_t cells);

// Its state is the encoder's own: one per channel.
SectorEncoder signalk_encoder();

}  // namespace skerry::server
