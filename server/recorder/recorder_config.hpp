// RecorderConfig: where and how a recorder writes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/recording/writer.hpp"

namespace skerry::server {

// When what was written is also on the disk, so that a power loss does not take it.  Whatever it
// is, the end of the process alone loses nothing that was written.
enum class Sync : std::uint8_t { none, file, chunk };

struct RecorderConfig {
  std::string folder = "skerry-recordings";  // made when first recorded into
  bool record_at_start = false;
  bool record_all_views = false;  // then; not view 0 of each radar alone
  recording::Compression compression = recording::Compression::lz4;
  bool compact = false;
  // A file ends and the next begins when it has so many bytes, or so long a time; 0: never.
  std::uint64_t roll_bytes = 0;
  std::chrono::seconds roll_time{0};
  // Older files of this recorder's own in the folder are removed, so that all together have at most
  // so many bytes, and none is older; 0: nothing is removed.
  std::uint64_t keep_bytes = 0;
  std::chrono::seconds keep_time{0};
  std::uint64_t reserve_bytes = 512u << 20;  // of the disk's free space, never touched
  Sync sync = Sync::chunk;
  // Waiting for the disk, at most; what has no place there is dropped and counted.
  std::size_t max_queue = 64u << 20;
  std::string format = "native";  // of the rings it reads: frames of ServerMessages with spokes
};

}  // namespace skerry::server
