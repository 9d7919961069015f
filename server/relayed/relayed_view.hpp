// RelayedView: where the spokes of a recorded view leave the playback, as they were or drawn to
// another reach.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "server/core/latest.hpp"
#include "server/core/video_channel.hpp"
#include "server/relayed/spoke_stamp.hpp"

namespace skerry::server {

// The wanted end of a view's last cell: this length, and on other range scales the same multiple of
// them.
struct WantedReach {
  double range_m = 0.0;  // 0: at the range scale
  RangeScale scale;      // the one it was wanted for
  // On a range scale; brought into what a spoke may have.
  Length on(RangeScale other) const;
};

// Thread: any, but for publish(), which is the playback's.
class RelayedView {
 public:
  // `source`: the recorded view whose spokes it shows.  `opened`: by a client, not recorded.
  RelayedView(std::uint32_t view_number, std::uint32_t source_view, bool was_opened,
              std::size_t ring_sectors)
      : number(view_number), source(source_view), opened(was_opened), channel(ring_sectors) {}

  // Spokes of the source, which nobody else has, with the header's times as they are to be; gives
  // them this view's number and numbers that grow.
  void publish(std::vector<std::shared_ptr<Spoke>> spokes);
  // Spokes that keep all their numbers, and came in that format.
  void pass_on(const Sector& sector, const std::string& format, const EncodedSectorPtr& encoded);
  // The playback has jumped.
  void begin_anew() { stamp_.begin_anew(); }

  void want_reach(const WantedReach& reach) { reach_.set(reach); }
  std::uint64_t spokes() const { return spokes_.load(std::memory_order_relaxed); }  // published
  std::uint32_t scan() const { return scan_.load(std::memory_order_relaxed); }      // the newest

  // The recorded reach, if none is wanted.
  void tell_reach(wire::Settings& settings) const;

  const std::uint32_t number, source;
  const bool opened;
  VideoChannel channel;

 private:
  Latest<WantedReach> reach_;
  SpokeStamp stamp_;  // the playback's thread alone
  std::atomic<std::uint64_t> spokes_{0};
  std::atomic<std::uint32_t> scan_{0};
};
using RelayedViewPtr = std::shared_ptr<RelayedView>;
using RelayedViews = std::vector<RelayedViewPtr>;

// The views of one radar: those recorded, which stay, number 0 among them whatever was recorded;
// and those that clients open, with numbers above.
// Thread: any.  A view that has been closed lives on for whoever holds it, without new video.
class RelayedViewList {
 public:
  static constexpr std::size_t kMaxViews = 32;  // besides those recorded

  // `recorded`: ascending; `shared`: what number 0 shows; `first_opened`: the least number that
  // clients get, above those recorded.
  RelayedViewList(const std::vector<std::uint32_t>& recorded, std::uint32_t shared,
                  std::size_t ring_sectors, std::uint32_t first_opened = 1);

  std::shared_ptr<const RelayedViews> get() const { return views_.get(); }
  RelayedViewPtr find(std::uint32_t number) const;
  // A copy of view `like`; nullptr if there are as many as may be, or no such view.
  RelayedViewPtr open(std::uint32_t like, const std::function<void(VideoChannel&)>& prepare);
  // No effect on what was recorded.
  void close(std::uint32_t number);
  // A view that another server has opened, by its number there if that is free, else by one as
  // clients get; nullptr if there is none.  And its end.
  RelayedViewPtr add(std::uint32_t number, const std::function<void(VideoChannel&)>& prepare);
  void take_away(std::uint32_t number);
  // VideoChannel::hold() of all that are there and all that come.
  void hold(std::size_t max_bytes);

 private:
  // Under the mutex; nothing if there is none.
  std::optional<std::uint32_t> next_number();
  RelayedViewPtr put(std::uint32_t number, std::uint32_t source, bool opened,
                     const std::function<void(VideoChannel&)>& prepare);

  const std::size_t ring_sectors_;
  std::mutex mutex_;  // of changes
  std::uint32_t first_opened_ = 1, last_number_ = 0;
  std::size_t held_bytes_ = 1 << 20;
  Latest<RelayedViews> views_;
};

}  // namespace skerry::server
