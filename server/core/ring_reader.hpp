// RingReader: a view's spokes as a recorder, or whoever must miss none, takes them from its ring.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "server/core/radar_host.hpp"

namespace skerry::server {

// Wakes who takes when kWakeAfter sectors wait, a small part of a ring; fewer wait until it
// looks by itself.  So nearly every publish costs the radar's thread no more than a count.
// Thread: one at a time, but for what `wake` says.
class RingReader {
 public:
  static constexpr int kWakeAfter = 8;

  // From the next sector published on.  `wake` is called on the radar's thread and must not wait.
  RingReader(std::uint32_t radar, std::uint32_t view, VideoChannelPtr channel,
             const std::string& format, std::function<void()> wake)
      : radar_(radar), view_(view), channel_(std::move(channel)), ring_(channel_->format(format)) {
    registration_ = ring_.on_publish(
        [this, wake = std::move(wake)] {
          if (waiting_.fetch_add(1, std::memory_order_relaxed) + 1 == kWakeAfter) wake();
        },
        FormatRing::Reader::recorder);
    cursor_ = ring_.cursor_at_end();
  }
  RingReader(const RingReader&) = delete;
  RingReader& operator=(const RingReader&) = delete;

  std::uint32_t radar() const { return radar_; }
  std::uint32_t view() const { return view_; }
  bool is_of(const VideoChannel& channel) const { return channel_.get() == &channel; }

  // A recorder's: whether the view's settings stand before its next spoke.
  bool settings_told = false;

  // The next sector; nullptr if none is there yet.
  EncodedSectorPtr take() {
    waiting_.store(0, std::memory_order_relaxed);
    return ring_.take(cursor_, FormatRing::Overtaken::to_oldest);
  }
  // Spokes that were overwritten before they were taken, since the last call.
  std::uint64_t newly_lost() {
    return cursor_.spokes_lost - std::exchange(told_, cursor_.spokes_lost);
  }

 private:
  std::uint32_t radar_, view_;
  VideoChannelPtr channel_;
  FormatRing& ring_;
  std::atomic<int> waiting_{0};
  Cursor cursor_;
  std::uint64_t told_ = 0;
  FormatRing::Registration registration_;  // last: released before what its wake uses
};

}  // namespace skerry::server
