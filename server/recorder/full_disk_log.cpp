#include "server/recorder/full_disk_log.hpp"

#include <fmt/format.h>

#include <utility>

namespace skerry::server {

std::string FullDiskLog::told_again(const char* what, std::uint64_t lost) const {
  return fmt::format("recorder: {}: it took nothing for {:.1f} s, and {} spokes are missing", what,
                     std::chrono::duration<double>(last_full_ - *full_since_).count(),
                     lost - lost_before_);
}

std::optional<std::string> FullDiskLog::look(const DiskState& disk, std::uint64_t lost,
                                             Steady now) {
  if (disk.is_full) {
    last_full_ = now;
    room_since_.reset();
    if (full_since_) return std::nullopt;
    full_since_ = now;
    return fmt::format(
        "recorder: the disk is full ({} MiB free): nothing is recorded until there is room; remove "
        "files, or have fewer kept (recorder.keep_gib, keep_hours)",
        disk.free_bytes >> 20);
  }
  if (!full_since_) {
    lost_before_ = lost;
    return std::nullopt;
  }
  if (!room_since_) room_since_ = now;
  if (now - *room_since_ < kCalm) return std::nullopt;
  return end(lost);
}

std::optional<std::string> FullDiskLog::end(std::uint64_t lost) {
  if (!full_since_) return std::nullopt;
  std::string line = room_since_ ? told_again("the disk has room again", lost)
                                 : told_again("the disk is still full at the end", lost);
  full_since_.reset();
  room_since_.reset();
  lost_before_ = lost;
  return line;
}

}  // namespace skerry::server
