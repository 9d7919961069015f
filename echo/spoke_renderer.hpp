// The one door to the echo: from a Scene to the video of a sector.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "echo/kernel/parallel_for.hpp"
#include "echo/receiver/view_receiver.hpp"
#include "echo/scene/scene.hpp"
#include "echo/spoke_returns.hpp"

namespace skerry::echo {

// A radar and one view of it.  For several views of a radar make SpokeReturns once and give its
// rows to a ViewReceiver each.  Rows are made in blocks of kBlock spokes from the scene in force at
// the first call that needs any of a block; so the video is a pure function of the scenes and
// controls by spoke, however a turn is cut into calls, for any number of threads and any
// instruction set.
// Thread: one at a time.
class SpokeRenderer {
 public:
  // Requires a valid geometry and a set without faults (set_checks.hpp).  `radar` tells noise of
  // radars apart.
  SpokeRenderer(const RadarSet& set, const ScanGeometry& geometry, const SpokeClock& clock,
                std::uint32_t radar, ParallelFor parallel = serial_for);

  const ScanGeometry& geometry() const { return geometry_; }
  const ViewControls& controls() const { return receiver_->controls(); }
  // The view's range scale is the radar's too.
  void set_controls(const ViewControls& controls);
  void set_radar_controls(const RadarControls& controls);

  // Video of spokes first .. first + count - 1, counted from the antenna's start (spoke n of scan s
  // is s * spokes_per_turn + n), into video[k * cells ...].
  void render(const Scene& scene, std::uint64_t first, std::uint32_t count,
              std::span<std::uint8_t> video);

 private:
  static constexpr std::uint32_t kBlock = 16;

  RadarModel model_for(RangeScale scale) const;
  void rebuild(const ViewControls& controls);

  RadarSet set_;
  ScanGeometry geometry_;
  SpokeClock clock_;
  std::uint32_t radar_;
  ParallelFor parallel_;
  RadarControls radar_controls_;
  std::optional<SpokeReturns> returns_;
  std::optional<ViewReceiver> receiver_;
  PowerRows rows_;  // of the block last made
};

}  // namespace skerry::echo
