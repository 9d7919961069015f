// ViewReaders: the views whose spokes a recording takes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/recorder/spoke_frame.hpp"

namespace skerry::server {

// A view's spokes as a recorder takes them from its ring.
// Wakes the recorder when kWakeAfter sectors wait, a small part of a ring; fewer wait until it
// looks by itself.  So nearly every publish costs the radar's thread no more than a count.
// Thread: the recorder's.
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

  // Whether the view's settings stand before its next spoke.
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

// View 0 of each radar, or all views that there are at the time: a reader goes with its view.
// Thread: the recorder's.
class ViewReaders {
 public:
  // Views of all radars in one file.  The file's descriptions of its views stay in memory until its
  // end.
  static constexpr std::size_t kMaxInFile = 10'000;

  struct Wanted {
    std::vector<std::uint32_t> radars;  // that the host has
    bool all_views = false;
    std::string format;  // of the rings; a view without it is passed over
  };
  // Told of a view; of one that is closed before its reader goes, with all that its ring holds.
  using Told = std::function<void(RingReader&)>;
  struct Changes {
    Told opened, closed;
    std::function<void(std::uint32_t radar, std::uint32_t view)> left_out;  // beyond kMaxInFile
  };

  // `host` must outlive it.  `wake` is called on the radars' threads.
  ViewReaders(RadarHost& host, Wanted wanted, std::function<void()> wake);

  // Readers for the views that were opened since the last call, none for those closed; costs
  // nothing where none was.
  void look(const Changes& changes);
  // Another file has the views that are there, and no others yet.
  void file_begins();

  auto begin() const { return readers_.begin(); }
  auto end() const { return readers_.end(); }

 private:
  void look_at(std::uint32_t radar, const Changes& changes);

  RadarHost& host_;
  const Wanted wanted_;
  const std::function<void()> wake_;
  std::vector<std::unique_ptr<RingReader>> readers_;
  std::uint64_t version_ = 0;  // of the host's views, as they were looked at
  std::size_t in_file_ = 0;
  bool is_full_ = false;  // one was left out
};

}  // namespace skerry::server
