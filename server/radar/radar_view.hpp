// RadarView: a console's receiver settings on a radar, and where its video goes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "echo/receiver/controls.hpp"
#include "server/core/latest.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// A view that follows another is hidden: it is there for an output, and has at all times the
// controls of the view it follows, except for its instrumented range.
// Thread: any.
struct RadarView {
  // `of`: the view that it follows, or null; not one that follows another itself.
  RadarView(std::uint32_t view_number, const echo::ViewControls& view_controls,
            std::size_t ring_sectors, std::shared_ptr<RadarView> of = nullptr)
      : number(view_number),
        followed(std::move(of)),
        channel(ring_sectors),
        controls(view_controls) {}

  bool follows() const { return followed != nullptr; }
  // The controls in force for this view.
  echo::ViewControls controls_in_force() const;
  // In a view that follows another it changes the one followed, except for the instrumented range,
  // which each view has for itself.
  void set_controls(const echo::ViewControls& wanted);

  const std::uint32_t number;
  const std::shared_ptr<RadarView> followed;
  VideoChannel channel;
  Latest<echo::ViewControls> controls;  // its own; see controls_in_force()
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

  // A view with the controls of another, which has its own from then on or follows that one;
  // `prepare` adds its formats before any video comes.  One that follows a view that follows,
  // follows the same as that; it ends the range at the range scale until it is told otherwise.
  // nullptr if there are kMaxViews; requires a view of that number.
  RadarViewPtr open(std::uint32_t like, bool follows,
                    const std::function<void(VideoChannel&)>& prepare);
  // No effect on number 0 and on one that is not there.
  void close(std::uint32_t number);

 private:
  std::size_t ring_sectors_;
  std::mutex mutex_;  // of changes
  std::uint32_t last_number_ = 0;
  Latest<RadarViews> views_;
};

}  // namespace skerry::server
