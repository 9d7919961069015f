// VideoChannel: where a view's spokes leave the radar thread, encoded once per format.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/video/spoke.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::server {

// A sector in one wire format.
struct EncodedSector {
  std::uint64_t first_sequence = 0;
  std::uint32_t scan = 0;                  // of the first spoke
  std::vector<std::uint32_t> spoke_ends;   // spoke k is bytes [ends[k-1], ends[k])
  Bytes bytes;
  std::uint32_t spoke_count() const { return static_cast<std::uint32_t>(spoke_ends.size()); }
};
using EncodedSectorPtr = std::shared_ptr<const EncodedSector>;

// Turns a sector into bytes.  Pure but for counters of its own (message index of CAT240).
using SectorEncoder = std::function<EncodedSectorPtr(const Sector&)>;

// What a reader remembers between two takes.
struct Cursor {
  std::uint64_t next = 0;          // number of the sector wanted next
  std::uint64_t spokes_lost = 0;   // overwritten before they were taken
};

// The last sectors of one format, overwritten without waiting for anybody.
// Thread: one writer (the radar thread); any number of readers, each with a cursor of its own.
class FormatRing {
 public:
  // `capacity` sectors are held; half a second by default (VideoChannel).
  FormatRing(SectorEncoder encoder, std::size_t capacity);

  // The sector at the cursor, which moves on; nullptr if none is there yet.  A cursor that was
  // overtaken jumps to the newest sector (live beats complete) and counts what it missed, exactly.
  EncodedSectorPtr take(Cursor& cursor);
  // A cursor that will first see the next sector published.
  Cursor cursor_at_end() const;

  // `wake` is called on the radar thread after each publish while the registration lives; it must
  // only post.
  using Registration = std::shared_ptr<void>;
  Registration on_publish(std::function<void()> wake);

  std::uint64_t spokes_encoded() const { return spokes_encoded_.load(std::memory_order_relaxed); }

 private:
  friend class VideoChannel;
  void publish(const Sector& sector);

  SectorEncoder encoder_;
  mutable std::mutex mutex_;
  std::vector<EncodedSectorPtr> slots_;
  std::uint64_t published_ = 0;         // sectors
  std::uint64_t published_spokes_ = 0;  // spokes in them
  std::vector<std::uint64_t> spokes_before_;  // spokes published before slot's sector
  std::vector<std::weak_ptr<std::function<void()>>> wakes_;
  std::atomic<std::uint64_t> spokes_encoded_{0};
};

// All formats of one view.  Formats are added before the radar starts; a format without a reader
// costs nothing (its encoder is not called).
class VideoChannel {
 public:
  explicit VideoChannel(std::size_t ring_sectors = 64) : ring_sectors_(ring_sectors) {}

  FormatRing& add_format(const std::string& name, SectorEncoder encoder);
  // Requires an added format.
  FormatRing& format(const std::string& name) { return *formats_.at(name); }

  // Thread: the radar thread only.  Never waits for a reader.
  void publish(const Sector& sector);

  std::map<std::string, std::uint64_t> spokes_encoded() const;

 private:
  std::size_t ring_sectors_;
  std::map<std::string, std::unique_ptr<FormatRing>> formats_;
};

}  // namespace skerry::server
