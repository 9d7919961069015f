// SetVideo: what a radar set makes of finished video: smoothing along range, and its own levels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// Immutable; any thread.
class SetVideo {
 public:
  explicit SetVideo(const RadarSet& set);

  bool smooths() const { return smoothing_ > 1; }
  // Whole spokes of `cells` cells (smooth_video()).  Where the receiver is blind, before the cells
  // first and from last on, nothing is still.
  void smooth(std::span<std::uint8_t> video, std::size_t cells, std::size_t first, std::size_t last,
              std::vector<std::uint8_t>& scratch) const;
  // From even levels to RadarSet::levels.  0 stays 0.
  void level(std::span<std::uint8_t> video) const;

 private:
  std::uint32_t smoothing_;
  std::vector<std::uint8_t> levels_;  // by 8-bit video; empty: even ones
};

}  // namespace skerry::echo
