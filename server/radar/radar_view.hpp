// RadarView: a console's receiver settings on a radar, and where its video goes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "echo/receiver/controls.hpp"
#include "server/core/latest.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

struct RadarView {
  RadarView(std::uint32_t view_number, const echo::ViewControls& view_controls,
            std::size_t ring_sectors)
      : number(view_number), channel(ring_sectors), controls(view_controls) {}

  const std::uint32_t number;
  VideoChannel channel;
  Latest<echo::ViewControls> controls;
  std::uint64_t sequence = 0;  // of the next spoke; the radar's thread
};
using RadarViewPtr = std::shared_ptr<RadarView>;
using RadarViews = std::vector<RadarViewPtr>;

// The views of one radar: number 0, which is always there, and up to kMaxViews - 1 further ones.
// Numbers of further views go up by one, so that one that has ended is not soon another's.
// Thread: any.  A view that has been closed lives on for whoever holds it, without new video.
class RadarViewList {
 public:
  static constexpr std::size_t kMaxViews = 32;
  static constexpr std::uint32_t kLastNumber = 65'535;  // what datagrams can say

  RadarViewList(const echo::ViewControls& controls, std::size_t ring_sectors);

  // Never empty; number 0 comes first.
  std::shared_ptr<const RadarViews> get() const { return views_.get(); }
  RadarViewPtr find(std::uint32_t number) const;

  // A view with the controls of another; `prepare` adds its formats before any video comes.
  // nullptr if there are kMaxViews; requires a view of that number.
  RadarViewPtr open(std::uint32_t like, const std::function<void(VideoChannel&)>& prepare);
  // No effect on number 0 and on one that is not there.
  void close(std::uint32_t number);

 private:
  std::size_t ring_sectors_;
  std::mutex mutex_;  // of changes
  std::uint32_t last_number_ = 0;
  Latest<RadarViews> views_;
};

}  // namespace skerry::server
