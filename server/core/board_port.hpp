// BoardPort: an interface board as the network sees it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// Thread: any; every function returns at once.
class BoardPort {
 public:
  virtual ~BoardPort() = default;

  // Registers, read and written in order at one instant.
  virtual wire::BoardReply access(const wire::BoardAccess& access) = 0;
  // Up to `count` sweeps out of the FIFO, as many as a frame holds; fewer count as underruns.
  virtual wire::BoardRecords read_fifo(std::uint32_t count) = 0;
  // The shared-memory ring, made when first asked for.  Error: in the reply's text.
  virtual wire::BoardReply open_ring() = 0;

  // Sectors here are blocks of records, ServerMessage frames of BoardRecords, spokes are records.
  // "records": all of them; "signals": edges and events alone.
  virtual FormatRing& ring(const std::string& format) = 0;
};

}  // namespace skerry::server
