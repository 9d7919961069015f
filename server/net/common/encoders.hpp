// The formats in which sectors leave the server, each encoded once whatever the number of readers.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/asterix/cat240_stream.hpp"
#include "server/core/video_channel.hpp"
#include "server/net/common/output_config.hpp"

namespace skerry::server {

// Frames one after another, spoke k in [ends[k-1], ends[k]).  TCP and WebSocket send them as they
// are, UDP sends the frames' bodies.
inline const std::string kNativeFormat = "native";

SectorEncoder native_encoder();
// ThinSpokes of that level, 1 .. kThinLevels: a message is with the last of its spokes.
std::string thin_format(std::uint32_t level);
SectorEncoder thin_encoder(std::uint32_t level);
// Whatever a client of the native protocol may ask for: spokes as they are, and all thin levels.
// Error: std::logic_error if the channel has one of them.
void add_native_formats(VideoChannel& channel);
// The one of them for Subscribe.thin, 0 .. kThinLevels.
std::string native_format(std::uint32_t thin);
// The same in another shape.  Spokes are numbered from 0 without a gap.
SectorEncoder native_encoder(const NativeShape& shape);

// Spokes as datagrams of that shape, whole ones: where several records go into one, a spoke may
// have none.  Its state is the encoder's own: one per channel.
SectorEncoder cat240_encoder(const Cat240StreamShape& shape);

}  // namespace skerry::server
