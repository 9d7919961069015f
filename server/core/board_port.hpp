// BoardPort: an interface board as the network sees it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// The ring in shared memory, and what keeps it fed: whoever asked for it holds `lease` for as long
// as its client may be reading.
struct BoardRingLease {
  wire::BoardReply reply;
  std::shared_ptr<void> lease;
};

// Thread: any; every function returns at once (open_ring() the first time when the memory is laid
// out: 5 ms for 16 MiB).
class BoardPort {
 public:
  virtual ~BoardPort() = default;

  // Registers, read and written in order at one instant.
  virtual wire::BoardReply access(const wire::BoardAccess& access) = 0;
  // Up to `count` sweeps out of the FIFO, as many as a frame holds; fewer count as underruns.
  virtual wire::BoardRecords read_fifo(std::uint32_t count) = 0;
  // The shared-memory ring, made when first asked for.  Error: why there is none.
  virtual Result<BoardRingLease, std::string> open_ring() = 0;

  // Sectors here are blocks of records, ServerMessage frames of BoardRecords, spokes are records.
  // "records": all of them; "signals": edges and events alone.
  virtual FormatRing& ring(const std::string& format) = 0;

  // The present rate of "records", as measured; 0 if nothing was sent lately.
  virtual double bytes_per_second() const = 0;
};
using BoardPortPtr = std::shared_ptr<BoardPort>;

inline const std::string kRecordsFormat = "records";
inline const std::string kSignalsFormat = "signals";

}  // namespace skerry::server
