// FullDiskLog: when a disk took nothing, in the server's log.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "server/recorder/disk_queue.hpp"

namespace skerry::server {

// A line when the disk takes nothing and one when it takes again, with what is missing.  A disk
// that becomes full again within kCalm of that has room and none by turns: that counts as one time.
// Thread: one at a time.
class FullDiskLog {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kCalm{5};

  // `lost`: spokes of the recording that are missing for whatever reason.  A line to be logged.
  std::optional<std::string> look(const DiskState& disk, std::uint64_t lost, Steady now);
  // The recording is over.
  std::optional<std::string> end(std::uint64_t lost);

 private:
  std::string told_again(const char* what, std::uint64_t lost) const;

  std::optional<Steady> full_since_;  // and told
  std::optional<Steady> room_since_;
  Steady last_full_{};
  std::uint64_t lost_before_ = 0;
};

}  // namespace skerry::server
