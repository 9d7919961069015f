// RecordingNews: when consoles are told of the recorder and of what is played back.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "server/core/radar_host.hpp"
#include "server/net/common/spoke_feed.hpp"

namespace skerry::server {

// Says what is due: each state when it changed, the recorder's once a second while it records (or
// would, if the disk had room), and that of a playback twice a second while it plays.
// Thread: net-0.
class RecordingNews {
 public:
  static constexpr std::chrono::milliseconds kWhileRecording{1000};
  static constexpr std::chrono::milliseconds kWhilePlaying{500};

  // The host must outlive it.
  explicit RecordingNews(RadarHost& host) : host_(host) {}

  // Frames to send; nullptr: nothing to tell, or a host that does not record or play.
  struct Pair {
    SharedBytes recorder, playback;
  };
  struct Frames {
    Pair whole;
    Pair for_strangers;  // leave_out_for_strangers()
  };
  // The messages that are due.  Call it ten times a second, which is the most often that a message
  // is sent.
  Frames due(std::chrono::steady_clock::time_point now);
  // The present state, for a console that has just connected.
  Frames all() const;

 private:
  struct Told {
    std::optional<std::uint64_t> version;
    std::chrono::steady_clock::time_point at;
  };

  RadarHost& host_;
  Told recorder_, playback_;
};

}  // namespace skerry::server
