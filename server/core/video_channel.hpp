// VideoChannel: where a view's spokes leave the radar thread, encoded once per format; and the ring
// that a board's records leave by as well.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/video/spoke.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::server {

// When the antenna passed a sector, and what of it completed each of the encoded "spokes".
struct SectorTimes {
  ScenarioTime first{}, last{};
  std::vector<ScenarioTime> completed;
};

// A sector in one wire format.
struct EncodedSector {
  std::uint64_t first_sequence = 0;
  std::uint32_t scan = 0;                 // of the first spoke
  std::uint32_t begin = 0;                // of the first spoke in `bytes`
  std::vector<std::uint32_t> spoke_ends;  // spoke k is bytes [ends[k-1], ends[k])
  SectorTimes times = {};                 // of emulated radars alone
  double reach_m = 0.0;                   // of the sector's rows; of emulated radars alone
  Bytes bytes;
  std::uint32_t spoke_count() const { return static_cast<std::uint32_t>(spoke_ends.size()); }
};
using EncodedSectorPtr = std::shared_ptr<const EncodedSector>;

// Turns a sector into bytes.  Pure but for counters of its own (message index of CAT240).
using SectorEncoder = std::function<EncodedSectorPtr(const Sector&)>;

// A reader's state between two takes.
struct Cursor {
  std::uint64_t next = 0;           // number of the sector wanted next
  std::uint64_t spokes_before = 0;  // published before that sector: makes the loss exact
  std::uint64_t spokes_lost = 0;    // overwritten before they were taken
};

// The last sectors of one format, overwritten without waiting for anybody.
// Thread: one writer (the radar's or board's thread); any number of readers, each with a cursor of
// its own.
class FormatRing {
 public:
  // `capacity` sectors are held for displays, half a second of them by default (VideoChannel), and
  // kRecorderHolds times as many while a recorder reads, whose thread a busy machine may keep
  // waiting for longer than that; at most `max_bytes` of them, but always the newest.
  static constexpr std::size_t kRecorderHolds = 4;
  FormatRing(SectorEncoder encoder, std::size_t capacity,
             std::size_t max_bytes = std::numeric_limits<std::size_t>::max());
  // A ring whose writer encodes by itself (the second publish()).
  FormatRing(std::size_t capacity, std::size_t max_bytes);

  // The sector at the cursor, which moves on; nullptr if none is there yet.  A cursor that was
  // overtaken jumps and counts what it missed, exactly: a display, `capacity` sectors behind, to
  // the newest sector (live beats complete); a recorder to the oldest still held.
  enum class Overtaken : std::uint8_t { to_newest, to_oldest };
  EncodedSectorPtr take(Cursor& cursor, Overtaken jump = Overtaken::to_newest);
  // A cursor that will first see the next sector published.  Register before taking it: sectors
  // published while nobody is registered are not encoded, and count as lost for such a cursor.
  Cursor cursor_at_end() const;
  // Cursors given out so far: whether a reader has joined since.
  std::uint64_t joins() const { return joins_.load(std::memory_order_relaxed); }

  // `wake` is called on the radar thread after each publish while the registration lives; it must
  // only post.  Once the registration has been released, no call is running or will come.  The
  // ring must outlive it, and `wake` must not release it.
  // A recorder says so: sectors are held for it (kRecorderHolds).
  using Registration = std::shared_ptr<void>;
  enum class Reader : std::uint8_t { display, recorder };
  Registration on_publish(std::function<void()> wake, Reader reader = Reader::display);

  // Thread: the writer's.  `spokes` of them, in a sector that `encode` makes if somebody is
  // registered; it is not called otherwise.
  void publish(std::uint64_t spokes, const std::function<EncodedSectorPtr()>& encode);
  // Thread: any.
  bool has_readers() const { return reader_count_.load(std::memory_order_relaxed) > 0; }

  std::uint64_t spokes_encoded() const { return spokes_encoded_.load(std::memory_order_relaxed); }

  // Another bound of the bytes held, from the next publish on.
  void hold(std::size_t max_bytes) { max_bytes_.store(max_bytes, std::memory_order_relaxed); }

 private:
  friend class VideoChannel;
  struct Slot {
    EncodedSectorPtr sector;          // nullptr if nobody was registered
    std::uint64_t spokes_before = 0;  // published before this sector
  };
  using Wakes = std::list<std::function<void()>>;

  void publish(const Sector& sector);
  bool is_held(std::uint64_t sector) const;
  // Lets go of the oldest sectors beyond what readers may want and max_bytes_; gives them for their
  // destruction.
  std::vector<EncodedSectorPtr> make_room();

  SectorEncoder encoder_;  // the writer's thread only
  std::atomic<std::size_t> max_bytes_;
  const std::size_t capacity_;
  std::atomic<std::size_t> recorders_{0};
  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::size_t held_bytes_ = 0;
  std::uint64_t oldest_ = 0;  // sector from which on some are held
  // Sectors.  Written under the mutex; read without it by who may have taken all of them.
  std::atomic<std::uint64_t> published_{0};
  std::uint64_t published_spokes_ = 0;  // spokes in them
  // Held for a whole publish, so that a sector is encoded for exactly those who were registered
  // before it, and releasing a registration waits for its last call.
  std::mutex wakes_mutex_;
  Wakes wakes_;
  std::atomic<std::size_t> reader_count_{0};
  std::atomic<std::uint64_t> spokes_encoded_{0};
  mutable std::atomic<std::uint64_t> joins_{0};
};

// All formats of one view.  Formats are added before the radar starts; a format without a reader
// costs nothing (its encoder is not called).
class VideoChannel {
 public:
  explicit VideoChannel(std::size_t ring_sectors = 64) : ring_sectors_(ring_sectors) {}

  // Error: std::logic_error if the channel has a format of that name.
  FormatRing& add_format(const std::string& name, SectorEncoder encoder);
  // Error: std::out_of_range unless the format was added.
  FormatRing& format(const std::string& name) { return *formats_.at(name); }
  // nullptr unless the format was added.
  FormatRing* find_format(const std::string& name);

  // Thread: the radar thread only.  Never waits for a reader; a sector without spokes is ignored.
  void publish(const Sector& sector);
  // The same of a sector that came in one of the formats: its readers get it as it is.
  void publish(const Sector& sector, const std::string& format, const EncodedSectorPtr& encoded);

  std::map<std::string, std::uint64_t> spokes_encoded() const;

  // For every format, also those added later: FormatRing::hold(); and the sum of joins().
  void hold(std::size_t max_bytes);
  std::uint64_t joins() const;

 private:
  std::size_t ring_sectors_;
  std::size_t max_bytes_ = std::numeric_limits<std::size_t>::max();
  std::map<std::string, std::unique_ptr<FormatRing>> formats_;
};

}  // namespace skerry::server
