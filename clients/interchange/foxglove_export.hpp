// Recordings for Foxglove: pictures, positions and tracks with Foxglove's own schemas.
#pragma once

#include <cstdint>

#include "clients/recording/recorded_turns.hpp"
#include "protocol/picture/ppi_picture.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::client {

struct FoxgloveCounts {
  std::uint64_t pictures = 0;
  std::uint64_t fixes = 0;   // positions of own ship
  std::uint64_t tracks = 0;  // GeoJSON documents
  NotRead not_read;
};

// Channels, all of protobuf, N the radar:
//   /radar_N/ppi       foxglove.CompressedImage  each turn, PNG, at the time of its last spoke
//   /radar_N/position  foxglove.LocationFix      each OwnShip message with a position
//   /radar_N/ships     foxglove.GeoJSON          each turn (ShipTracks)
// The frame is radar_N.  Error: no turn in that part, or `progress` gave up, or the sink took not
// all of it.
Result<FoxgloveCounts, recording::RecordingError> write_foxglove(
    const recording::RecordingReader& reader, const RecordedPart& part, const PpiOptions& picture,
    recording::ByteSink sink, const recording::RecordingReader::Progress& progress = {});

}  // namespace skerry::client
